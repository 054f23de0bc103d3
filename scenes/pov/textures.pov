// Textures that POV-Ray's scenes often have: layers of which the upper one hides the others, mirrors that brighten,
// ramps that repeat many times, agate, letters, whose sides are curved, and a blob whose parts blend their colours.
#version 3.7;
global_settings { assumed_gamma 1 }

camera { location <0, 3, -9> right x*4/3 look_at <0, .8, 0> angle 42 }
light_source { <-8, 12, -10>, rgb <1, .95, .9> }
light_source { <6, 5, -9>, rgb .4 }
background { rgb <.5, .6, .8> }
plane {
  y, 0
  pigment { gradient <1, 0, 2> color_map { [0 rgb <.2, .3, .2>] [.5 rgb <.8, .8, .6>] [1 rgb <.3, .2, .1>] } scale .05 }
}
text {
  ttf "timrom.ttf" "Sog", 1, 0
  pigment { rgb <.8, .3, .2> } finish { specular .4 } scale 1.6 rotate 35*y translate <-2.6, .4, 0>
}
sphere {
  <.5, .8, -1>, .8
  texture { pigment { rgb x } finish { ambient .5 reflection .5 } }
  texture { pigment { rgb <.3, .5, .8> } normal { bumps .6 scale .15 } finish { phong .6 } }
}
box {
  <1.2, 0, 0>, <2.8, 2.2, 1>
  pigment { rgb .02 } finish { reflection { rgb <1.4, 1.1, .8> } ambient 0 } rotate 15*y
}
sphere { <2.1, .6, -2>, .6 pigment { agate agate_turb .4 scale .5 } }
blob {
  threshold .5
  sphere { 0, .6, 1.2 pigment { rgb <1, .2, .1> } }
  sphere { <.5, .1, 0>, .6, 1 pigment { gradient y color_map { [0 rgb 1] [1 rgb <0, .6, 0>] } scale .15 rotate 30*z } }
  cylinder { <.5, 0, 0>, <1, -.1, -.3>, .4, 1 }
  pigment { rgb <.1, .2, .9> } rotate 20*y translate <-.2, .4, -3.6>
}
cylinder { <-.8, 0, -2.4>, <-.8, 1, -2.4>, .4 pigment { marble scale .04 rotate 30*z } }
sphere { <-2, .5, -2.6>, .5 pigment { wood scale .03 rotate 20*x } }
