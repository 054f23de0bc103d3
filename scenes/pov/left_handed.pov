// Bodies of all simple kinds, before POV-Ray's usual camera: z points into the picture.
camera { location <1, 4, -9> look_at <0, 1, .5> angle 48 }
light_source { <-6, 9, -7> rgb <1, .95, .9> }
light_source { <7, 5, -2> rgb .35 }
background { rgb <.15, .2, .3> }
global_settings { max_trace_level 8 adc_bailout 0 }
#default { finish { ambient .15 diffuse .7 phong .4 phong_size 30 } }

plane { y, 0 pigment { checker rgb <.8, .8, .7>, rgb <.3, .35, .3> } finish { phong 0 reflection .1 } }
sphere { <-2.5, 1, 0>, 1 pigment { rgb <.9, .3, .2> } }
box { <-.8, 0, -1>, <.7, 1.4, .4> pigment { rgb <.3, .5, .9> } rotate 25*y translate <.2, 0, .5> }
cylinder { <2, 0, 1>, <2.3, 1.8, .8>, .6 pigment { rgb <.4, .8, .4> } }
cone { <-1.2, 0, 2.5>, .9, <-1.2, 2.6, 2.5>, .2 pigment { rgb <.9, .8, .3> } }
torus { .8, .25 pigment { rgb <.7, .4, .8> } rotate -35*x translate <1.5, .8, -1.9> }
disc { <3.6, 1.5, 2>, <-1, .2, -1>, 1, .4 pigment { rgb <.9, .6, .6> } }
triangle { <-4.5, 0, 2>, <-3, 0, 3>, <-3.8, 2.5, 2.6> pigment { rgb <.5, .9, .9> } }
sphere { 0, .5 scale <1.6, .6, 1> rotate <0, 40, 20> translate <-1.1, .7, -2> pigment { rgb <1, .9, .8> } }
