// Composites: textures of cut faces, bodies turned inside out, and transformations of parts and wholes.
#version 3.6;
global_settings { assumed_gamma srgb adc_bailout 0 }
camera { location <0, 5, -10> right 4/3*x look_at <0, .8, 0> angle 42 }
light_source { <-5, 8, -8> rgb 1 }
light_source { <8, 3, -4> rgb <.2, .25, .3> }
#declare Red = pigment { rgb <.9, .2, .2> }
#declare Tiles = texture { pigment { checker rgb <.9, .8, .5>, rgb <.4, .3, .2> scale .25 } finish { phong .5 } }
plane { y, -.5 pigment { rgb <.5, .6, .7> } }
difference {                                       // the cutters have textures of their own, or that of the whole
  box { -1, 1 }
  sphere { <0, 1, -1>, .7 pigment { Red } }
  cylinder { -2*x, 2*x, .45 }
  texture { Tiles } rotate 30*y translate <-2.6, .6, 0>
}
intersection {                                     // a box turned inside out cuts a hole
  sphere { 0, 1.2 pigment { rgb <.3, .6, .9> } }
  box { <-.4, -2, -.4>, <.4, 2, .4> inverse pigment { Red } }
  plane { y, .6 pigment { rgb <.95, .9, .6> } }
  rotate <-25, 20, 0> translate <.3, .8, .5>
}
merge {
  sphere { 0, .7 }
  box { <0, -.5, -.5>, <1.2, .5, .5> rotate 20*z }
  difference { torus { .9, .2 } plane { x, 0 } translate .3*y }
  pigment { rgb <.4, .8, .5> } finish { phong .7 phong_size 60 reflection .15 }
  scale <.9, 1.1, .9> rotate -30*y translate <2.6, .6, -.4>
}
union {
  sphere { <-1, 0, 0>, .3 } sphere { 0, .3 pigment { Red } } sphere { <1, 0, 0>, .3 }
  light_source { <0, 2, 0> rgb .3 }
  texture { Tiles } translate <0, -.2, -3>
}
