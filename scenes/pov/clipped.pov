// Bodies that are clipped, and open ones: one looks into them. A lathe that is open is hollow where it is cut, and boxes
// that only touch share a face.
#version 3.7;
global_settings { assumed_gamma 1 }

camera { location <0, 5, -11> right x*4/3 look_at <0, .9, 0> angle 40 }
light_source { <-7, 9, -9>, rgb .8 }
light_source { <5, 12, -3>, rgb .4 }
background { rgb <.5, .6, .7> }
plane { y, -.3 pigment { checker rgb .4, rgb .7 } }

#declare Red = texture { pigment { rgb <.8, .2, .1> } finish { phong .4 } };
sphere { <-4, 1, 0>, 1.2 clipped_by { plane { <.3, 1, -.4>, 1.3 } } texture { Red } }
sphere { 0, 1.2 clipped_by { box { -1, 1 } } texture { Red } rotate <20, 30, 0> translate <-1.4, 1, 0> }
union {
  sphere { 0, .9 } torus { .9, .3 rotate x*60 }
  clipped_by { plane { <-1, .2, .6>, .2 inverse } }
  texture { Red } rotate y*-60 translate <1.3, 1, 0>
}
cylinder { 0, y*1.8, .8 open pigment { rgb <.2, .6, .3> } rotate <-25, 0, -20> translate <3.4, .1, 0> }
cone { 0, .9, <0, 1.6, 0>, .3 open pigment { rgb <.2, .3, .8> } rotate x*-70 translate <-2.6, .6, -3> }
cone { 0, 0, <0, 1.6, 0>, .8 open pigment { rgb <.7, .6, .2> } translate <2.4, -.2, -2.6> }
difference {
  sphere { <0, .5, -3>, .8 } sphere { <0, .5, -3>, .6 } plane { -y, -.7 }
  clipped_by { plane { x, .3 } } pigment { rgb <.8, .5, .7> }
}
plane { <0, .2, -1>, -6 clipped_by { sphere { <0, 2, 6.5>, 2.5 } } pigment { rgb <.9, .8, .3> } }
difference {
  lathe { bezier_spline 4, <.6, 0>, <.3, .4>, <.35, .8>, <.8, 1.3> }
  sphere { <0, .2, -.6>, .5 pigment { rgb <.9, .9, .4> } }
  pigment { rgb <.4, .7, .8> } rotate <25, 30, 0> translate <.8, -.1, -3.6>
}
intersection {
  union { box { <1, .2, .1>, <1.3, .4, .4> } box { <1, .2, .6>, <1.3, .4, .9> } }
  difference { box { 0, 1 } sphere { <1, .3, .75>, .12 } }
  pigment { rgb <.9, .9, .8> } scale 1.5 rotate 20*y translate <-4.6, 2.4, 1>
}
