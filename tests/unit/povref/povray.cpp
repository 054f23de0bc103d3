// Runs POV-Ray on every scene.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <thread>

#include "image/compare.h"
#include "image/picture.h"
#include "image/pixels.h"
#include "main/commands/command_pov.h"
#include "num/thread_pool.h"
#include "pov/open_scene.h"
#include "povref/compare/run_povray.h"
#include "scene/moving_scene.h"
#include "tests/unit/povref/agreement.h"
#include "tests/unit/scratch.h"

using namespace strahl;

namespace {

/// Widths and heights of pictures: 4:3, 16:9, 1:1, 9:16, 21:9, and one pixel wide or high.
constexpr std::array<std::array<int, 2>, 7> shapes{
    {{96, 72}, {96, 54}, {72, 72}, {54, 96}, {112, 48}, {1, 90}, {90, 1}}};

/// Why the pictures of this scene disagree, or "".
std::string check(const std::string& name, const Scene& scene, const Allowed& allowed, int width, int height) {
    const View view{.camera = scene.camera, .width = width, .height = height, .depth = scene.settings.max_trace_level};
    const PovRun theirs = run_povray(
        scene, {.title = name, .cameras = {view.camera}, .width = width, .height = height, .depth = view.depth}, 1);
    Tracer tracer(scene, Precision::float64);
    const std::string disagreement = fault(judge(tracer, view, render(scene, view), theirs.picture), allowed);
    return disagreement + (theirs.warnings.empty() ? "" : "povray warns: " + theirs.warnings);
}

/// The largest difference between averages over a grid of rays, in steps of 16 bits.
int worst_of_grids(const std::string& name, int grid) {
    const Scene scene = read_scene(name);
    const View view{.camera = scene.camera, .width = 64, .height = 48, .depth = scene.settings.max_trace_level};
    const PovRun theirs =
        run_povray(scene, {.cameras = {view.camera}, .width = 64, .height = 48, .depth = view.depth, .grid = grid}, 1);
    ThreadPool pool(1);
    Tracer tracer(scene, Precision::float64);
    const std::vector<double> ours =
        values_of(tracer, view, {.columns = 64, .rows = 48}, pool, {.grid = grid, .centre = true});
    int worst = 0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const auto steps = [](double value) {
            return static_cast<int>(std::lround(65535 * std::clamp(value, 0., 1.)));
        };
        worst = std::max(worst, std::abs(steps(ours[i]) - steps(theirs.picture.values[i])));
    }
    return worst;
}

/// Runs a command line and returns its output.
std::string output_of(const std::string& command) {
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    REQUIRE(pipe);
    std::string text;
    char buffer[4096];
    while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, got);
    REQUIRE_MESSAGE(pclose(pipe) == 0, text);
    return text;
}

}  // namespace

TEST_CASE("averages over grids agree with POV-Ray's") {
    for (const char* const name : {"crosscheck/balls_of_mirror", "crosscheck/overbright", "crosscheck/shadow_coloured"})
        for (const int grid : {2, 3}) {
            CAPTURE(name);
            CHECK(worst_of_grids(name, grid) <= 1);
        }
}

TEST_CASE("every scene's picture agrees with POV-Ray's") {
    const std::vector<std::string> names = scene_names();
    const auto table = allowed_table();
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::string faults;
    const auto work = [&] {
        for (std::size_t i = next++; i < names.size(); i = next++) {
            const auto entry = table.find(names[i]);
            const Allowed allowed = entry == table.end() ? Allowed{} : entry->second;
            if (!allowed.comparable()) continue;
            std::string found;
            try {
                const auto [width, height] = shapes[i % shapes.size()];
                found = check(names[i], read_scene(names[i]), allowed, width, height);
            } catch (const std::exception& error) {
                found = error.what();
            }
            if (found.empty()) continue;
            const std::lock_guard lock(mutex);
            faults += names[i] + ": " + found + "\n";
        }
    };
    {
        // POV-Ray sleeps most of the half second that it takes for a small picture.
        std::vector<std::jthread> threads;
        for (int i = 0; i < 4; ++i) threads.emplace_back(work);
    }
    CHECK_MESSAGE(faults.empty(), faults);
}

