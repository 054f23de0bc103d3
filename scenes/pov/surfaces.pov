// Superellipsoids, quadrics and quartics: bodies of formulas that are exact.
#version 3.7;
global_settings { assumed_gamma 1 }

camera { location <1, 7, -15> right x*4/3 look_at <.2, .3, 0> angle 46 }
light_source { <-10, 20, -15>, rgb .9 }
light_source { <10, 8, -15>, rgb .3 }
background { rgb <.4, .5, .7> }
plane { y, -2 pigment { checker rgb .8, rgb .5 } }

// A hyperboloid of one sheet, and one of two.
intersection {
  quadric { <1, -1, 1>, 0, 0, -.3 }
  box { <-3, -2, -3>, <3, 2, 3> }
  pigment { rgb <.8, .3, .2> } scale .8 translate <-4.6, -.4, 1>
}
intersection {
  quadric { <1, 1, -1>, 0, 0, .3 }
  box { -2, 2 }
  pigment { rgb <.3, .4, .8> } rotate 40*y scale .8 translate <4.2, -.4, 1>
}
// Paraboloids, one of which is open; and a hyperboloid that is taken away.
intersection {
  quadric { <1, 0, 2>, 0, -y, 0 }
  box { <-3, -2, -3>, <3, 2.5, 3> }
  pigment { rgb <.2, .6, .3> } finish { phong .8 reflection .1 } translate <-1, -1.6, 1.5>
}
quadric {
  <0, 1, 1>, 0, 3*x, 0
  pigment { rgb <.8, .7, .2> } clipped_by { box { <-1.5, -4, -4>, 4 } } scale .5 translate <-1, 3.2, 2>
}
difference {
  sphere { 0, 1 }
  quadric { <4, 4, -1>, 0, 0, -.2 }
  pigment { rgb <.7, .7, .8> } rotate <20, -30, 0> translate <-3, -1, -3>
}
// Superellipsoids.
superellipsoid {
  <.2, .2>
  pigment { rgb <.8, .6, .3> } finish { phong .6 } rotate 35*y scale .8 translate <2.6, -1.2, -3>
}
superellipsoid {
  <1.6, .7>
  pigment { rgb <.6, .2, .4> } finish { phong .6 } rotate <60, 0, 20> translate <.3, -1, -3.4>
}
// A torus, and a cube whose faces bulge.
quartic {
  <1, 0, 0, 0, 2, 0, 0, 2, 0, -10.4, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
   1, 0, 0, 2, 0, 9.6, 0, 0, 0, 0, 1, 0, -10.4, 0, 23.04>
  pigment { rgb <.3, .6, .6> } finish { specular .6 } scale .6 rotate <-50, 0, 10> translate <1.6, 1.2, 1>
}
quartic {
  <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
   1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, -1>
  pigment { rgb .7 } finish { reflection .2 } rotate <0, 20, 0> translate <5, -1, -2.6>
}
