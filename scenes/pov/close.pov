// A slab so close to a light that it covers it only for what is above; clear rods on which bodies without shadow lie; and
// mirrors in fog that leaves little light, which reflect as others do.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 3, -9> look_at <0, 1.6, 0> angle 55 }

light_source { <-1.5, 2.4995, 0> rgb .8 }
light_source { <4, 9, -7> rgb .5 }
#default { finish { ambient .1 diffuse .7 } }
box { <-2.8, 2.5, -1>, <-.4, 2.7, 1> pigment { rgb <.9, .6, .4> } }
sphere { <-1.5, 3.4, .4>, .5 pigment { rgb <.9, .9, .5> } }

#local I = 0;
#while (I < 8)
    cylinder { <-2 + .1 * I, .3, -2.5 + .12 * I>, <2 - .15 * I, .5 + .25 * sin(I), -2.4 + .1 * I>, .16
        pigment { rgbt <.1, .3, .9, .8> } }
    sphere { <-1.8 + .5 * I, .3, -2.5 + .12 * I>, .3 pigment { rgb <.9, .2, .3> } no_shadow }
    #local I = I + 1;
#end

plane { y, 0 pigment { checker rgb .3 rgb .8 scale .7 } finish { reflection .2 } }
fog { fog_type 2 distance 12 rgb <.7, .75, .8> fog_offset .2 fog_alt .3 }
sky_sphere { pigment { gradient y color_map { [0 rgb <.6, .7, 1>] [1 rgb <.1, .2, .8>] } } }
