sphere { 0, 1 } box { -1, 1 rotate <9, 8, 7> no_shadow } plane { y, -1 pigment { checker rgb 0,
    rgb 1 } }
cylinder { 0, y, .5 open } cone { 0, 1, y, 0 } torus { 1, .2 } disc { 0, y, 2, 1 }
superellipsoid { <.3, .4> } lathe { cubic_spline 5, <0, 0>, <1, 0>, <1, 1>, <.5, 2>, <0, 2> }
sor { 4, <.1, -1>, <.4, 0>, <.5, 1>, <.1, 2> } prism { 0, 1, 5, <0, 0>, <1, 0>, <1, 1>, <0, 1>, <0, 0> }
prism { conic_sweep bezier_spline 0, 1, 4, <0, 0>, <1, 0>, <1, 1>, <0, 0> } text { ttf "timrom.ttf", "ab", .1, 0 }
sphere_sweep { b_spline 4, 0, .1, x, .2, y, .1, z, .3 } polygon { 4, 0, x, x + y, 0 }
mesh { triangle { 0, x, y } smooth_triangle { 0, z, x, z, y, z } inside_vector y }
mesh2 { vertex_vectors { 4, 0, x, y, z } uv_vectors { 3, <0, 0>, <1, 0>, <0, 1> } face_indices { 2, <0, 1, 2>,
    <1, 2, 3> } }
difference { union { sphere { 0, 1 } box { 0, 1 } split_union off } merge { sphere { x, 1 } sphere { y, 1 } } inverse
    cutaway_textures texture { pigment { pigment_pattern { wood } pigment_map { [0 agate] [1 granite] } } } }
intersection { plane { x, 1 } sphere { 0, 2 } bounded_by { clipped_by } hollow interior { media { absorption 1 } } }
object { sphere { 0, 1 } texture { brick texture { pigment { rgb x } }, texture { pigment { rgb 1 } } mortar .1 }
    translate x }
#declare O = object { union { sphere { 0, 1 } light_source { y, rgb 1 looks_like { sphere { 0, .1 } } } } }
#declare N = <0, 0, 0>; #declare H = trace(O, <0, 0, -9>, z, N); #if (inside(O, H)) object { O translate
    max_extent(O) } #end
