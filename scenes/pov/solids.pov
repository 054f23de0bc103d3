// Solid patterns: stones, woods and clouds, and bumps of noise.
#version 3.7;
global_settings { assumed_gamma 1 }

camera { location <0, 3.2, -13> right x*4/3 look_at <0, 2.2, 0> angle 54 }
sky_sphere { pigment { gradient y color_map { [0 rgb <.7, .75, .8>] [1 rgb <.2, .4, .7>] } } }
light_source { <-7, 12, -10>, rgb 1 }

#declare Two = color_map { [0 rgb <.15, .1, .08>] [.45 rgb <.75, .55, .35>] [1 rgb <1, .95, .85>] };
#declare Clear = finish { ambient .15 diffuse .75 };

#macro Ball(I, J, P)
  sphere { 0, .72
    pigment { P color_map { Two } scale .45 }
    finish { Clear } translate <(I - 3)*1.75, .8 + J*1.6, 0> }
#end
#macro Bumpy(I, N)
  sphere { 0, .72
    pigment { rgb <.75, .7, .6> } normal { N scale .25 }
    finish { Clear phong .4 } translate <(I - 3)*1.75, .8, -1.6> }
#end

Ball(0, 1, pigment { granite })
Ball(1, 1, pigment { agate })
Ball(2, 1, pigment { wrinkles })
Ball(3, 1, pigment { crackle })
Ball(4, 1, pigment { leopard frequency 2 })
Ball(5, 1, pigment { bozo turbulence .6 octaves 4 })
Ball(6, 1, pigment { onion sine_wave frequency 3 })
Ball(0, 2, pigment { marble turbulence .8 })
Ball(1, 2, pigment { wood turbulence .15 })
Ball(2, 2, pigment { gradient <1, 1, 0> turbulence .4 triangle_wave })
Ball(3, 2, pigment { spherical turbulence .2 scallop_wave frequency 2 })
Ball(4, 2, pigment { radial frequency 6 cubic_wave })
Ball(5, 2, pigment { dents })
Ball(6, 2, pigment { quilted })
Bumpy(0, normal { bumps .6 })
Bumpy(1, normal { dents 1 })
Bumpy(2, normal { wrinkles .8 })
Bumpy(3, normal { ripples .5 frequency 2 })
Bumpy(4, normal { granite .3 })
Bumpy(5, normal { waves .4 frequency 3 phase .2 })
Bumpy(6, normal { bozo .7 turbulence .3 })
plane { y, 0 pigment { rgb .6 } finish { Clear } }
