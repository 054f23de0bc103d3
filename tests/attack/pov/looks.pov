#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 9 ambient_light rgb .5 }
camera { perspective location <0, 1, -5> look_at y right x*4/3 angle 50 }
light_source { <5, 9, -7>, rgb 1 spotlight radius 9 falloff 20 point_at y area_light x, z, 3, 3 adaptive 1
    fade_power 2 }
background { rgb <.2, .3, .4> }
fog { fog_type 2 distance 9 rgb .5 fog_offset 1 fog_alt 2 turbulence .3 }
sky_sphere { pigment { gradient y color_map { [0 rgb 1] [.5 rgbt <0, 0, 1, .5>] [1 rgb z] } } }
#default { finish { ambient .1 diffuse .8 } }
#declare T = texture { pigment { bozo color_map { [0 rgb x] [1 rgbf <0, 1, 0, .5>] } warp { turbulence .4 octaves
    3 } }
    normal { bumps .4 scale .2 } finish { phong .5 specular .3 roughness .01 reflection { .1, .5 fresnel on } } }
#declare M = material { texture { T } interior { ior 1.5 fade_distance 2 fade_power 1 fade_color rgb y } }
sphere { 0, 1 material { M } } box { -1, 1 rotate <9, 8, 7> no_shadow } plane { y, -1 pigment { checker rgb 0,
    rgb 1 } }
