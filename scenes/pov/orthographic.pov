// Parallel rays of an orthographic camera, whose picture is as wide as what an angle of 40 degrees shows at look_at.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 }

camera {
  orthographic
  location <3, 4, -6>
  right 4/3*x
  look_at <0, 0.7, 0>
  angle 40
}

light_source { <-6, 9, -8>, rgb 1 }
background { rgb <0.2, 0.3, 0.5> }

plane {
  y, 0
  pigment { checker rgb <0.8, 0.8, 0.7>, rgb <0.3, 0.35, 0.3> }
  finish { ambient 0.1 diffuse 0.8 reflection 0.2 }
}

// Lines that are parallel in space are parallel in the picture.
#for (I, -3, 3)
  box {
    <I - 0.15, 0, -2>, <I + 0.15, 0.4 + 0.1*I, 2>
    pigment { rgb <0.6 + 0.1*I, 0.3, 0.6 - 0.1*I> }
    finish { ambient 0.1 diffuse 0.7 }
  }
#end

sphere {
  <0, 1.4, 0>, 0.8
  pigment { rgbt <0.9, 0.95, 1, 0.8> }
  finish { ambient 0 diffuse 0.2 reflection 0.1 phong 0.5 phong_size 60 }
  interior { ior 1.4 }
}
