// Surfaces with two sides: open bodies, triangles in meshes, one with normals on the other side, polygons and height
// fields; parts of composites, which show their outer side where they are cut; bodies turned inside out; glass, and
// shadows through both sides; parts with a texture of their own; textures in their places.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }

camera { location <0, 7, -14> look_at <0, .5, 0> angle 45 }
light_source { <-6, 10, -9>, rgb .9 }
light_source { <5, 4, -3>, rgb <.3, .3, .5> }
plane { y, -1 pigment { checker rgb .7, rgb .5 } }

#declare Outer = texture { pigment { checker rgb <1, .2, .1>, rgb <.9, .8, .3> scale .3 } finish { diffuse .7 phong .4 } }
#declare Inner = texture {
  pigment { gradient x color_map { [0 rgb <.1, .2, 1>] [1 rgb <.1, 1, .3>] } scale .4 }
  finish { diffuse .5 ambient .2 }
}
#declare Amber = texture { pigment { rgbf <.9, .6, .2, .6> } finish { diffuse .4 phong .8 } }
#declare Veil = texture { pigment { rgbt <.2, .4, .9, .3> } finish { diffuse .5 reflection .2 } }
#declare Both = material { texture { Outer } interior_texture { Inner } }
#declare Glass = material { texture { Amber } interior_texture { Veil } interior { ior 1.2 } }

cylinder { 0, y, .6 open material { Both } rotate x*-30 translate <-5, 0, -2> }
cone { 0, .7, y, .3 open material { Both } rotate <40, 0, 20> translate <-3, 0, -2> }
mesh {
  triangle { <-.7, 0, 0>, <.7, 0, 0>, <0, 1, .3> }
  triangle { <.7, 0, 0>, <0, 1, .3>, <1.4, 1, .2> }
  material { Both } translate <-1.5, 0, -2>
}
mesh {
  triangle { <-.7, 0, 0>, <.7, 0, 0>, <0, 1, .3> }
  material { Both } scale <-1, 1, 1> rotate y*10 translate <.8, 0, -2>
}
mesh {
  smooth_triangle { <-.7, 0, 0>, <-.3, .2, 1>, <.7, 0, 0>, <.3, .2, 1>, <0, 1, .3>, <0, .4, 1> }
  material { Both } translate <2.5, 0, -2>
}
smooth_triangle {
  <-.7, 0, 0>, <-.3, .2, 1>, <.7, 0, 0>, <.3, .2, 1>, <0, 1, .3>, <0, .4, 1>
  texture { Outer } interior_texture { Amber } translate <4, 0, -2>
}
sphere { 0, .6 material { Glass } translate <5.4, 0, -2> }
disc { 0, <0, .4, -1>, .7, .2 material { Both } translate <-5, 0, 1> }
disc { 0, <0, -.4, 1>, .7, .2 material { Both } translate <-3, 0, 1> }
difference { sphere { 0, .9 } box { <-1, 0, -1>, <1, 1, 1> } material { Both } translate <-1, 0, 1> }
sphere { 0, .7 inverse material { Both } translate <1, 0, 1> }
box { -.6, .6 texture { Veil } interior_texture { Amber } rotate y*30 translate <3, 0, 1> }
intersection { box { -.6, .6 } sphere { 0, .7 inverse } material { Both } translate <5, 0, 1> }
polygon { 5, <-.6, 0>, <.6, 0>, <.6, 1>, <-.6, 1>, <-.6, 0> material { Both } translate <-5, 0, 4> }
polygon { 5, <-.6, 0>, <-.6, 1>, <.6, 1>, <.6, 0>, <-.6, 0> material { Both } translate <-3.3, 0, 4> }
height_field {
  function 9, 9 { (x - .5)*(y - .5)*3 + .5 }
  material { Both } translate <-.5, -.5, -.5> rotate x*150 translate <-1.6, .5, 4>
}
union {
  sphere { 0, .5 }
  box { 0, 1 pigment { rgb <1, 0, 1> } }
  cylinder { x, 2*x, .4 open }
  texture { Amber } interior_texture { Inner } rotate y*40 scale .7 translate <0, 0, 4>
}
lathe { linear_spline 4, <.2, 0>, <.6, .3>, <.3, .8>, <.5, 1.1> material { Both } rotate x*-40 translate <3, 0, 4> }
mesh2 {
  vertex_vectors { 4, <-.6, 0, 0>, <.6, 0, 0>, <.6, 1, 0>, <-.6, 1, .3> }
  texture_list { 2, texture { pigment { rgb x } } texture { pigment { rgb z } } }
  face_indices { 2, <0, 1, 2>, 0, <2, 0, 3>, 1 }
  texture { Outer } interior_texture { Inner } rotate y*160 translate <5, 0, 4>
}
