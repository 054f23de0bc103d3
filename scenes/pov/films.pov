// A thin film colours what a floor and a ball reflect.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> right 4/3*x look_at 0 }
background { rgb <.1, .7, .6> }
light_source { <-2, 3, -7>, 1 }
plane { y, -1.1 pigment { rgb <.7, .5, .8> } finish { ambient .1 irid { .3 thickness .5 } diffuse 0 reflection .3 } }
sphere {
    <-.4, -.3, .5>, .6
    pigment { rgb <.3, .1, .1> }
    finish { irid { .4 thickness .9 } reflection { .2, .6 } phong .3 }
}
