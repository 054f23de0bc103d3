// The scene language: values, bodies, cameras and flythroughs that cannot be.
#include "tests/unit/text/language.h"
#include "text/write.h"

using namespace strahl;
using namespace strahl::language;

TEST_CASE("values out of range") {
    check_fault("sphere { <0,0,0>, 0 }", "2:19: 'radius' of 'sphere' must be greater than 0 and at most 1e9, not '0'");
    check_fault("sphere { <0,0,0>, 1e-310 }",
                "2:19: 'radius' of 'sphere' must be greater than 0 and at most 1e9, not '1e-310'");
    check_fault("sphere { <0,-1.5e9,0>, 1 }", "2:13: 'centre' of 'sphere' must be from -1e9 to 1e9, not '-1.5e9'");
    check_fault("light { position <1e10,0,0> color <1,1,1> }",
                "2:19: 'position' of 'light' must be from -1e9 to 1e9, not '1e10'");
    check_fault("light { position <1,0,0> color <1,1,-2e9> }",
                "2:37: 'color' of 'light' must be from -1e9 to 1e9, not '-2e9'");
    check_fault("background { color <-.1,0,0> }", "2:21: 'color' of 'background' must be from 0 to 1e9, not '-.1'");
    check_fault("defaultmaterial { reflection 1.01 }",
                "2:30: 'reflection' of 'defaultmaterial' must be from 0 to 1, not '1.01'");
    check_fault("defaultmaterial { refraction -.1 }",
                "2:30: 'refraction' of 'defaultmaterial' must be from 0 to 1, not '-.1'");
    check_fault("defaultmaterial { rgb <0,0,-1> }", "2:28: 'rgb' of 'defaultmaterial' must be from 0 to 1e9, not '-1'");
    check_fault("defaultmaterial { specular 1.1e9 }",
                "2:28: 'specular' of 'defaultmaterial' must be from 0 to 1e9, not '1.1e9'");
    check_fault("defaultmaterial { pow -1 }", "2:23: 'pow' of 'defaultmaterial' must be from 0 to 1e9, not '-1'");
    check_fault("defaultmaterial { ior 0 }", "2:23: 'ior' of 'defaultmaterial' must be from 1e-9 to 1e9, not '0'");
    check_fault("global_settings { max_trace_level 0 }",
                "2:35: 'max_trace_level' of 'global_settings' must be a whole number from 1 to 256, not '0'");
    check_fault("global_settings { max_trace_level 257 }",
                "2:35: 'max_trace_level' of 'global_settings' must be a whole number from 1 to 256, not '257'");
    check_fault("global_settings { max_trace_level 2.5 }",
                "2:35: 'max_trace_level' of 'global_settings' must be a whole number from 1 to 256, not '2.5'");
    check_fault("global_settings { ambient_light <1,1,-1> }",
                "2:38: 'ambient_light' of 'global_settings' must be from 0 to 1e9, not '-1'");
    CHECK(faults(eye + "global_settings { assumed_gamma .5 }")
              .at(0)
              .starts_with("x.rt:2:33: 'assumed_gamma' of 'global_settings' must be from 1 to 5,"));
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 90 }") ==
          Faults{"x.rt:1:59: 'fov' of 'camera' must be greater than 0 and less than 90 degrees, not '90'"});
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 0 }") ==
          Faults{"x.rt:1:59: 'fov' of 'camera' must be greater than 0 and less than 90 degrees, not '0'"});
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> angle 180 }") ==
          Faults{"x.rt:1:61: 'angle' of 'camera' must be greater than 0 and less than 180 degrees, not '180'"});
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 1 aspectratio 0 }") ==
          Faults{"x.rt:1:73: 'aspectratio' of 'camera' must be from 1e-9 to 1e9, not '0'"});
    CHECK(parse("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 89.99999999999999 }").camera.fov < 90);
    const auto lens = [](const std::string& words) {
        return faults("camera { position <0,0,0> look_at <0,1,0> up <0,0,-1>\n" + words + " }");
    };
    CHECK(lens("fov 1 aperture -1") == Faults{"x.rt:2:16: 'aperture' of 'camera' must be from 0 to 1e9, not '-1'"});
    const std::string closed =
        "camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 1 aperture 0 focus 3 shutter 0 }";
    CHECK((!has_lens(parse(closed).camera) && parse(closed).camera.focus == 3));
    CHECK(lens("fov 1 aperture 1 blades 2") ==
          Faults{"x.rt:2:25: 'blades' of 'camera' must be a whole number from 3 to 64, not '2'"});
    CHECK(lens("fov 1 focus 3") ==
          Faults{"x.rt:2:7: 'focus' changes nothing without 'aperture', the radius of the lens"});
    CHECK(lens("fov 1 aperture 1 focus 3 focus_on <0,4,0>").size() == 1);
    CHECK(lens("fov 1 aperture 1 focus_on <0,-4,0>") ==
          Faults{"x.rt:2:18: this point is not before the camera, so nothing could be sharp"});
    CHECK(lens("fov 1 shutter -1") == Faults{"x.rt:2:15: 'shutter' of 'camera' must be from 0 to 1e9, not '-1'"});
    CHECK(lens("fisheye 90 aperture 1") == Faults{"x.rt:2:12: only perspective and orthographic cameras have a lens"});
    // A wrong value does not hide a missing parameter.
    CHECK(faults("camera { position <0,0,0> look_at <0,1,0> fov 95 }") ==
          Faults{"x.rt:1:1: 'camera' lacks 'up' (or 'sky')",
                 "x.rt:1:47: 'fov' of 'camera' must be greater than 0 and less than 90 degrees, not '95'"});
}

