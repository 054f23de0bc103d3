// Culling of bodies that cannot be hit never changes a picture.
#include "trace/world/light_culling.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/levels.h"
#include "tests/unit/scenes.h"
#include "trace/lights/light_buffer.h"
#include "trace/tracer.h"
#include "trace/world/build_world.h"

namespace strahl::light_culling {

constexpr int columns = 40, rows = 30, random_scenes = 120;

/// Adds so many bodies to the scene, black ones in a black ball far away, that it has a hierarchy instead of
/// culling.
Scene crowded(Scene scene) {
    scene.materials.push_back({.rgb = Color(0), .reflection = 0, .diffuse = 0, .specular = 0});
    const int black = static_cast<int>(scene.materials.size()) - 1;
    const DVec3 out{3e4, -2e4, -5e4};
    scene.primitives.push_back({Sphere{out, .3}, black, {}});
    for (int i = 0; i < most_item_bins; ++i)
        scene.primitives.push_back({Sphere{out + DVec3(i % 4, i / 4 % 4, i / 16) / 20., .01}, black, {}});
    return scene;
}

double largest_difference(const Scene& scene, Precision precision) {
    const View view{
        .camera = scene.camera, .width = columns, .height = rows, .depth = std::min(scene.settings.max_trace_level, 7)};
    const Frame few = render(scene, view, precision, 2), many = render(crowded(scene), view, precision, 2);
    double most = 0;
    for (std::size_t i = 0; i < few.rgb.size(); ++i)
        most = std::max(most, std::abs(few.rgb[i] - many.rgb[i]) / std::max(1., std::abs(few.rgb[i])));
    return most;
}

TEST_CASE("light culling does not change pictures") {
    int seen = 0;
    for (const std::string& name : scene_names()) {
        CAPTURE(name);
        const Scene scene = read_scene(name);
        if (scene.primitives.size() > most_item_bins) continue;
        // Mirrors that face mirrors, in the demo, magnify the rounding by which two placements differ.
        CHECK(largest_difference(scene, Precision::float64) < (name == "demo" ? 1e-6 : 1e-8));
        ++seen;
    }
    CHECK(seen >= 50);
}

TEST_CASE("light culling does not change pictures of random scenes") {
    for (int seed = 0; seed < random_scenes; ++seed) {
        CAPTURE(seed);
        const RandomScene what{.transparent = seed % 3 != 0, .lights = seed % 2 == 1, .camera_inside = seed % 5 == 4};
        CHECK(largest_difference(random_scene(1000 + seed, what), Precision::float64) < 1e-8);
    }
}

TEST_CASE("bodies between a body and a light are among its occluders, and in its cone") {
    std::mt19937 engine(7);
    const auto dice = [&](double low, double high) { return low + (high - low) * engine() * 0x1p-32; };
    const auto place = [&](double size) { return DVec3(dice(-size, size), dice(-size, size), dice(-size, size)); };
    const auto product = [](const DVec3& a, const DVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const auto length = [&](const DVec3& v) { return std::sqrt(product(v, v)); };
    int between = 0, left_out = 0, outside_cone = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<BoundingVolume> bodies(6);
        for (BoundingVolume& body : bodies) {
            body.ball = {place(4), std::exp(dice(-5, .7))};
            body.box = {body.ball.centre - body.ball.radius, body.ball.centre + body.ball.radius};
        }
        bodies[5] = {{}, {}, true, {0, 0, 1}, dice(-3, 3)};
        const DVec3 light = place(std::exp(dice(0, 4)));
        const double margin = 32 * 0x1p-23 * (4 + length(light));
        for (std::size_t lit = 0; lit < bodies.size(); ++lit) {
            const BodySet set = occluders_of(bodies, lit, {light}, margin);
            for (int sample = 0; sample < 8; ++sample) {
                DVec3 point = place(9);
                if (bodies[lit].plane)
                    point.z = bodies[lit].distance;
                else
                    point = bodies[lit].ball.centre + point * (bodies[lit].ball.radius / length(point));
                const DVec3 way = light - point;
                const double distance = length(way);
                for (std::size_t i = 0; i < bodies.size(); ++i) {
                    if (i == lit) continue;
                    const LightCone<float> cone = cone_of<float>(bodies[i], {light}, margin);
                    const float cosine = -float(way.x / distance) * cone.axis.x -
                                         float(way.y / distance) * cone.axis.y - float(way.z / distance) * cone.axis.z;
                    const bool known = set >> i & 1, looked_at = cosine >= cone.cosine && distance > cone.distance;
                    left_out += !known, outside_cone += !looked_at;
                    const DVec3 to_centre = bodies[i].ball.centre - point;
                    const double along = std::clamp(product(to_centre, way) / distance, 0., distance);
                    const bool blocks = bodies[i].plane
                                            ? (point.z - bodies[i].distance) * (light.z - bodies[i].distance) < 0
                                            : length(to_centre - way * (along / distance)) < bodies[i].ball.radius;
                    if (!blocks) continue;
                    ++between;
                    CHECK(known);
                    CHECK(looked_at);
                }
            }
        }
    }
    MESSAGE(between << " between, " << left_out << " left out, " << outside_cone << " outside their cones");
    CHECK(between > 10000);
    CHECK(left_out > 100000);  // else culling gains nothing
    CHECK(outside_cone > 100000);
}

TEST_CASE("rays to parallel light that meet a body start in its shadow") {
    std::mt19937 engine(8);
    const auto dice = [&](double low, double high) { return low + (high - low) * engine() * 0x1p-32; };
    const auto place = [&](double size) { return DVec3(dice(-size, size), dice(-size, size), dice(-size, size)); };
    int met = 0, outside = 0;
    for (int round = 0; round < 300; ++round) {
        DVec3 towards = place(1);
        if (round % 4 == 0) towards = DVec3(round % 3 == 0, round % 3 == 1, round % 3 == 2);  // along an axis
        towards /= std::sqrt(dot_product(towards, towards));
        std::vector<BoundingVolume> bodies(6);
        for (BoundingVolume& body : bodies) {  // some far longer than wide
            const DVec3 half(std::exp(dice(-4, 1)), std::exp(dice(-4, 1)), std::exp(dice(-4, 1))), centre = place(4);
            body.box = {centre - half, centre + half};
            body.ball = {centre, std::sqrt(dot_product(half, half))};
        }
        bodies[5] = {{}, {}, true, {0, 0, 1}, dice(-3, 3)};
        const LightAxes axes = axes_across(bodies, towards);
        const ParallelShadows<float> shadows = shadows_of<float>(bodies, axes, 1e-4);
        CHECK(std::abs(dot_product(axes.u, axes.v)) + std::abs(dot_product(axes.u, towards)) < 1e-12);
        for (int sample = 0; sample < 200; ++sample) {
            const int i = sample % 6;
            const DVec3 start = place(6);
            const double u = dot_product(start, axes.u), v = dot_product(start, axes.v);
            const bool shadowed = u >= shadows.left[i] && u <= shadows.right[i] && v >= shadows.bottom[i] &&
                                  v <= shadows.top[i] && dot_product(start, towards) <= shadows.end[i];
            outside += !shadowed;
            if (i == 5) {
                CHECK(shadowed);
                continue;
            }
            // Choose a point of the body, then a start from which a ray to the light meets it.
            DVec3 point;
            for (int c = 0; c < 3; ++c) point[c] = dice(bodies[i].box.low[c], bodies[i].box.high[c]);
            const DVec3 before = point - dice(0, 20) * towards;
            ++met;
            CHECK(dot_product(before, axes.u) >= shadows.left[i]);
            CHECK(dot_product(before, axes.u) <= shadows.right[i]);
            CHECK(dot_product(before, axes.v) >= shadows.bottom[i]);
            CHECK(dot_product(before, axes.v) <= shadows.top[i]);
            CHECK(dot_product(before, towards) <= shadows.end[i]);
        }
    }
    CHECK(met > 40000);
    CHECK(outside > 30000);  // else culling gains nothing
}

TEST_CASE("a body is isolated if no other body reaches into it") {
    const auto ball = [](const DVec3& centre, double radius) {
        return BoundingVolume{{centre - radius, centre + radius}, {centre, radius}};
    };
    const BoundingVolume floor{{}, {}, true, {0, 0, 1}, 0}, glass = ball({0, 0, 2}, 1);
    CHECK(isolated({glass, floor, ball({3, 0, 2}, 1)}, 0, 1e-6));
    CHECK_FALSE(isolated({floor, glass}, 0, 1e-6));                 // planes are infinite
    CHECK_FALSE(isolated({glass, ball({1.9, 0, 2}, 1)}, 0, 1e-6));  // overlapping
    CHECK_FALSE(isolated({glass, ball({0, 0, 2}, .5)}, 0, 1e-6));   // something inside
    CHECK_FALSE(isolated({glass, ball({0, 0, 2}, 5)}, 0, 1e-6));    // inside something
    CHECK_FALSE(isolated({glass, ball({2, 0, 2}, 1)}, 0, 1e-6));    // touching
    CHECK_FALSE(isolated({ball({0, 0, 1}, 1), floor}, 0, 1e-6));    // standing on the floor
    CHECK_FALSE(isolated({ball({0, 0, .5}, 1), floor}, 0, 1e-6));   // cut by it
    CHECK(isolated({glass, ball({1.5, 1.5, 2}, 1)}, 0, 1e-6));      // boxes overlap, balls do not
}

/// A floor under clusters of balls and cylinders, small and large, many of which touch or overlap.
Scene large_world(int seed, bool scattered) {
    std::mt19937 engine(seed);
    const auto dice = [&](double low, double high) { return low + (high - low) * engine() * 0x1p-32; };
    const auto place = [&](double size) { return DVec3(dice(-size, size), dice(-size, size), dice(-size, size)); };
    Scene scene;
    scene.camera.fov = 30, scene.camera.position = {1, -7, 3}, scene.camera.look_at = {0, 0, 0};
    scene.materials = {{.rgb = Color(.9, .6, .3), .reflection = .3}, {.rgb = Color(.4, .6, .8), .reflection = 0}};
    scene.primitives.push_back({Plane{{0, 0, -2}, {1, 0, -2}, {0, 1, -2}}, 1, {}});
    for (int i = 0; i < 260; ++i) {
        const DVec3 centre = place(scattered ? 2 : i % 4 * .7);
        const double radius = std::exp(dice(-5, i % 40 ? -1.5 : -.3));
        if (i % 3 == 2) {
            scene.primitives.push_back({Cylinder{centre, centre + place(.3), radius / 2}, i % 2, {}});
            continue;
        }
        scene.primitives.push_back({Sphere{centre, radius}, i % 2, {}});
        if (i % 6 == 1)  // that touches
            scene.primitives.push_back({Sphere{centre + DVec3(0, 1.5 * radius, 0), radius / 2}, 0, {}});
    }
    // Before all bodies, among them, nearly touching one, far away; grazing the floor; parallel; in a cone.
    const DVec3 ball = std::get<Sphere>(scene.primitives[1].shape).centre;
    const double size = std::get<Sphere>(scene.primitives[1].shape).radius;
    const DVec3 places[] = {{4, -5, 6},      place(1),      ball + DVec3(0, 0, 1.0001 * size),
                            {-300, 40, 200}, {9, 3, -1.99}, {-3, 2, 4},
                            {0, 0, 0},       {0, 0, 0}};
    for (const DVec3& position : places) {
        Light& light = scene.lights.emplace_back();
        light.position = position, light.color = Color(.3);
    }
    scene.lights[5].spot.emplace();
    scene.lights[6].direction = DVec3(1, 2, -3), scene.lights[7].direction = DVec3(0, 1, -.001);
    return scene;
}

/// Traces the picture in stripes, each by a tracer of its own for which light buffers do not pay.
std::vector<double> in_stripes(const Scene& scene, const View& view, Precision precision, Simd simd) {
    const Lattice whole{.columns = view.width, .rows = view.height};
    std::vector<double> values(3 * std::size_t(view.width) * view.height);
    ThreadPool pool(1);
    constexpr int stripe = 16;
    for (int row = 0; row < view.height; row += stripe) {
        Tracer tracer(scene, precision, simd);
        tracer.trace({view, pool, [&](const Tile& tile) { place(tile, whole, values); }},
                     Lattice{.y = row, .columns = view.width, .rows = std::min(stripe, view.height - row)});
    }
    return values;
}

TEST_CASE("light buffers do not change a bit") {
    for (int seed = 0; seed < 4; ++seed) {
        const Scene scene = large_world(seed, seed % 2);
        const View view{.camera = scene.camera, .width = 96, .height = 80, .depth = 4};
        for (const Simd simd : all_levels())
            for (const Precision precision : {Precision::float32, Precision::float64}) {
                CAPTURE(seed);
                CAPTURE(name(simd));
                CAPTURE(name(precision));
                CHECK(render(scene, view, precision, 2, simd).rgb == in_stripes(scene, view, precision, simd));
            }
    }
}

TEST_CASE("light buffers are bounded, and the same for any number of threads") {
    Scene scene = large_world(1, true);
    const auto made = [](const Scene& from, int threads) {
        ThreadPool pool(threads);
        const BuiltWorld<float> built(from, {}, pool);
        const LightBuffers<float> buffers(built.world(), pool);
        int lights = 0;
        for (int i = 0; i < built.world().light_count; ++i) lights += buffers.buffers()[i].faces != nullptr;
        return std::pair(lights, buffers.candidates());
    };
    const auto [lights, candidates] = made(scene, 1);
    CHECK(lights >= 6);
    CHECK(candidates <= LightBuffers<float>::most_per_item * std::int64_t(lights * scene.primitives.size()));
    CHECK(made(scene, 3) == std::pair(lights, candidates));
    // If all bodies reach into all cells, no buffer is made.
    for (Primitive& primitive : scene.primitives)
        if (Sphere* const ball = std::get_if<Sphere>(&primitive.shape)) ball->radius = 3;
    CHECK(made(scene, 1).second == 0);
}

}  // namespace strahl::light_culling
