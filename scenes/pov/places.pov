// Textures by uv: on balls, boxes, toruses and turned bodies, where POV-Ray has a map of its own, on a mesh, and by x
// and y of the scene on all other bodies; in parts of composites; normals by uv, whose directions are those of the
// scene; and bumps of a body without an inside, which light from behind reaches.
#version 3.7;
global_settings { assumed_gamma 1 }

camera { location <0, 2.5, -9> right x*4/3 look_at <0, .3, 0> angle 50 }
light_source { <-20, 40, -30>, 1 }
light_source { <30, 5, 20>, .6 }
background { rgb .1 }
plane { y, -1.5 pigment { checker rgb .2, rgb .4 } }

#declare Tiles = pigment { uv_mapping checker rgb <1, .2, .1>, rgb <.1, .3, 1> scale <.1, .1, 1> }
#declare Hills = texture { uv_mapping pigment { rgb <.8, .7, .5> } normal { bumps 1 scale .05 } finish { specular .4 } }
#declare Dents = normal { bumps .8 scale .1 }

sphere { <-3, 1.6, 0>, .8 pigment { Tiles } normal { uv_mapping Dents } scale <1, 1, 1.2> }
sphere { 0, .8 pigment { Tiles } scale <1, .6, 1.2> rotate <20, 30, 40> translate <-1.2, 1.9, 0> }
box { -1, 1 pigment { Tiles } scale <.7, .6, -.5> rotate <30, 40, 0> translate <.8, 1.8, 0> }
box { -1, 1 texture { Hills rotate 40 } scale .6 rotate <30, 40, 0> translate <2.9, 1.6, 0> }
torus {
  .7, .3
  uv_mapping texture { pigment { Tiles } normal { granite .4 scale .3 rotate 20 } } rotate -50*x translate -3*x
}
cylinder { -y, y, .4 uv_mapping pigment { granite scale .3 } normal { wrinkles 1 scale .3 } rotate z*30 translate -x }
difference {
  sphere { 0, .7 }
  box { <0, 0, -1>, 1 }
  uv_mapping pigment { brick scale .03 } translate <.8, 0, -.5>
}
mesh2 {
  vertex_vectors { 4, <-1, -1, 0>, <1, -1, 0>, <1, 1, 0>, <-1, 1, 0> }
  uv_vectors { 4, <0, 0>, <2, 0>, <1, 2>, <0, 1> }
  face_indices { 2, <0, 1, 2>, <0, 2, 3> }
  texture { pigment { uv_mapping checker rgb 1, rgb .5 scale .2 } normal { uv_mapping bumps 1 scale .1 } }
  rotate <40, -30, 0> scale .7 translate <2.5, 0, -1>
}
mesh {
  triangle { <-1, 0, 0>, <1, 0, 0>, <0, 1.5, .5> }
  texture { Hills } rotate 20*y translate <-1.2, -1.4, -2.5>
}
polygon {
  4, <-1, 0, 0>, <1, 0, 0>, <1, 1.2, .6>, <-1, 1.2, .6>
  pigment { uv_mapping gradient x + y scale .4 } normal { bumps 1 scale .2 } translate <1.2, -1.4, -2.5>
}
lathe {
  cubic_spline 6, <0, -1>, <.4, -.6>, <.5, 0>, <.3, .4>, <.2, .8>, <.2, 1>
  pigment { Tiles } scale .7 rotate -20*x translate <-3.2, -.9, -2.5>
}
sor {
  5, <.2, -1>, <.5, -.5>, <.4, .2>, <.2, .6>, <.2, 1>
  pigment { Tiles } scale .7 rotate -20*x translate <3, -.9, -2.5>
}
// As the converter writes a torus: its place first.
torus {
  .4, .2 matrix <1, 0, 0, 0, 0, 1, 0, -1, 0, 3, -.9, -2.5>
  pigment { gradient y scale .3 } normal { bumps .4 scale .1 } rotate 5*z
}