TEST_CASE("an argument that may be left out") {
    const Scene scene = parse(eye + "disc { <1,2,3>, <0,0,2>, 4 } disc { <1,2,3> <0,0,2> 4 1.5 rotate <0,0,9> }");
    CHECK(scene.primitives.at(0).shape == Shape(Disc{{1, 2, 3}, {0, 0, 2}, 4, 0}));
    CHECK(scene.primitives.at(1).shape == Shape(Disc{{1, 2, 3}, {0, 0, 2}, 4, 1.5}));
    CHECK(scene.primitives.at(1).transformations.size() == 1);
}

TEST_CASE("contours of prisms are closed lines of straight ones and curves") {
    const Scene scene = parse(eye +
                              "prism { 0, 2 contour { <0,0> line <2,0> curve <2,2>, <0,2> } "
                              "contour { <.5,.5> curve <.5,1> <1,1> curve <1,.8>, <.9,.6>, <.7,.5> } "
                              "translate <0,0,1> }");
    const auto& prism = std::get<Prism>(scene.primitives.at(0).shape);
    CHECK(prism.top == 2);
    const std::vector<Contour> wanted{{{0, 0}, {{{2, 0}, {2, 0}}, {{2, 2}, {0, 2}}}},
                                      {{.5, .5}, {{{.5, 1}, {1, 1}}, {{1, .8}, {.7, .5}, {{.9, .6}}}}}};
    CHECK(prism.data->contours == wanted);
    CHECK(prism.data->pieces.size() == 6);
    CHECK(parse(write_scene(scene)) == scene);
    check_fault("prism { 0, 1 }", "2:1: invalid prism: it has no area");
    check_fault("prism { 0, 1 contour { <0,0> line <0,1> line <0,2> } }", "2:1: invalid prism: it has no area");
    check_fault("prism { 1, 1 contour { <0,0> line <1,1> line <2,1> } }",
                "2:1: invalid prism: its base and its top have the same height");
    check_fault("prism { 0, 1 contour { <0,0> line <1,1e10> line <2,1> } }",
                "2:38: 'end' of 'contour' must be from -1e9 to 1e9, not '1e10'");
    CHECK(faults(eye + "prism { 0, 1 contour { <0,0> curv <1,1> <2,1> } }").at(0).find("'curve'") != std::string::npos);
}

TEST_CASE("sweeps have balls of one sort") {
    const std::string three = "through { <0,0,0>, 1 } through { <1,0,0>, .5 } through { <2,0,1>, 0 } ";
    const Scene scene = parse(eye + "sphere_sweep { " + three + "through { <3,0,0>, .25 } scale 2 }");
    const auto& sweep = std::get<SphereSweep>(scene.primitives.at(0).shape);
    CHECK(sweep.data->balls ==
          std::vector<SweptBall>{{DVec3(0), 1}, {{1, 0, 0}, .5}, {{2, 0, 1}, 0}, {{3, 0, 0}, .25, true}});
    CHECK(sweep.data->pieces.size() == 1);
    check_fault("sphere_sweep { " + three + "}", "2:1: invalid sphere_sweep: it has fewer than four balls");
    check_fault("sphere_sweep { " + three + "towards { <3,0,0>, .25 } }",
                "2:1: invalid sphere_sweep: it has balls of both sorts");
    check_fault("sphere_sweep { " + three + "through { <3,0,0>, -1 } }",
                "2:105: 'radius' of 'through' must be from 0 to 1e9, not '-1'");
}

