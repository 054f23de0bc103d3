// Spotlights, parallel light, and a light that moves with its own transformations.
global_settings { adc_bailout 0 }
camera { location <0, 6, -9> look_at <0, .5, 0> angle 50 right x*1.5 up y }
light_source { <-4, 6, -2> rgb <1, .6, .4> spotlight point_at <-1.5, 0, 0> radius 12 falloff 20 tightness 3 }
light_source { <0, 7, -1> rgb <.4, .7, 1> spotlight radius 8 falloff 25 point_at <1, 0, 0> rotate -20*z }
light_source { <3, 10, -5> rgb .25 parallel point_at <0, 0, 0> }
light_source { 0 rgb <.2, .3, .2> translate <6, 3, -6> }
plane { y, 0 pigment { rgb .8 } finish { ambient .05 diffuse .9 } }
#for (I, -2, 2)
  sphere { <I*1.4, .6, abs(I)*.4>, .6 pigment { rgb 1 } finish { ambient .05 diffuse .8 phong .5 } }
#end