TEST_CASE("scenes that once disagreed") {
    const std::string view =
        "camera { position <0, -8, 1> look_at <0, 0, 0> sky <0, 0, 1> angle 40 }\n"
        "light { position <-3, -5, 6> color <1, 1, 1> }\n"
        "box { <-9, -9, -3>, <9, 9, -2> material { rgb checker { <1, 1, 1>, <0, 0, 1> } "
        "reflection 0 diffuse .6 specular 0 } }\n";
    const auto glass = [](const std::string& more, const std::string& color = "<1, .9, .8>") {
        return "material { rgb " + color + " refraction .7 reflection .1 diffuse .1 specular 0 " + more + " }";
    };
    const std::pair<const char*, std::string> scenes[]{
        {"an eye in coloured glass that is in fog",
         "fog { distance 6 color <.3, .4, .1> } sphere { <0, -8, 1>, 2 " + glass("ior 1") + " }"},
        {"glass without an end in fog, which ends at its surface",
         "fog { distance 6 color <.3, .4, .1> } background { color <.9, .2, .1> } disc { <0, -2, 1>, <0, 1, 0>, 1 " +
             glass("ior 1.1") + " } plane { <0, 0, -1>, <1, 0, -1>, <0, -1, -1> " + glass("ior 1.3") + " }"},
        {"parts with an ior of their own",
         "union { sphere { <-.5, 0, 0>, 1 } sphere { <.5, 0, 0>, 1 material { ior 1 } } " + glass("ior 1.5") + " }"},
        {"parts of glass in an opaque body, and of other colours",
         "difference { sphere { <0, 0, 0>, 1.5 } sphere { <0, -1, 0>, 1 " + glass("ior 1.3") +
             " } box { <-.3, -2, -.3>, <.3, 2, .3> material { rgb <0, 1, 0> reflection 0 } } }"},
        {"parts that all share another material than the whole", "union { sphere { <-.5, 0, 0>, 1 " + glass("ior 1.1") +
                                                                     " } sphere { <.5, 0, 0>, 1 " + glass("ior 1.1") +
                                                                     " } " + glass("ior 1.6") + " }"},
        {"a torus without a hole",
         "torus { <0, 0, 0>, <.2, -1, .5>, .6, .9 rotate <20, 0, 30> " + glass("ior 1.3") + " }"},
        {"a smooth triangle whose normals are on both sides",
         "smooth_triangle { <-2, 0, -1>, <2, 0, -1>, <0, 0, 1>, <-1, -1, .2>, <1, 1, .3>, <0, -1, -1> "
         "material { rgb <1, 1, 1> reflection 0 diffuse 1 } }"},
        {"a smooth triangle scaled unevenly",
         "smooth_triangle { <-2, 0, -1>, <2, 0, -1>, <0, 0, 1>, <-1, -1, .2>, <1, -1, .3>, <0, -1, -1> "
         "scale <.6, 3, 1> rotate <0, 0, 30> material { rgb <1, 1, 1> reflection 0 diffuse 1 } }"},
        {"bumps that turn to a light without shadows behind the body",
         "light { position <6, 9, 2> color <.5, .5, .5> shadowless } sphere { <0, 0, 0>, 1.5 material { "
         "rgb <1, .8, .6> diffuse .7 specular 0 reflection 0 bump solid { leopard height 10 scale .1 } } }"},
        {"a soft spotlight of which a floor sees all",
         "light { position <0, 0, 2> color <2, 2, 2> edges <6, 0, 0>, <0, 3, 0> soft spot { look_at <0, 0, 0> radius "
         "30 "
         "falloff 40 tightness 3 } } plane { <0, 0, -1>, <1, 0, -1>, <0, -1, -1> material { diffuse .8 reflection 0 } "
         "}"}};
    for (const auto& [name, body] : scenes) {
        CAPTURE(name);
        const std::string found = check(name, parse_scene(view + body, name), {}, 64, 48);
        CHECK_MESSAGE(found.empty(), found);
    }
    const DVec3 away{1e5, -2e5, 3e4};
    Scene far = parse_scene(view +
                                "mesh { triangle { <-1, 0, -1>, <1, .3, -1>, <0, 0, 1.3> } "
                                "triangle { <-1, 0, -1>, <0, 0, 1.3>, <-.7, .9, .1> } material { reflection 0 } }",
                            "far");
    far.camera.position = far.camera.position + away, far.camera.look_at = far.camera.look_at + away;
    far.lights[0].position = far.lights[0].position + away;
    far.primitives[0].transformations = {Translate{away}};
    MeshData moved = *std::get<Mesh>(far.primitives[1].shape).data;
    for (DVec3& point : moved.points) point = point + away;
    far.primitives[1].shape = Mesh{std::make_shared<const MeshData>(moved), ""};
    const std::string found = check("far", far, {}, 64, 48);
    CHECK_MESSAGE(found.empty(), found);
    // POV-Ray's parallel lights have a place, and what is behind it casts no shadow.
    far.lights[0].direction = DVec3(.3, 1, -1);
    const std::string shadow = check("shadow", far, {}, 64, 48);
    CHECK_MESSAGE(shadow.empty(), shadow);
    // Floats of a picture in glass. They have as few bits as POV-Ray keeps.
    const auto floats = [](const std::string&) {
        return Pixels{2, 1, true, {.125, .5, 1, .75, .25, .5}, {.75, .5, 1}};
    };
    const std::string ball = "sphere { <0, 0, 0>, 1.5 " + glass("ior 1.2", "image { \"floats.exr\" }") + " }";
    const std::string glass_image = check("floats", parse_scene(view + ball, "floats", {}, floats), {}, 64, 48);
    CHECK_MESSAGE(glass_image.empty(), glass_image);
}

