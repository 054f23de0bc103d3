// A bumpy pane before the eye, whose colours let other light through at each place, and a wall whose pattern is so fine
// that it shows by how much rays are bent.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location -5*z right 4/3*x look_at 0 }
light_source { <-9, 9, -9>, 1 }
plane {
    z, -4.8
    hollow no_shadow
    pigment { gradient x color_map { [0 rgbf <1, .8, .5, 1>] [1 rgbf 1] } }
    normal { bumps .1 }
    finish { diffuse 0 ambient 0 }
    interior { ior 1.1 }
}
box {
    <-50, -50, 0>, <50, 50, 1>
    pigment { gradient x triangle_wave scale .004 }
    finish { ambient .9 diffuse 0 }
}
