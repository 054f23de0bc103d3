#declare P = pigment { image_map { function 4, 3 { pigment { gradient x color_map { [0 rgb x] [1 rgbt <0, 1, 0, .5>] }
    } } interpolate 2 once filter all .2 transmit all .1 map_type 1 } turbulence .3 warp { repeat x } scale .5 }
#declare F = function { pigment { P } }
#declare G = function { pattern { image_pattern { function 2, 2 { x * y } } } }
sphere { x * F(.1, .2, .3).red, G(.1, .2, .3) + 1
    pigment { bozo pigment_map { [.2 P] [.7 average pigment_map { [1 P] [2 rgb z] }] } }
    normal { bump_map { function 3, 3 { sin(9 * x) } interpolate 3 bump_size 2 } } }
box { -1, 1 pigment { P rotate 9 } normal { facets coords .5 size .3 metric 1 } }
box { <0, 1, 0>, <2, 3, 2> normal { gradient y .5 poly_wave 2 slope_map { [0 <0, 1>] [1 <1, -1>] } } no_shadow }
mesh2 { vertex_vectors { 3, 0, x, y } uv_vectors { 3, <0, 0>, <1, 0>, <0, 1> } face_indices { 1, <0, 1, 2> }
    uv_mapping pigment { checker pigment { P } pigment { rgb y } scale .3 } }
polygon { 10, 0, 4*x, 4*x + 4*y, 4*y, 0, x + y, 3*x + y, 2*x + 3*y, <0, 1>, x + y
    texture { uv_mapping pigment { P } } }
difference { box { 0, 4 } union { sphere { 4, 1 } box { 1, <2, 4, 2> } cylinder { <1, 3, 1>, <1, 4, 1>, .5 } } }
plane { y, 3 } light_source { <1, 3, 1> rgb 1 } camera { location <0, 3, -5> look_at 0 }
