"""Writes random scenes in POV-Ray's language, which tests/bench/pov_corpus/run then compares with POV-Ray's pictures.

    python3 tests/bench/pov_corpus/random_scenes.py FIRST LAST FOLDER

A scene FOLDER/SEED.pov for each seed from FIRST to LAST: cameras of all projections, lights of all sorts, fogs and
skies, and 2 to 5 bodies of any kind, of which composites have others as parts, with textures of any pattern, map, warp,
normal and finish. A seed is the same scene everywhere. What Strahl is known to approximate is rare among the words, so
that most scenes open whole, and any difference of these is a fault that nobody chose.
"""
import pathlib
import random
import re
import sys

# A rule has productions, one a line, of which one is taken at random; one that begins with 3* is as likely as three. In
# them $NAME is what the rule NAME makes, $NAME? the same or nothing, and $NAME*2:5 two to five times that; ~1:2 is a
# number from 1 to 2, %1:9 a whole one.
RULES = {
    "global": "global_settings { assumed_gamma $gamma max_trace_level %5:9 $bailout? $ambient? }",
    "gamma": "3*1\n2.2",
    "bailout": "adc_bailout ~.001:.05",
    "ambient": "ambient_light rgb <~.3:1.5,~.3:1.5,~.3:1.5>\nambient_light 0\nnoise_generator %1:3",
    "camera": """
        6*camera { $eye $wide $aim angle ~35:75 }
        camera { $eye sky <~-.4:.4,1,~-.4:.4> $wide $aim angle ~35:75 }
        camera { $eye $wide up y direction z*~1:1.6 $aim }
        camera { $eye right -x*image_width/image_height $aim angle ~35:75 }
        camera { orthographic $eye $aim right x*5*image_width/image_height up y*5 }
        camera { $wider $eye $wide $aim angle ~60:120 }
        camera { spherical $eye $aim angle ~60:180 ~40:120 }
        camera { $eye $wide $aim angle 50 rotate y*~-20:20 translate x*~-.5:.5 }""",
    "eye": "location <~-3:3,~.5:3.5,~-7:-4>",
    "aim": "look_at <~-.5:.5,~.2:.8,~0:1>",
    "wide": "right x*image_width/image_height",
    "wider": "fisheye\nultra_wide_angle\npanoramic\ncylinder %1:4",
    "light": "light_source { <~-8:8,~3:10,~-10:2> color rgb <~.3:.9,~.3:.9,~.3:.9> $lamp }",
    "lamp": """
        6*$fading?
        spotlight $target radius ~5:15 falloff ~15:35 tightness ~0:20 $fading?
        cylinder $target radius ~.5:1.5 falloff ~1.5:3 tightness ~0:10
        parallel $target
        area_light x*~.5:2, z*~.5:2, %2:4, %2:4 $circular? $fading?
        shadowless
        fade_distance ~3:10 fade_power 2 looks_like { sphere { 0, ~.1:.3 $texture } }
        area_light x*~.5:2, z*~.5:2, %2:4, %2:4 orient circular adaptive %0:1 spotlight $target falloff 40""",
    "target": "point_at <~-1:1,0,~0:2>",
    "fading": "fade_distance ~3:10 fade_power $power",
    "power": "1\n2\n1.5",
    "circular": "circular",
    "sky": "\nbackground { $color }\nsky_sphere { $pigment }\nsky_sphere { $pigment $veil $move*0:2 }",
    "fog": """
        fog { distance ~5:30 color $clear }
        fog { distance ~5:30 color $color turbulence ~.1:.9 turb_depth ~.2:1 }
        fog { fog_type 2 distance ~5:30 color $color fog_offset ~-1:1 fog_alt ~.3:2 }
        fog { fog_type 2 distance ~5:30 color $color fog_offset ~-1:1 fog_alt ~.3:2 up <~-.5:.5,1,~-.5:.5> }""",
    "floor": "2*plane { y, ~-1.2:-.8 $texture }\n",
    "body": """
        light_group { light_source { <~-8:8,~3:8,~-8:0> $color } $solid $look $place } global_lights $switch }
        #declare Spline = spline { $spline_kind 0, $vector .4, $vector .8, $vector 1.2, $vector } \
#for (I, .1, 1.1, .2) sphere { Spline(I), ~.1:.3 $look $place } #end
        #macro Body(A, B) $solid rotate A*y scale B $look } #end object { Body(~0:360, ~.5:1.2) $move*0:2 $place }
        6*$solid $look $inside? $interior? $flag? $cut? $move*0:3 $place }
        3*$composite { $part*2:3 $look $interior? $flag? $cut? $move*0:3 $place }
        $sheet $look $inside? $move*0:3 $place }""",
    "composite": "union\ndifference\nintersection\nmerge",
    "part": "3*$solid $move*0:2 $texture? }\n$composite { $solid $move*0:2 } $solid $move*0:2 } $texture? }",
    "look": "5*$texture\ntexture { $pigment $finish } texture { $veil $finish }\n$clear_texture",
    "veil": "pigment { $clear }",
    "place": "translate <~-2.2:2.2,~-.2:1.6,~-1:2.5>",
    "flag": "no_shadow\nno_image\nno_reflection\n3*hollow\ndouble_illuminate\nphotons { target reflection on }\ninverse",
    "switch": "on\noff",
    "spline_kind": "linear_spline\nquadratic_spline\ncubic_spline\nnatural_spline",
    "cut": """
        clipped_by { plane { $vector, ~-.2:.5 } }
        clipped_by { sphere { 0, ~.6:1.2 } }
        clipped_by { box { -1, <~.1:1,~.1:1,~.1:1> } plane { $vector, .6 } }
        bounded_by { sphere { 0, 4 } }
        clipped_by { plane { y, ~-.3:.3 } } bounded_by { clipped_by }""",
    "inside": "interior_texture { $pigment $finish }",
    "interior": "interior { ior ~1:1.8 $fade? }",
    "fade": "fade_power 1 fade_distance ~.3:2 fade_color $color\nfade_power 1000 fade_distance ~.3:2 fade_color $color",
    "move": """
        rotate $angles
        translate <~-1:1,~-1:1,~-1:1>
        scale <~.6:1.6,~.6:1.6,~.6:1.6>
        scale <-1,1,1>
        matrix <1,~-.5:.5,0, 0,1,~-.5:.5, ~-.5:.5,0,1, 0,0,0>""",
    "angles": "<~-180:180,~-180:180,~-180:180>",
    "vector": "<~-1:1,~-1:1,~-1:1>",
    "sheet": """
        disc { 0, $vector, ~.5:1.2
        polygon { 5, <-1,-1>, <1,-.8>, <.9,1>, <-.7,.6>, <-1,-1>
        triangle { $vector, $vector, $vector
        smooth_triangle { <-1,0,0>, <-.3,.2,-1>, <1,0,0>, <.4,.1,-1>, <0,1,.3>, <0,.5,-1>
        bicubic_patch { type 1 u_steps 3 v_steps 3 flatness .01, $row, $row, $row, $row
        mesh2 { vertex_vectors { 3, <-1,-1,0>, <1,-1,.3>, <1,1,0> } face_indices { 1, <0,1,2> }
        mesh2 { vertex_vectors { 4, <-1,-1,0>, <1,-1,.3>, <1,1,0>, <-.8,.9,~-.5:.5> } \
normal_vectors { 4, <-.3,-.3,-1>, <.3,-.3,-1>, <.3,.3,-1>, <-.3,.3,-1> } \
uv_vectors { 4, <0,0>, <1,0>, <1,1>, <0,1> } face_indices { 2, <0,1,2>, <0,2,3> } uv_mapping
        mesh { triangle { <-1,-1,0>, <1,-1,.3>, <1,1,0> } smooth_triangle { <-1,-1,0>, -z, <1,1,0>, <.3,0,-1>, <-1,.8,.5>, -z }
        bicubic_patch { type 0 u_steps 2 v_steps 3 flatness .01, $row, $row, $row, $row
        height_field { function 12, 12 { $heights } $smooth? translate -.5 scale <2,~.5:1.5,2>""",
    "heights": "f_noise3d(x*4,y*4,0)\n.5+.4*sin(x*7)*cos(y*5)\nx*y",
    "smooth": "water_level ~.1:.3",
    "row": "$vector, $vector, $vector, $vector",
    "color": "rgb <~.05:1,~.05:1,~.05:1>",
    "clear": """
        rgbf <~.1:1,~.1:1,~.1:1,~.1:.9>
        rgbt <~.1:1,~.1:1,~.1:1,~.1:.9>
        rgb <~0:1,~0:1,~0:1> filter .3 transmit .4""",
    "stain": "9*$color\n$clear",
    "texture": """
        8*texture { $pigment $normal? $finish }
        texture { $pattern texture_map { [~0:.4 $pigment $finish] [~.4:1 $pigment $normal $finish] } $warped }
        texture { checker texture { $pigment $finish }, texture { $pigment $normal } $move*0:2 }
        texture { $simple texture_map { [0 gradient $axis texture_map { [.3 $pigment] [.7 $pigment $finish] } scale .4] \
[1 $pigment $normal $finish] } $warped }
        texture { brick texture { $pigment $finish }, texture { $pigment $normal $finish } brick_size .5 mortar .1 }""",
    "clear_texture": """
        texture { $veil $finish }
        texture { pigment { $pattern color_map { [~0:.5 $clear] [~.5:1 $color] } $warped } $finish }""",
    "pigment": """
        3*pigment { $color }
        2*pigment { $list $move*0:2 scale ~.2:1 }
        4*pigment { $pattern color_map { [~0:.3 $stain] [~.3:.7 $color] [~.7:1 $stain] } $warped }
        pigment { $pattern pigment_map { [~0:.4 $color] [~.4:1 $list scale ~.2:1] } $warped }
        pigment { average pigment_map { [~.3:2 $color] [~.3:2 $list scale ~.2:1] } }
        pigment { image_map { function 8, 8 { $function } map_type $map_type $once? interpolate $interpolate } $move*0:2 }
        pigment { $pattern pigment_map { [0 $simple color_map { [0 $color] [1 $color] } $warped] [.5 $color] \
[1 gradient $axis pigment_map { [0 $stain] [1 $list scale .3] } scale ~.3:1] } $warped }""",
    "map_type": "0\n1\n2\n5",
    "once": "once",
    "interpolate": "2\n3\n4",
    "list": """
        checker $stain, $color
        hexagon $stain, $color, $color
        brick $color, $stain brick_size <~.3:1,~.2:.5,~.2:.7> mortar ~.03:.1
        square $color, $color, $stain, $color
        triangular $color, $color, $color, $color, $color, $stain
        cubic $color, $color, $color, $color, $stain, $color
        object { sphere { $vector, ~.3:1 } $stain, $color }""",
    "pattern": """
        $simple
        agate agate_turb ~.2:1.5
        crackle form $vector
        crackle metric %1:3
        mandel %5:40 exterior %0:8 ~1:4
        julia <~-.8:.8,~-.8:.8>, %5:30 interior %0:6 ~.2:1
        magnet 1 mandel %8:20
        quilted control0 ~0:1 control1 ~0:1
        spiral%1:2 %1:5
        mandel %5:30 exterior %0:8 ~.2:2 interior %0:6 ~.2:1
        julia <~-.8:.8,~-.8:.8>, %5:20 exterior %0:8 ~.2:2
        onion noise_generator %1:3 turbulence ~.1:.6
        image_pattern { function 6, 6 { $function } interpolate $interpolate }
        function { $function }
        pigment_pattern { $list scale ~.2:.8 }""",
    "simple": "\n".join("agate boxed bozo bumps cells crackle cylindrical dents granite leopard marble onion planar "
                        "radial ripples spherical spotted waves wood wrinkles".split()) + "\ngradient $vector",
    "function": """
        x*y+z
        sin(x*3)*cos(z*2)
        abs(x)+abs(y)
        pow(x,2)-z
        f_noise3d(x*2,y*2,z*2)
        mod(x*2,1)
        sqrt(x*x+z*z)""",
    "warped": "$turbulence? $waves? $warp? $move*0:2 scale ~.25:1",
    "turbulence": "turbulence ~.1:.8\nturbulence <~0:.7,~0:.7,~0:.7> octaves %1:6 lambda ~1.5:2.5 omega ~.3:.7",
    "waves": "frequency ~.3:4\nphase ~0:1\n$wave\n$wave frequency ~.5:3",
    "wave": "ramp_wave\ntriangle_wave\nsine_wave\nscallop_wave\ncubic_wave\npoly_wave ~.4:3",
    "warp": """
        warp { repeat $axis*~.5:1.5 flip x }
        warp { repeat $axis*~.5:1.5 offset <~-1:1,~-1:1,0> }
        warp { turbulence <~0:.6,~0:.6,~0:.6> octaves %1:5 }
        warp { black_hole $vector, ~.3:1.2 strength ~.5:2 falloff ~.5:3 }
        warp { planar y, ~-.5:.5 }
        warp { cylindrical orientation $axis dist_exp ~0:1 }
        warp { spherical orientation y dist_exp ~0:1 }
        warp { toroidal orientation y major_radius ~.4:1.2 }""",
    "axis": "x\ny\nz",
    "normal": """
        4*normal { $simple ~.05:.6 $warped }
        normal { facets coords ~.2:.8 }
        normal { function { $function } ~.1:.5 scale ~.3:1 }
        normal { $simple ~.1:.6 bump_size ~.1:.5 $warped }
        normal { average normal_map { [~.3:2 $simple ~.2:.8 scale ~.2:.7] [~.3:2 $simple ~.2:.8 $warped] } }
        normal { checker normal { $simple ~.1:.5 scale .2 }, normal { $simple ~.1:.5 } $move*0:2 scale ~.3:.8 }
        normal { $pattern normal_map { [0 bozo ~.1:.4 slope_map { [0 <0,1>] [1 <1,0>] } scale .3] [1 waves .3] } $warped }
        normal { bozo normal_map { [~0:.4 bumps ~.1:.5] [~.5:1 $simple ~.1:.5 scale ~.2:.7] } $warped }
        normal { $simple slope_map { [0 <~0:1,~-1:1>] [~.3:.7 <~0:1,~-1:1>] [1 <~0:1,~-1:1>] } $warped }""",
    "finish": "finish { $own $diffuse $gloss? $metal? $mirror? $film? $conserve? }",
    "own": "ambient ~0:.4\nambient rgb <~0:.3,~0:.3,~0:.3>\nemission ~0:.3",
    "diffuse": "diffuse ~.3:1\ndiffuse ~.3:.8, ~0:.5\ndiffuse ~.3:1 brilliance ~.5:4",
    "gloss": "phong ~.2:1 phong_size ~5:100\nspecular ~.2:1 roughness ~.005:.1",
    "metal": "metallic\nmetallic ~.2:1",
    "mirror": """
        reflection ~.1:.8
        reflection { ~0:.4, ~.2:.9 falloff ~.5:4 metallic ~0:1 }
        reflection { ~.3:1 fresnel }
        reflection rgb <~0:.8,~0:.8,~0:.8>""",
    "film": "irid { ~.1:.5 thickness ~.2:1 turbulence 0 }",
    "conserve": "conserve_energy",
    "solid": """
        sphere { $vector, ~.4:1
        box { <~-1:-.2,~-1:-.2,~-1:-.2>, <~.2:1,~.2:1,~.2:1>
        cylinder { <~-1:0,~-1:0,~-1:0>, <~.1:1,~.1:1,~.1:1>, ~.2:.7
        cone { <~-1:0,~-1:0,~-1:0>, ~.2:.8, <~.1:1,~.1:1,~.1:1>, ~0:.5
        torus { ~.5:1, ~.1:.4
        superellipsoid { <~.2:1.5,~.2:1.5> scale ~.5:1
        prism { linear_sweep ~-.5:0, ~.1:.8, 5, <.8,0>, <0,~.3:1>, <~-1:-.3,0>, <0,~-1:-.3>, <.8,0>
        lathe { cubic_spline 5, <~.2:.8,-1>, <~.2:.9,-.4>, <~.2:.9,.1>, <~.2:.8,.6>, <~.1:.5,1>
        lathe { linear_spline 5, <~.2:.8,-1>, <~.2:.9,-.4>, <~.2:.9,.1>, <~.2:.8,.6>, <0,1>
        lathe { quadratic_spline 6, <.4,-1.2>, <~.2:.8,-1>, <~.2:.9,-.4>, <~.2:.9,.1>, <~.2:.8,.6>, <~.1:.5,1>
        lathe { bezier_spline 4, <~.1:.8,-1>, <~.2:1.2,-.5>, <~.2:1.2,.5>, <~.1:.8,1>
        prism { quadratic_spline ~-.5:0, ~.1:.8, 6, <.8,-1>, <.8,0>, <0,~.3:1>, <~-1:-.3,0>, <0,~-1:-.3>, <.8,0>
        prism { conic_sweep linear_spline ~.2:.4, 1, 5, <.8,0>, <0,~.3:1>, <~-1:-.3,0>, <0,~-1:-.3>, <.8,0>
        cylinder { -y*~.3:1, y*~.3:1, ~.4:.9 open
        cone { -y, ~.4:.9, y*~.2:1, ~.1:.5 open
        ovus { ~.5:.8, ~.2:.4
        julia_fractal { <~-.3:.1,~.5:.9,~-.5:0,~-.2:.2> quaternion sqr max_iteration 6 precision 50
        sphere_sweep { $sweep 4, $vector, ~.1:.4, $vector, ~.1:.4, $vector, ~.1:.4, $vector, ~.1:.4
        blob { threshold .4 sphere { $vector, ~.7:1.2, 1 pigment { $color } } sphere { $vector, 1, ~-.6:1.2 pigment { $pattern } }
        sor { 6, <~.2:.8,-1.2>, <~.2:.8,-.8>, <~.2:.8,-.2>, <~.2:.8,.3>, <~.2:.8,.8>, <~.2:.8,1.1>
        blob { threshold ~.3:.6 sphere { $vector, ~.6:1.2, 1 } cylinder { $vector, $vector, ~.5:.8, ~.7:1.5 }
        quadric { <~.7:2,~.7:2,~.7:2>, 0, 0, ~-.9:-.3
        sphere_sweep { linear_spline 3, $vector, ~.1:.4, $vector, ~.1:.4, $vector, ~.1:.4
        text { ttf "timrom.ttf" "Ab" ~.2:.6, <~0:.2,~0:.2,0> translate <-.5,-.3,0>
        sphere { 0, ~.5:.9 scale <~.5:1.4,~.5:1.4,~.5:1.4>""",
    "sweep": "b_spline\ncubic_spline",
}
SCENE = ("$global", "$camera", "$light*1:3", "$sky", "$fog?", "$floor", "$body*2:5")
TOKEN = re.compile(r"\$([a-z_]+)(\?|\*(\d)(?::(\d))?)?|([~%])(-?[\d.]+):(-?[\d.]+)")


def productions(text):
    """Returns the productions of a rule, each as often as it says."""
    lines = text.strip().split("\n") if text.startswith("\n ") else text.split("\n")
    counted = [re.fullmatch(r"(?:(\d)\*)?(.*)", line.strip()) for line in lines]
    return [line[2] for line in counted for _ in range(int(line[1] or 1))]


def scene(seed):
    """Returns the text of a random scene."""
    dice = random.Random(seed)
    rules = {name: productions(text) for name, text in RULES.items()}

    def one(match):
        rule, how, least, most, sort, low, high = match.groups()
        if sort == "%":
            return str(dice.randint(int(low), int(high)))
        if sort:
            return f"{dice.uniform(float(low), float(high)):.3g}"
        times = dice.randint(int(least), int(most or least)) if least else how is None or dice.random() < .3
        return " ".join(made(dice.choice(rules[rule])) for _ in range(times))

    def made(text):
        return TOKEN.sub(one, text)

    return "\n".join(['#version 3.7; #include "functions.inc"', *map(made, SCENE), ""])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    for seed in range(int(sys.argv[1]), int(sys.argv[2]) + 1):
        (folder / f"{seed}.pov").write_text(scene(seed))


main()