TEST_CASE("Julia sets have numbers and words") {
    const auto first = [](const std::string& text) {
        return std::get<JuliaFractal>(parse(eye + text).primitives.at(0).shape);
    };
    JuliaFractal wanted{{1, 0, .5}, -.2, 8, 60};
    CHECK(first("julia_fractal { <1,0,.5>, -.2, 8, 60 }") == wanted);
    wanted.step = JuliaStep::cube;
    CHECK(first("julia_fractal { <1,0,.5>, -.2, 8, 60 cube scale 2 }") == wanted);
    wanted.step = JuliaStep::power, wanted.hypercomplex = true, wanted.slice = {0, 0, .5}, wanted.slice_fourth = .8;
    wanted.distance = .1, wanted.exponent = 2, wanted.imaginary = .5;
    CHECK(first("julia_fractal { <1,0,.5>, -.2, 8, 60, <0,0,.5>, .8, .1, 2, .5 hypercomplex pwr }") == wanted);
    check_fault("julia_fractal { <1,0,.5>, -.2, 8, 60 exp }",
                "2:1: invalid julia_fractal: quaternions are only squared or cubed");
    check_fault("julia_fractal { <1,0,.5>, -.2, 8, 60, <0,0,1>, 0 }",
                "2:1: invalid julia_fractal: the fourth part of its slice is 0");
    check_fault("julia_fractal { <1,0,.5>, -.2, 8, .5 }",
                "2:1: invalid julia_fractal: its precision is not from 1 to 100000");
    check_fault("julia_fractal { <1,0,.5>, -.2, 8.5, 60 }",
                "2:32: 'iterations' of 'julia_fractal' must be a whole number from 1 to 1000, not '8.5'");
}

TEST_CASE("blobs have lumps, which may be stretched") {
    const Scene scene = parse(eye +
                              "blob { .5 lump { <0,0,0>, <0,0,0>, 1, 2 } lump { <0,0,1>, <1,0,1>, .5, -1, "
                              "<2,0,0>, <0,1,1> } scale 2 }");
    const auto& blob = std::get<Blob>(scene.primitives.at(0).shape);
    CHECK(blob.threshold == .5);
    const Lump second{{0, 0, 1}, {1, 0, 1}, .5, -1, {2, 0, 0}, {0, 1, 1}};
    CHECK(blob.data->lumps == std::vector<Lump>{{DVec3(0), DVec3(0), 1, 2}, second});
    CHECK(blob.data->pieces.size() == 4);
    check_fault("blob { 0 lump { <0,0,0>, <0,0,0>, 1, 2 } }",
                "2:8: 'threshold' of 'blob' must be greater than 0 and at most 1e9, not '0'");
    check_fault("blob { 1 }", "2:1: invalid blob: it has no lump that adds to its field");
    check_fault("blob { 1 lump { <0,0,0>, <0,0,0>, 1, -2 } }",
                "2:1: invalid blob: it has no lump that adds to its field");
    check_fault("blob { 1 lump { <0,0,0>, <0,0,0>, 1, 2, <1,0,0>, <2,0,0> } }",
                "2:1: invalid blob: one of its lumps is flat");
    CHECK(parse(eye + "union { blob { 1 lump { <0,0,0>, <0,0,0>, 1, 2 } } }").primitives.size() == 1);
}

TEST_CASE("contours of lathes are closed or open") {
    const Scene scene = parse(eye +
                              "lathe { contour { <1,0> line <2,0> curve <2,2>, <0,2> } contour { <0,0> line <1,1> "
                              "line <0,1> } rotate <90,0,0> }");
    const auto& lathe = std::get<Lathe>(scene.primitives.at(0).shape);
    CHECK(lathe.data->pieces.size() == 4);
    CHECK(lathe.open());
    CHECK(parse(write_scene(scene)) == scene);
    check_fault("lathe { }", "2:1: invalid lathe: it has no surface");
    check_fault("lathe { contour { <0,0> line <0,1> } }", "2:1: invalid lathe: it has no surface");
    check_fault("union { lathe { contour { <1,0> line <1,1> } } }",
                "2:9: this lathe cannot be part of a body: a contour neither is closed nor has both ends on the axis");
    CHECK(parse(eye + "union { lathe { contour { <0,0> line <1,1> line <0,2> } } }").primitives.size() == 1);
}

