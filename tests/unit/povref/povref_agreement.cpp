// Strahl's pictures compared with stored ones of POV-Ray, and the comparison itself.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <set>

#include "files/output_file.h"
#include "image/picture.h"
#include "num/thread_pool.h"
#include "povref/compare/run_povray.h"
#include "tests/unit/povref/agreement.h"
#include "text/parse.h"
#include "trace/measure/edge_pixels.h"

using namespace strahl;

TEST_CASE("Strahl's pictures agree with the stored ones of POV-Ray") {
    const auto table = allowed_table();
    std::set<std::string> unknown;
    for (const auto& [name, allowed] : table) unknown.insert(name);
    for (const std::string& name : scene_names()) {
        CAPTURE(name);
        const auto entry = table.find(name);
        const Allowed allowed = entry == table.end() ? Allowed{} : entry->second;
        unknown.erase(name);
        if (!allowed.comparable()) continue;
        const Scene scene = read_scene(name);
        const View view{.camera = scene.camera,
                        .width = picture_width,
                        .height = picture_height,
                        .depth = scene.settings.max_trace_level};
        Tracer tracer(scene, Precision::float64);
        const Picture theirs = read_picture(STRAHL_SOURCE "/povref/reference/" + name + ".png");
        const Verdict verdict = judge(tracer, view, render(scene, view), theirs);
        CHECK_MESSAGE(fault(verdict, allowed).empty(), name, ": ", fault(verdict, allowed));
    }
    CHECK_MESSAGE(unknown.empty(), "povref/allowed.txt speaks of a scene that is not there: ", *unknown.begin());
}

TEST_CASE("a pixel is on an edge where the picture jumps, not where it only changes fast") {
    Scene scene;
    scene.camera = {.position = {0, -9, 0}, .look_at = {0, 0, 0}, .up = {0, 0, -1}, .fov = 20, .aspectratio = 1};
    scene.lights.push_back({{-3, -9, 4}, Color(1)});
    scene.materials.push_back({.reflection = 0, .specular = 1, .pow = 500});
    scene.primitives.push_back({Sphere{{0, 0, 0}, 2}, 0, {}});
    const View view{.camera = scene.camera, .width = 101, .height = 101};
    Tracer tracer(scene, Precision::float64);
    ThreadPool pool(1);
    const Frame frame = render(scene, view);
    const auto lit = [&](int x) { return frame.rgb[3 * (50 * 101 + x)] > 0; };
    int rim = 0;
    while (!lit(rim)) ++rim;
    // Within a pixel of the rim a shift brings the sampling point onto it.
    int edges = 0;
    for (int i = -50; i <= 50; ++i) {
        View moved = view;
        moved.shift_x = i / 50.;
        edges += on_edge(tracer, moved, pool, {rim, 50}, edge_radius, 1. / 65535);
    }
    CHECK(edges >= 1);
    CHECK(edges <= 3);
    // The highlight is a few pixels wide, far from flat, and bent where it is brighter than a screen can show.
    for (int y = 22; y < 78; ++y)
        for (int x = 35; x < 65; ++x) CHECK_FALSE(on_edge(tracer, view, pool, {x, y}, edge_radius, 1. / 65535));
}

TEST_CASE("edges are lines: a face that rounding sprinkles is no edge") {
    const std::string light =
        "camera { position <0, -6, 0> look_at <0, 0, 0> sky <0, 0, 1> angle 40 }\n"
        "background { color <0, 0, 0> }\n";
    const std::string ambient = " ambient 1 diffuse 0 specular 0 reflection 0 }";
    // The plane lies where its checks change, so that rounding decides in each pixel.
    const Scene sprinkled =
        parse_scene(light +
                        "plane { <0, 0, 0>, <.86602540378443864676, .5, 0>, <0, 0, 1> material { rgb checker { "
                        "<1, 0, 0>, <0, 1, 0> scale 9 translate <4, 9e-10, 4> rotate <0, 0, 30> }" +
                        ambient + " }",
                    "sprinkled");
    // The body's left edge passes through the middles of a column of pixels.
    const Scene edge =
        parse_scene(light + "box { <0, -1, -9>, <9, 1, 9> material { rgb <1, 0, 0>" + ambient + " }", "edge");
    for (const bool line : {false, true}) {
        const Scene& scene = line ? edge : sprinkled;
        const View view{.camera = scene.camera, .width = 161, .height = 91};
        Tracer tracer(scene, Precision::float64);
        const Frame ours = render(scene, view);
        Picture theirs{view.width, view.height, 3, ours.rgb, 16};
        std::size_t changed = 0;
        for (int y = 40; y < 52; ++y) {
            double* const value = &theirs.values[3 * (y * view.width + (line ? 80 : 103))];
            value[0] = 1 - value[0], value[1] = value[0] > 0 ? 0 : 1;
            ++changed;
        }
        const Verdict verdict = judge(tracer, view, ours, theirs);
        CAPTURE(line);
        CHECK(verdict.beyond_on_edges == (line ? changed : 0));
        CHECK(verdict.beyond_off_edges == (line ? 0 : changed));
        CHECK((verdict.in_areas > 0) == !line);
    }
}