TEST_CASE("povray renders an emitted .ini without warnings, to Strahl's picture") {
    const Scratch scratch;
    for (const char* name : {"crosscheck/total_reflection", "crosscheck/linear_light", "crosscheck/camera_inside"}) {
        CAPTURE(name);
        const std::string pov = scratch / "it's a scene.pov";
        REQUIRE(pov_command({.scene = std::string(STRAHL_SOURCE) + "/scenes/" + name + ".rt",
                             .opening = {.size = {64, 48}},
                             .output = pov}) == 0);
        // POV-Ray is called by the command in a comment of the .ini file.
        std::ifstream ini(scratch / "it's a scene.ini");
        std::string command;
        while (std::getline(ini, command) && !command.starts_with(";   povray ")) {
        }
        REQUIRE(ini.good());
        const std::string log = output_of(command.substr(1));
        CHECK_MESSAGE(log.find("Warning: ") == std::string::npos, log);
        const Scene scene = read_scene(name);
        const Frame frame =
            render(scene, {.camera = scene.camera, .width = 64, .height = 48, .depth = scene.settings.max_trace_level});
        const std::string ours = scratch / "ours.png";
        write_picture({64, 48, 3, frame.rgb}, ours, {16, scene.settings.assumed_gamma});
        const Picture a = read_picture(ours), b = read_picture(scratch / "it's a scene.png");
        // Curves are steeper than the values they encode, that of sRGB up to 13 times.
        CHECK(compare(a, b, 0).max * 65535 < steepest(scene.settings.assumed_gamma) + .58);
    }
}

