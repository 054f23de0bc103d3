// Triangles in all their forms, and bodies of flat faces.
#version 3.7;
global_settings { assumed_gamma srgb adc_bailout 0 }
camera { location <1, 3.5, -7> look_at <0, .8, 0> angle 45 }
light_source { <-5, 7, -6> rgb 1 }
plane { y, 0 pigment { rgb <.5, .55, .5> } }
mesh2 {
  vertex_vectors { 5, <-1, 0, -1>, <1, 0, -1>, <1, 0, 1>, <-1, 0, 1>, <0, 1.6, 0> }
  texture_list { 2, texture { pigment { rgb <.9, .5, .2> } }, texture { pigment { rgb <.3, .6, .9> } } }
  face_indices { 4, <0, 1, 4>, 0, <1, 2, 4>, 1, <2, 3, 4>, 0, <3, 0, 4>, 1 }
  rotate 20*y translate <-1.9, 0, .3>
}
mesh {
  smooth_triangle { <0, 0, 0>, <-.5, .4, -1>, <1.6, 0, 0>, <.5, .4, -1>, <.8, 1.8, 0>, <0, 1, -.6> }
  triangle { <0, 0, 0>, <1.6, 0, 0>, <.8, 0, -1> }
  pigment { rgb <.6, .9, .6> } finish { phong .6 } translate <.6, .2, -.5>
}
prism { 0, .5, 6, <0, 0>, <1, 0>, <1, 1>, <.5, .4>, <0, 1>, <0, 0> pigment { rgb <.9, .8, .3> } rotate 30*y translate <1.4, 0, 1.6> }
prism { conic_sweep linear_spline 0, 1, 5, <.6, .6>, <-.6, .6>, <-.6, -.6>, <.6, -.6>, <.6, .6>
        rotate 180*x translate <-.6, 1, -1.9> pigment { rgb <.8, .4, .7> } }
polygon { 5, <0, 0>, <1.2, 0>, <1.2, 1>, <0, 1>, <0, 0> pigment { checker rgb 1, rgb <.8, .1, .1> scale .3 } rotate -20*x translate <-.6, .1, 2.2> }