TEST_CASE("directions are turned and stretched with their bodies, and not moved") {
    const Scene scene = parse(eye + "disc { <0,0,0>, <0,0,1e-9>, 4 translate <0,0,1e8> }");
    CHECK(scene.primitives.size() == 1);
    CHECK(faults(eye + "torus { <0,0,0>, <0,0,1>, 1, .1  translate <2e9,0,0> }").size() == 1);
}

TEST_CASE("invalid bodies and cameras") {
    check_fault("plane { <0,0,0>, <1,1,1>, <3,3,3> }", "2:1: invalid plane: the three points lie on one line");
    check_fault("cylinder { <1,2,3>, <1,2,3>, 1 }", "2:1: invalid cylinder: base and cap are the same point");
    check_fault("torus { <0,0,0>, <0,0,0>, 1, .1 }", "2:1: invalid torus: its axis has no direction");
    check_fault("torus { <0,0,0>, <0,0,1>, 1e-3, 1.1 }",
                "2:1: invalid torus: its major radius is less than a thousandth of its minor one");
    check_fault("disc { <0,0,0>, <0,0,0>, 1 }", "2:1: invalid disc: its normal has no direction");
    check_fault("disc { <0,0,0>, <0,0,1>, 1, 1 }", "2:1: invalid disc: the hole is as large as the disc");
    check_fault("disc { <0,0,0>, <0,0,1>, 1, material { } }",
                "2:29: a number expected for 'hole's radius' of 'disc', but found 'material'");
    check_fault("sphere { <0,0,0>, 1 scale 0 }",
                "2:27: 'scale' of 'sphere' is 0, which would leave nothing of it; 1 changes nothing");
    check_fault("sphere { <0,0,0>, 1 scale <1,0,1> }",
                "2:27: 'scale' of 'sphere' is 0, which would leave nothing of it; 1 changes nothing");
    check_fault("sphere { <0,0,0>, 1 scale 1e200 scale 1e200 }",
                "2:33: invalid sphere: the transformations up to here scale it out of the range of numbers");
    check_fault("sphere { <0,0,0>, 1 scale 1e-200 scale 1e-200 }",
                "2:34: invalid sphere: the transformations up to here scale it out of the range of numbers");
    check_fault(
        "sphere { <0,0,0>, 1 scale <1,1,1e-13> }",
        "2:21: invalid sphere: the transformations up to here flatten it: one side shrinks more than 1e12 times "
        "as much as another");
    check_fault("sphere { <1e7,0,0>, 1 scale 1e3 }",
                "2:23: invalid sphere: the transformations up to here make it too large, too small or too far away "
                "(coordinates go up to 1e9)");
    check_fault("sphere { <0,0,0>, 1e7 scale 1e3 }",
                "2:23: invalid sphere: the transformations up to here make it too large, too small or too far away "
                "(coordinates go up to 1e9)");
    check_fault(
        "cylinder { <0,0,0>, <0,0,1>, 1 scale 1e-30 translate <1,1,1> }",
        "2:44: invalid cylinder: the transformations up to here leave nothing of it: base and cap are the same point");
    CHECK(with_eye("sphere { <0,0,0>, 1 scale 1e-200 scale 1e200 scale <1e6,1,1> }").primitives.size() == 1);
    CHECK(faults("camera { position <1,2,3> look_at <1,2,3> up <0,0,-1> fov 1 }") ==
          Faults{"x.rt:1:1: invalid camera: position and look_at are the same point"});
    CHECK(faults("camera { position <1,2,3> look_at <1,2,0> up <0,0,-1> fov 1 }") ==
          Faults{"x.rt:1:1: invalid camera: up is parallel to the direction from position to look_at"});
    CHECK(faults("camera { position <0,0,9> look_at <0,0,0> sky <0,0,1> fov 25 }") ==
          Faults{"x.rt:1:1: invalid camera: sky is parallel to the direction from position to look_at"});
}

