// Finishes that only POV-Ray has: Blinn's highlights, metals, brilliance, layers, colours that let light through,
// reflection by the angle, and lights that fade or cast no shadow.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 adc_bailout 0 }

camera { location <1, 5, -12> right x*4/3 look_at <.3, .9, 0> angle 42 }
background { rgb <.35, .45, .6> }

light_source { <-8, 11, -9>, rgb <1, .95, .85> }
light_source { <9, 5, -7>, rgb <.5, .55, .8> fade_distance 8 fade_power 2 }
light_source { <2, 8, 6>, rgb .25 shadowless }

plane { y, 0
  texture { pigment { checker rgb <.8, .75, .7>, rgb <.3, .35, .3> } finish { diffuse .8 brilliance 1.5 } }
  texture { pigment { rgbt <.3, .1, .05, .75> } }
}
// Brass and copper.
sphere { <-3, 1, 0>, 1
  pigment { rgb <.8, .6, .2> }
  finish { ambient .1 diffuse .4 brilliance 3 specular .8 roughness .02 metallic reflection { .1, .5 falloff 2 metallic } } }
sphere { <-1.6, .6, -2.4>, .6
  pigment { rgb <.9, .45, .3> }
  finish { ambient rgb <.1, .05, .02> diffuse .5 phong .6 phong_size 30 specular .3 roughness .1 metallic .7
           reflection rgb <.3, .15, .1> } }
// Layers: specks of blue below, clear stripes above.
box { <-1, 0, .6>, <.8, 2, 2.4>
  texture { pigment { bozo color_map { [.4 rgb <.9, .85, .7>] [.6 rgb <.2, .3, .6>] } scale .4 } finish { specular .4 } }
  texture { pigment { gradient y turbulence .3 color_map { [0 rgbft <.8, .3, .2, .2, .1>] [.5 rgbt <1, 1, 1, 1>] [1 rgbt 1] }
                      scale .5 }
            finish { phong .5 ambient .05 } }
  rotate y*25
}
// Stained glass, and a bubble.
sphere { <1.9, 1.1, -.6>, 1.1
  pigment { rgbft <.9, .3, .2, .7, .1> }
  finish { diffuse .3 specular .6 roughness .004 reflection { .05, .9 fresnel on } }
  interior { ior 1.4 } }
sphere { <.3, .7, -2>, .7
  pigment { rgbf <.8, 1, .9, .9> }
  finish { ambient 0 diffuse .1 phong .8 phong_size 80 } }
// A body without a shadow.
cylinder { <3.9, 0, 1>, <3.9, 2.2, 1>, .5
  pigment { rgb <.3, .7, .4> } finish { emission .2 specular .2 } no_shadow }
