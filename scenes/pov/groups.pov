// Lights that shine on the bodies of their group alone, beside the lights of all or instead of these; lights that take
// light away; an area_light whose edges are not at right angles; and colours that filter light, which scatter more of
// it before version 3.7.
#version 3.6;
global_settings { assumed_gamma 1 }

camera { location <0, 3, -9> look_at <0, .5, 0> angle 45 }
light_source { <-6, 10, -9>, rgb .6 }
light_source { <3, 5, -4>, rgb -.25 shadowless }
light_source { <4, 9, -4>, rgb <-.2, .1, .3> }
light_source { <-3, 7, -3>, rgb .4 area_light <2, 0, 0>, <1, 1, .5>, 5, 4 }
plane { y, 0 pigment { checker rgb .8, rgb .6 } }

light_group {
  light_source { <5, 3, -6>, rgb <1, .3, .1> }
  sphere { <-2, 1, 0>, .8 pigment { rgb 1 } finish { phong .7 } }
  global_lights on
}
light_group {
  light_source { <-5, 3, -6>, rgb <.1, .3, 1> }
  box { <-.5, 0, -.5>, <.5, 1.2, .5> pigment { rgb 1 } rotate y*30 }
  sphere { <.9, .4, -.6>, .4 pigment { rgbf <1, .8, .2, .5> } finish { reflection .3 } }
}
light_group {
  union {
    sphere { <2, .6, .2>, .6 pigment { rgb 1 } finish { reflection .4 } }
    cylinder { <2, 0, -1>, <2.3, .6, -1>, .3 pigment { rgb <.3, .9, .3> } }
  }
  light_source { <2, 6, 2>, rgb 1 spotlight point_at <2, 0, 0> radius 20 falloff 30 }
  translate x*.4
}
difference { box { <-3, 0, 1>, <-1, 2, 1.5> } sphere { <-2, 1, 1>, .5 } pigment { rgb <.9, .7, .8> } }
sphere {
  <-1.6, .4, -2>, .4
  pigment { granite color_map { [0 rgbf <.9, .2, .1, .9>] [1 rgbft <.1, .3, .8, .4, .2>] } } finish { phong .5 ambient .2 }
}
sphere { <-.6, .4, -2>, .4 pigment { rgbf <.2, .7, .1, .8> } finish { phong .5 metallic reflection { .3 metallic } } }
sphere { <.4, .4, -2>, .4 pigment { rgbf <.4, .7, .1, .8> } finish { diffuse .6 } interior { ior 1.3 } }