TEST_CASE("animations of ten frames agree frame by frame") {
    const Scratch scratch;
    for (const auto& [name, rate] : {std::pair("flight", FrameRate{9, 2}), {"motion", FrameRate{15, 4}}}) {
        CAPTURE(name);
        const Scene scene = read_scene(std::string("crosscheck/") + name);
        REQUIRE(pov_command({.scene = std::string(STRAHL_SOURCE "/scenes/crosscheck/") + name + ".rt",
                             .opening = {.size = {64, 48}},
                             .output = scratch / "film.pov",
                             .animation = true,
                             .rate = rate}) == 0);
        const std::string log = output_of("povray '" + (scratch / "film.ini") + "'");
        CHECK_MESSAGE(log.find("Rendering frame 10 of 10") != std::string::npos, log);
        Tracer tracer(scene, Precision::float64);
        for (int n = 0; n < 10; ++n) {
            CAPTURE(n);
            const double time = rate.moment(n);
            const View view{.camera = camera_at(scene, time), .width = 64, .height = 48, .time = time};
            const Picture theirs = read_picture(scratch / ("film" + std::to_string(n) + ".png"));
            const Verdict verdict = judge(tracer, view, render(scene, view), theirs);
            CHECK_MESSAGE(fault(verdict, {}).empty(), fault(verdict, {}));
        }
    }
}

TEST_CASE("a camera that asks for the picture's size shows what POV-Ray's shows, in every shape") {
    const Scratch folder;
    const char* const cameras[]{"right x*image_width/image_height up y",
                                "up y right -x*image_width/image_height angle 50",
                                "right x up y*image_height/image_width",
                                "orthographic up 5*y right 5*image_width/image_height*x",
                                "right 1.2*x*image_width/image_height up y angle 30+image_height/9",
                                "fisheye angle 100 right x*image_width/image_height up y"};
    int number = 0;
    for (const auto& [width, height] : shapes)
        for (int i = 0; i < 2; ++i) {
            const std::string camera = cameras[static_cast<std::size_t>(number++) % std::size(cameras)];
            CAPTURE(camera);
            CAPTURE(width);
            CAPTURE(height);
            const std::string path = folder / "scene.pov";
            std::ofstream(path) << "#version 3.7; global_settings { assumed_gamma 1 } camera { " << camera
                                << " location <1, 2, -6> look_at <0, .5, 0> }\n"
                                   "light_source { <-5, 9, -3>, 1 } plane { y, 0 pigment { rgb <.3, .6, .2> } }\n"
                                   "sphere { <.5, 1, 1>, 1 pigment { rgb <(image_width > image_height), .2, .1> } }\n";
            const OpenedScene opened = open_scene(bytes_of(path), path, {.size = {width, height}}, read_pixels);
            CHECK(opened.sized);
            const PovFile file{.path = path, .width = width, .height = height, .gamma = 1};
            const View view{.camera = opened.scene.camera, .width = width, .height = height};
            Tracer tracer(opened.scene, Precision::float64);
            const std::string found =
                fault(judge(tracer, view, render(opened.scene, view), run_povray_file(file, 1).picture), {});
            CHECK_MESSAGE(found.empty(), found);
        }
}

