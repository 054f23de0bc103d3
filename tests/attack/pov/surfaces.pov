blob { threshold .5 sphere { 0, 1, 1 } cylinder { 0, x, .5, 1 scale 2 } component 1, 1, y }
quadric { <1, 1, -1>, 0, 0, -1 } cubic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, -1> clipped_by
    { sphere { 0, 2 } } }
isosurface { function { x*x + abs(y) + sin(3*z) - .5 } threshold .1 contained_by { sphere { 0, 1 } } max_gradient
    4 open }
parametric { function { sin(u)*v } function { 1/u }, function(a, b) { b } <-1, -1>, <1, 1> contained_by { box { -2, 2 } }
    precompute 3 x, y, z }
bicubic_patch { type 1 flatness 0 u_steps 2 v_steps 2 <0,0,0> <1,0,0> <2,0,0> <3,0,0> <0,1,0> <1,1,1> <2,1,1> <3,1,0>
    <0,2,0> <1,2,1> <2,2,1> <3,2,0> <0,3,0> <1,3,0> <2,3,0> <3,3,0> uv_mapping }
height_field { function 5, 4 { pigment { crackle form <-1, 1, 0> metric 1 } } smooth water_level .1 }
julia_fractal { <.1, .2, .3, .4> hypercomplex pwr(2, .1) max_iteration 3 slice <0, .1, 0, 1>, .1 precision 20 cube }
sphere_sweep { cubic_spline 5, 0, .1, x, .2, y, .1, z, .3, 2*x, 0 tolerance .1 }
