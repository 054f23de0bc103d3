// Clear bodies: light passes uncoloured, bends only where an ior is given, and is mirrored.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 12 adc_bailout 0 }
camera { location <0, 2.5, -8> look_at <0, .9, 0> angle 40 }
light_source { <-5, 8, -6> rgb .9 }
plane { y, 0 pigment { checker rgb .9, rgb <.2, .3, .5> } }
plane { -z, -6 pigment { gradient y color_map { [0 rgb <.9, .7, .5>] [1 rgb <.3, .3, .6>] } scale 4 } }
#declare Clear = texture { pigment { rgb 1 transmit .9 } finish { ambient 0 diffuse 0 phong .6 phong_size 80 reflection .1 } }
sphere { <-1.5, 1.1, 0>, 1 texture { Clear } interior { ior 1.4 } }
box { <.4, .1, -1>, <2, 1.6, .4> texture { Clear } interior { ior 1.2 } rotate 15*y }
cylinder { <0, .1, -2.2>, <0, .7, -2.2>, .45 texture { pigment { rgb 1 filter .8 } finish { ambient 0 diffuse 0 reflection .2 } }
           interior { ior 1.33 } }
difference {
  sphere { 0, .5 }
  sphere { 0, .4 }
  texture { pigment { rgb 1 transmit .9 } finish { ambient .6 diffuse 0 reflection { .05, 1 fresnel on } } }
  interior { ior 1.5 }
  translate <-.7, .55, -3>
}