TEST_CASE("a scene file of POV-Ray's is seen by another camera than its own") {
    const Scratch folder;
    for (const char* const right : {"x", "-x"}) {  // the one is left-handed, the other right-handed
        CAPTURE(right);
        const std::string path = folder / "scene.pov";
        std::ofstream(path) << "#version 3.7; global_settings { assumed_gamma 1 }\n"
                               "camera { location <1, 2, -6> right 4/3*"
                            << right
                            << " look_at <0, .5, 0> angle 40 }\n"
                               "light_source { <-5, 9, -3>, 1 } plane { y, 0 pigment { rgb <.3, .6, .2> } }\n"
                               "sphere { <.5, 1, 1>, 1 pigment { rgb <.9, .2, .1> } } // no end of line";
        const OpenedScene opened = open_scene(bytes_of(path), path, {}, read_pixels);
        CHECK(opened.mirrored == (right[0] == 'x'));
        PovFile file{.path = path, .width = 40, .height = 30, .gamma = 1, .mirrored = opened.mirrored};
        const Picture own = run_povray_file(file, 1).picture;
        file.camera = opened.scene.camera;
        CHECK(compare(own, run_povray_file(file, 1).picture, 0).max < 2. / 65535);
        file.part = {.left = 3, .top = 2, .right = 20, .bottom = 16};
        const Picture part = run_povray_file(file, 1).picture;
        for (int i = 0; i < 40 * 30; ++i) {
            const int x = i % 40, y = i / 40;
            const bool within = x >= 3 && x <= 20 && y >= 2 && y <= 16;
            for (int c = 3 * i; c < 3 * i + 3; ++c)
                CHECK(std::abs(part.values[c] - (within ? own.values[c] : 0)) < 2. / 65535);
        }
        file.part.reset();
        file.camera->position += DVec3(2, 1, 0), file.camera->fov = 25;
        const Picture other = run_povray_file(file, 1).picture;
        const View view{.camera = *file.camera, .width = 40, .height = 30};
        Tracer tracer(opened.scene, Precision::float64);
        const Verdict verdict = judge(tracer, view, render(opened.scene, view), other);
        CHECK(verdict.beyond_off_edges == 0);
        CHECK(verdict.beyond_on_edges < 4);
        CHECK(compare(own, other, 0).max > .1);
    }
}

TEST_CASE("cameras of all projections show what POV-Ray's show, there and back") {
    const Scratch folder;
    const Scene room = parse_scene(
        "camera { position <1, -6, 2>  look_at <0, 0, 1>  sky <.2, 0, 1>  fov 30  aspectratio 1.5 }\n"
        "light { position <-9, -20, 30>  color <1, 1, 1> }  background { color <.1, .2, .4> }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb <.3, .6, .2> } }\n"
        "sphere { <-1, 0, 1>, 1  material { rgb <.9, .2, .1>  reflection .3 } }\n"
        "box { <1, -9, 0>, <3, -7, 2>  material { rgb <.2, .2, .9> } }\n",
        "room.rt");
    for (std::size_t i = 0; i < projection_words.size(); ++i) {
        CAPTURE(projection_words[i]);
        Scene scene = room;
        scene.camera.projection = static_cast<Projection>(i);
        if (angular(scene.camera.projection)) scene.camera.fov = 100;
        const View view{.camera = scene.camera, .width = 60, .height = 40, .depth = 4};
        const PovRequest request{.title = "room", .cameras = {scene.camera}, .width = 60, .height = 40, .depth = 4};
        Tracer tracer(scene, Precision::float64);
        const Frame ours = render(scene, view);
        const Verdict verdict = judge(tracer, view, ours, run_povray(scene, request, 1).picture);
        CHECK_MESSAGE(fault(verdict, {}).empty(), fault(verdict, {}));
        const PovFiles files = write_pov(scene, request);
        const OpenedScene again = open_scene(files.pov, folder / "x.pov", {}, read_pixels);
        CHECK(again.summary == "opens whole");
        CHECK(again.scene.camera.projection == scene.camera.projection);
        const CameraFrame a = frame_of(scene.camera, 1), b = frame_of(again.scene.camera, 1);
        // The text has other units of length.
        const Projection own = scene.camera.projection;
        const auto unit = [&](Projection along) {  // 1 for angles
            return own == Projection::orthographic || own == along
                       ? again.scene.camera.position.x / scene.camera.position.x
                       : 1;
        };
        CHECK(b.tan_x == doctest::Approx(unit(Projection::cylinder4) * a.tan_x).epsilon(1e-12));
        CHECK(b.tan_y == doctest::Approx(unit(Projection::cylinder3) * a.tan_y).epsilon(1e-11));
        CHECK(length(a.down - b.down) < 1e-9);
    }
}

TEST_CASE("without povray the message says what to install") {
    const Scene scene = read_scene("crosscheck/ambient");
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    CHECK_THROWS_WITH(run_povray(scene, {.cameras = {scene.camera}, .width = 8, .height = 6}, 1),
                      doctest::Contains("apt install povray"));
    setenv("PATH", path.c_str(), 1);
}
