// --error: off the edges, pictures stay within the error allowed, and larger errors cost less.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "tests/unit/scenes.h"
#include "trace/measure/edge_pixels.h"
#include "trace/measure/picture_accuracy.h"
#include "trace/tracer.h"

namespace strahl::accuracy {

constexpr int columns = 40, rows = 30;

double apart(const Frame& a, const Frame& b, int pixel) {
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        const double off =
            std::abs(std::clamp(a.rgb[3 * pixel + c], 0., 1.) - std::clamp(b.rgb[3 * pixel + c], 0., 1.));
        most = std::max(most, off);
    }
    return most;
}

// At the scene's depth: there is no exact picture of unlimited depth. Light past the depth limit is tested in
// light_bound.cpp.
TEST_CASE("off the edges no picture exceeds the error allowed") {
    ThreadPool pool(2), alone(1);
    const std::vector<std::string> paths = scene_names();
    REQUIRE(paths.size() > 50);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        CAPTURE(paths[i]);
        const Scene scene = read_scene(paths[i]);
        const View view{
            .camera = scene.camera, .width = columns, .height = rows, .depth = scene.settings.max_trace_level};
        const Frame exact = render(scene, view, Precision::float64, 2);
        std::uint64_t fewest = 0;
        for (const double error : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
            CAPTURE(error);
            const Accuracy accuracy = choose_accuracy(scene, view, error, {}, view.depth, pool);
            View allowed = view;
            allowed.depth = accuracy.depth, allowed.error = accuracy.dropped;
            Tracer tracer(scene, accuracy.precision);
            const Counts counts =
                tracer.trace({allowed, pool, [](const Tile&) {}}, Lattice{.columns = columns, .rows = rows});
            if (fewest > 0) CHECK(counts.total() <= fewest + fewest / 50);  // pixels on edges vary
            fewest = counts.total();
            CHECK(counts.dropped <= accuracy.dropped * (1 + 1e-6));  // summed in float
            const Frame frame = render(scene, allowed, accuracy.precision, 2);
            Tracer exactly(scene, Precision::float64);
            for (int p = 0; p < columns * rows; ++p)
                if (const double off = apart(frame, exact, p); off > error)
                    CHECK_MESSAGE(on_edge(exactly, view, alone, {p % columns, p / columns}, .1, off / 4), "pixel ",
                                  p % columns, ", ", p / columns, " is off by ", off);
        }
    }
}

TEST_CASE("precision and depth follow from the error unless given") {
    ThreadPool pool(2);
    const Scene scene = read_scene("article");
    const View view{.camera = scene.camera, .width = 64, .height = 48};
    const auto choose = [&](double error, std::optional<Precision> precision = {}, std::optional<int> depth = {}) {
        return choose_accuracy(scene, view, error, precision, depth, pool);
    };
    CHECK(choose(1e-2).precision == Precision::float32);
    CHECK(choose(1e-6).precision == Precision::float64);
    CHECK(choose(1e-17).precision == Precision::extended);
    CHECK(choose(1e-6, Precision::float32).precision == Precision::float32);
    CHECK(choose(1e-6, {}, 3).depth == 3);
    CHECK(choose(0).precision == Precision::float64);
    CHECK(choose(0).depth == scene.settings.max_trace_level);
    CHECK(choose(0).dropped == 0);
    const Accuracy accuracy = choose(1e-2);
    CHECK(accuracy.dropped + *accuracy.rounding <= 1e-2);
}

TEST_CASE("with the eye on a surface, where rounding decides what is seen, float is not chosen") {
    const Sphere ball{{-1.634281781449563, -1.0717790055709413, 2.5716379031527428}, 0.6124516512331188};
    Scene scene;
    scene.camera = {{-1.5979235824601914, -0.4637984682529408, 2.507335704847098},
                    {-2.4351113700995084, -0.3845538665752724, 2.305251977067223},
                    {-.1, -.2, -1},
                    15,
                    {}};
    scene.background = {.2, .3, .9};
    scene.materials = {{.rgb = {.8, .6, .3}, .reflection = 0, .diffuse = .6, .ambient = .2, .specular = 0}};
    scene.primitives = {{ball, 0, {}}};
    const View view{.camera = scene.camera, .width = 40, .height = 30};
    ThreadPool pool(1);
    CHECK(choose_accuracy(scene, view, 1e-2, {}, {}, pool).precision != Precision::float32);
    scene.primitives[0].shape = Sphere{ball.centre, ball.radius * .99};
    CHECK(choose_accuracy(scene, view, 1e-2, {}, {}, pool).precision == Precision::float32);
}

TEST_CASE("pictures of any size can be sampled") {
    ThreadPool pool(1);
    const Scene scene = read_scene("crosscheck/ambient");
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 3000}, {3000, 1}, {33, 31}, {1000, 2}}) {
        const View view{.camera = scene.camera, .width = width, .height = height};
        CHECK(choose_accuracy(scene, view, 1e-3, {}, {}, pool).rounding < 1e-3);
    }
}

TEST_CASE("an edge is a jump, not a gradual change") {
    ThreadPool pool(1);
    Scene scene = read_scene("crosscheck/highlights");
    const View view{.camera = scene.camera, .width = columns, .height = rows};
    Tracer tracer(scene, Precision::float64);
    int near = 0, nearer = 0;
    for (int p = 0; p < columns * rows; ++p) {
        near += on_edge(tracer, view, pool, {p % columns, p / columns}, .5, 1e-3);
        nearer += on_edge(tracer, view, pool, {p % columns, p / columns}, .05, 1e-3);
    }
    CHECK(near > 0);
    CHECK(near < columns * rows / 2);
    CHECK(nearer < near);
    // The search along a slope of a million steps ends without finding its ends: it is no edge.
    scene = parse_scene(
        "camera { position <0, 0, 9> look_at <0, 0, 0> sky <0, 1, 0> angle 20 }\n"
        "light { position <9, 9, 9> color <1, 1, 1> }\n"
        "sphere { <0, 0, 0>, 1 material { rgb <.8, .8, .8> } }\n",
        "ball");
    Tracer ball(scene, Precision::float64);
    CHECK(!on_edge(ball, {.camera = scene.camera, .width = 9, .height = 9}, pool, {4, 4}, .5, 1e-9));
    CHECK(on_edge(ball, {.camera = scene.camera, .width = 9, .height = 9}, pool, {4, 4}, 4, 1e-9));
}

}  // namespace strahl::accuracy