TEST_CASE("two eyes, and shutters by shares of a frame") {
    const std::string place = "camera { position <0,-9,0> look_at <0,0,0> sky <0,0,1>\n";
    const Camera beside = parse(place + "fov 20 side_by_side .06 convergence 5 }").camera;
    CHECK((beside.stereo == Stereo::side_by_side && beside.eye_distance == .06 && beside.convergence == 5));
    CHECK(frame_of(beside, 2).tan_x == doctest::Approx(frame_of(beside, 2).tan_y));
    const Camera above = parse(place + "spherical 360 top_bottom .1 }").camera;
    CHECK((above.stereo == Stereo::top_bottom && !above.convergence));
    CHECK(frame_of(above, 1).tan_x == doctest::Approx(2 * frame_of(above, 1).tan_y));
    CHECK(faults(place + "fov 20 side_by_side .1 top_bottom .1 }") ==
          Faults{"x.rt:2:24: 'top_bottom' repeats 'side_by_side' of line 2; give only one of them"});
    CHECK(faults(place + "fov 20 orthographic side_by_side .1 }") ==
          Faults{"x.rt:2:21: parallel rays show the same to both eyes"});
    CHECK(faults(place + "fov 20 convergence 1 }") ==
          Faults{"x.rt:2:8: 'convergence' changes nothing without 'side_by_side' or 'top_bottom'"});
    CHECK(faults(place + "fisheye 90 top_bottom 1 convergence 1 }") ==
          Faults{"x.rt:2:25: only the eyes of perspective cameras can converge"});
    const Camera share = parse(place + "fov 20 shutter_share .5 }").camera;
    CHECK((shutter_seconds(share, 25) == .02 && shutter_seconds(share, 50) == .01));
    CHECK(shutter_seconds(parse(place + "fov 20 shutter .5 }").camera, 25) == .5);
    CHECK(faults(place + "fov 20 shutter .1 shutter_share .5 }").size() == 1);
}

TEST_CASE("cameras of other projections than perspective") {
    const std::string place = "camera { position <0,-9,0> look_at <0,0,0> sky <0,0,1> ";
    const Camera fisheye = parse(place + "fisheye 200 }").camera;
    CHECK((fisheye.projection == Projection::fisheye && fisheye.fov == 100));
    const Camera parallel = parse(place + "orthographic fov 20 }").camera;
    CHECK((parallel.projection == Projection::orthographic && parallel.fov == 20));
    CHECK(frame_of(parallel, 2).tan_y == doctest::Approx(9 * std::tan(20 * 3.14159265358979323846 / 180) / 2));
    const CameraFrame lying = frame_of(parse(place + "cylinder4 90 }").camera, 2);
    CHECK(lying.tan_y == doctest::Approx(3.14159265358979323846 / 4));
    CHECK(lying.tan_x == 2 * lying.tan_y);
    CHECK(faults(place + "orthographic }") == Faults{"x.rt:1:1: 'camera' lacks 'fov' (or 'angle')"});
    CHECK(faults(place + "fov 20 spherical 360 }") ==
          Faults{"x.rt:1:63: 'spherical' repeats 'fov' of line 1; give only one of them"});
    CHECK(faults(place + "spherical 360\nfisheye 90 }") ==
          Faults{"x.rt:2:1: 'fisheye' repeats 'spherical' of line 1; give only one of them"});
}

TEST_CASE("invalid flythroughs") {
    const auto path = [](const std::string& head, const std::string& first, const std::string& second) {
        return "flythrough { " + head + "\nkey { position <0,0,0> look_at <1,0,0> time " + first +
               " }\nkey { position <0,0,0> look_at <1,1,0> time " + second + " } }";
    };
    CHECK(with_eye(path("duration 2", "0", "2")).flythrough->keys.size() == 2);
    check_fault(path("duration 2", "1", "1"),
                "4:40: times must increase: the key before, in line 3, is not earlier than this one");
    check_fault(path("duration 2", "0", "2.5"), "4:40: this is after the end, set by 'duration' in line 2");
    check_fault(path("duration 0", "0", "1"),
                "2:23: 'duration' of 'flythrough' must be greater than 0 and at most 1e9, not '0'");
    check_fault(path("duration 2", "0 ease 1.5", "1"), "3:52: 'ease' of 'key' must be from 0 to 1, not '1.5'");
    check_fault(path("duration 2", "-1", "1"), "3:45: 'time' of 'key' must be from 0 to 1e9, not '-1'");
    check_fault(path("loop duration 2", "0", "2"),
                "4:40: at this time the loop is back at its first key: make this key equal to that in line 3, or "
                "'duration' longer");
    check_fault(path("duration 2", "0 tmie 3", "0"), "3:47: unknown word 'tmie' in 'key'; did you mean 'time'?");
    check_fault("key { time 1 }", "2:1: unknown word 'key'; it belongs in 'flythrough { ... }'");
    CHECK(faults(eye + "flythrough { duration 2 key { time 0 position <0,0,0> look_at <0,0,0> }\nkey { time 1 position "
                       "<0,0,0> look_at <0,0,1> } }") ==
          Faults{"x.rt:2:25: invalid camera at this key: position and look_at are the same point",
                 "x.rt:3:1: invalid camera at this key: up is parallel to the direction from position to look_at"});
}
