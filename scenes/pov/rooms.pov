// A room that is a merge, with the camera inside: a surface inside another part is not seen from within. In it parts of
// composites with an interior of their own, a sheet where two planes are one, maps in maps that use a texture several
// times, and a mesh with patterns, the planes of whose triangles POV-Ray keeps in single precision. Lights are one whose
// points turn to what they light, and spotlights that shine to all sides before them.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 8 }

camera { location <0, 2.4, -6.4> right x*image_width/image_height look_at <0, .9, 0> angle 58 }
light_source { <-2, 4.4, -3> rgb .5 area_light .8*x, .8*z, 7, 7 circular orient }
light_source { <2.5, 4.2, -1> rgb <.5, .4, .3> spotlight point_at <2.2, 0, -.8> radius 95 falloff 140 }
light_source { <0, 3.5, 1.8> rgb <.2, .3, .5> spotlight point_at <0, 3, 9> radius 120 falloff 100 tightness 2 }

merge {
  box { <-5, 0, -7>, <5, 5, 2.5> }
  sphere { <0, 2, 2>, 2.6 }
  cylinder { <-6, 2.5, 0>, <6, 2.5, 0>, 1.2 }
  pigment { checker rgb <.8, .8, .75>, rgb <.6, .65, .7> scale .8 }
}

#declare Clear = texture { pigment { rgbf <.95, 1, .97, .9> } finish { diffuse .1 reflection .1 phong .6 } }
intersection {
  sphere { 0, .7 }
  sphere { <0, .1, -.5>, .7 interior { ior 1.1 } }
  texture { Clear } interior { ior 1.5 } translate <-2.4, .75, -1.2>
}
difference {
  box { <-.6, 0, -.5>, <.6, 1, .5> }
  sphere { <0, 1, -.2>, .45 interior { ior 1.2 } }
  texture { Clear } interior { ior 1.4 } rotate 20*y translate <-1.1, .01, -2.6>
}

#declare N = vnormalize(<3, 5, -3>);
intersection { plane { N, .5 } plane { -N, -.5 } sphere { 0, .9 } pigment { rgb <.9, .3, .2> } translate <.5, .45, -1.6> }

#declare Shine = texture { pigment { rgb <.9, .7, .2> } finish { phong .8 reflection .1 } }
#declare Dull = texture { pigment { granite color_map { [0 rgb <.2, .3, .6>] [1 rgb <.7, .8, .9>] } scale .4 } }
#declare Inner = texture { gradient y texture_map { [0 Shine] [.3 Dull] [.7 Shine] [1 Dull] } scale .3 }
sphere {
  <2, .7, -1.6>, .7
  texture { bozo texture_map { [.2 Dull] [.4 Inner] [.6 Shine] [.7 Inner] [.9 Dull] } scale .35 }
}
#declare Bands = pigment { gradient y color_map { [0 rgb <.1, .2, .8>] [1 rgb 1] } scale .1 }
box {
  <-.5, 0, -.5>, <.5, .8, .5>
  pigment {
    checker
    pigment { radial pigment_map { [0 rgb x] [.5 Bands] [.8 rgb x] [1 Bands] } frequency 4 }
    pigment { Bands rotate 40*z }
    scale .27
  }
  rotate 35*y translate <2.7, 1.7, .2>
}

mesh {
  #for (I, 0, 4)
    #for (K, 0, 3)
      triangle { <I, sin(I*1.3 + K)*.3, K>/5, <I + 1, sin(I*1.3 + 1.3 + K)*.3, K>/5, <I + .4, cos(I + K*2)*.3, K + 1>/5 }
    #end
  #end
  pigment { crackle color_map { [0 rgb <.1, .3, .1>] [1 rgb <.6, 1, .5>] } scale .05 }
  normal { bumps .5 scale .03 }
  rotate <-50, 15, 0> scale 1.6 translate <-1.2, 1.4, .3>
}