TEST_CASE("a verdict counts differences on and off edges") {
    const Scene scene = read_scene("crosscheck/ambient");
    const View view{.camera = scene.camera, .width = 40, .height = 30};
    Tracer tracer(scene, Precision::float64);
    const Frame ours = render(scene, view);
    Picture theirs{40, 30, 3, ours.rgb, 16};
    for (double& v : theirs.values) v = std::round(v * 65535) / 65535;
    CHECK(judge(tracer, view, ours, theirs).worst_off_edges == 0);
    theirs.values[0] += 1 / 65535.;
    CHECK(judge(tracer, view, ours, theirs).worst_off_edges == 1);
    CHECK(judge(tracer, view, ours, theirs).beyond_off_edges == 0);
    theirs.values[3 * 41 + 1] += 5 / 65535.;
    const Verdict verdict = judge(tracer, view, ours, theirs);
    CHECK(verdict.worst_off_edges == 5);
    CHECK(verdict.beyond_off_edges == 1);
    CHECK(verdict.x == 1);
    CHECK(verdict.y == 1);
    CHECK(fault(verdict, {}) != "");
    CHECK(fault(verdict, {5, 0.01}).empty());
    // Counts the last pixels without a search for edges where nearly all differ.
    Picture off = theirs;
    for (double& v : off.values) v = v < .5 ? v + 9 / 65535. : v - 9 / 65535.;
    off.values.back() = off.values.back() < .5 ? 1 : 0;
    const Verdict all = judge(tracer, view, ours, off);
    CHECK(all.beyond_off_edges + all.beyond_on_edges == all.pixels);
    CHECK(all.worst_off_edges < 20);
    // Rounding decides where another picture of POV-Ray differs by half as much.
    int made = 0;
    const auto with = [&](int steps, double everywhere) {
        made = 0;
        return judge(tracer, view, ours, theirs, nullptr, [&, steps](int, const PicturePart& part) {
            ++made;
            // Only what is near the pixel is made again.
            CHECK((part.left == 0 && part.top == 0 && part.right == 17 && part.bottom == 17));
            Picture other = theirs;
            other.values[3 * 41 + 1] -= steps / 65535.;
            for (double& v : other.values) v += v < .5 ? everywhere : -everywhere;
            for (std::size_t i = 0; i < verdict.pixels; ++i)
                if (i % 40 > 17 || i / 40 > 17) other.values[3 * i] = other.values[3 * i + 1] = 1;
            return other;
        });
    };
    const Verdict unsure = with(3, 0);
    CHECK((unsure.unsure == 1 && unsure.beyond_off_edges == 0 && unsure.worst_off_edges == 1 && made == 1));
    // A moved camera that changes nothing, or everything, makes no pixel unsure.
    for (const double everywhere : {0., .1}) {
        const Verdict sure = with(everywhere > 0 ? 3 : 2, everywhere);
        CHECK((sure.unsure == 0 && sure.beyond_off_edges == 1 && sure.worst_off_edges == 5));
        CHECK((made > 1 && made < most_again));
    }
    // Ends the search after one picture that shows no rounding, where more than one pixel in 50 differs.
    Picture far = theirs;
    for (int i = 0; i < 30; ++i) far.values[3 * (40 * i + 20)] = far.values[3 * (40 * i + 20)] < .5 ? 1 : 0;
    for (const Picture& again : {far, theirs}) {
        made = 0;
        const Verdict many = judge(tracer, view, ours, far, nullptr, [&](int, const PicturePart&) {
            ++made;
            return again;
        });
        const bool moved = again.values != far.values;
        CHECK(made == (moved ? 5 : 1));
        CHECK((moved ? many.unsure : many.beyond_off_edges) >= 24);
        CHECK((moved ? many.beyond_off_edges : many.unsure) == (moved ? 1 : 0));
    }
    const std::atomic<bool> stop = true;
    CHECK_THROWS_AS(judge(tracer, view, ours, theirs, &stop), Stopped);
    Picture other = theirs;
    other.width = 30;
    CHECK_THROWS_AS(judge(tracer, view, ours, other), FileError);
}
