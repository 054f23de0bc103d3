// Light that comes through layers, and through coloured glass, is followed no further where little of it is left.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1.6, -6> look_at <0, 1, 0> right 4/3*x angle 42 }
light_source { <-5, 8, -6> rgb 1 }
plane { y, 0 pigment { checker rgb <.9, .8, .6>, rgb <.2, .3, .5> } }
sphere {
    <-1.2, 1, 0>, 1
    texture { pigment { rgb <1, .2, 0> } finish { ambient 1 reflection .6 } }
    texture {
        pigment { gradient y color_map { [0 rgbt <.1, .1, .1, .01>] [1 rgb .1] } scale 2 }
        finish { ambient 0 diffuse 0 conserve_energy reflection .1 }
    }
    texture { pigment { gradient x color_map { [0 rgb .2] [.4 rgbf <.3, .9, .6, .9>] [1 rgbt <.2, .2, .2, .9>] } scale 2.2 } }
}
box {
    <.2, .1, -.4>, <2, 1.9, .4>
    pigment { gradient y color_map { [0 rgbf <1, 0, 0, .02>] [1 rgbf <0, 0, 1, .02>] } scale 2 }
    finish { ambient 0 diffuse 0 }
    rotate 20*y
}
