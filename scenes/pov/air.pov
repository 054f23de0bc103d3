// Fog that lies on the ground, layers of the sky, patterns in each other, and an assumed_gamma. Weak mirrors in fog are
// followed by their strength before it dims them.
#version 3.7;
global_settings { assumed_gamma 2.2 }

camera { location <0, 2, -9> right x*4/3 look_at <0, 1.6, 0> angle 60 }
light_source { <-6, 9, -8>, rgb 1.1 }
background { rgb <.25, .35, .6> }
sky_sphere {
  pigment { gradient y pigment_map {
    [0 rgb <.8, .75, .7>]
    [.3 bozo turbulence .4 color_map { [.4 rgb <.3, .45, .75>] [.7 rgb .95] } scale .2]
    [.8 wrinkles color_map { [0 rgb <.2, .3, .6>] [1 rgb .8] } scale <.3, .1, .3> rotate z*20] } }
  pigment { granite color_map { [.3 rgb 1 transmit 1] [.6 rgb <.9, .8, .6> filter .3 transmit .2] } scale .7 }
  rotate y*30
}
fog { fog_type 2 distance 9 fog_offset .2 fog_alt .5 up <.1, 1, 0> turbulence <.7, .2, .7> turb_depth .8
  color rgbft <.75, .8, .9, .15, .1> }

plane { y, 0
  pigment { checker pigment { rgb <.3, .5, .2> }, pigment { marble turbulence .6 color_map { [0 rgb .2] [1 rgb .9] } } }
  finish { ambient .2 reflection .06 }
}
#declare Bands = pigment { gradient y pigment_map {
  [0 checker rgb <.9, .2, .1>, rgb <.9, .8, .2> scale .25]
  [.5 granite color_map { [0 rgb .1] [1 rgb <.6, .9, .7>] } scale .4]
  [.5 rgb <.2, .3, .9>]
  [1 onion color_map { [0 rgb x] [1 rgb <.2, 1, 1> transmit .7] } scale .3] } }
#declare I = 0;
#while (I < 5)
  sphere { 0, 1 pigment { Bands rotate z*25*I } finish { phong .5 reflection .15 } translate <I*2 - 4, 1 + .2*I, I*1.5 - 2> }
  #declare I = I + 1;
#end
