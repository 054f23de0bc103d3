// A camera whose x axis points the other way, in linear light; patterns that move with their bodies, or do not.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 6 adc_bailout 0 }
camera { location <6, -8, 5> sky z right -4/3*x angle 40 look_at <0, 0, .8> }
light_source { <4, -9, 8> rgb 1.2 }
sky_sphere { pigment { gradient z color_map { [0 rgb <.9, .85, .8>] [1 rgb <.2, .4, .8>] } } }

#declare Stripes = texture { pigment { gradient x triangle_wave color_map { [0 rgb <.1, .1, .4>] [1 rgb <1, .9, .3>] }
                             scale .7 rotate 30*z } finish { diffuse .8 } }
#declare Ball = sphere { 0, 1 }
plane { z, 0 pigment { brick rgb .6, rgb <.6, .25, .2> brick_size <1.2, .6, .5> mortar .08 } finish { diffuse .7 } }
object { Ball texture { Stripes } translate <-1.4, 1, 1> }        // the stripes move with the ball
object { Ball translate <1.4, 1, 1> texture { Stripes } }         // the ball moves, the stripes stay
#default { texture { pigment { checker rgb 1, rgb <.2, .5, .3> scale .3 } finish { ambient .2 } } }
object { Ball scale .8 rotate 20*x translate <0, -1.2, .8> }      // the texture of its use, not of its declaration
box { -.5, .5 pigment { wood scale .3 color_map { [0 rgb <.5, .3, .1>] [.7 rgb <.9, .7, .4>] [1 rgb <.3, .15, .05>] } }
      rotate <30, 45, 0> translate <-2.2, -1.6, .8> }
box { -.5, .5 rotate 45*z translate <2.4, -1.4, .5>
      pigment { gradient <1, 1, 0> color_map { [0 rgb 0] [.5 rgb <.9, .1, .1>] [1 rgb 1] } } }
