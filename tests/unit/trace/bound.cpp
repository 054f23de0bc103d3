// The bound on what rays can still contribute, compared with pictures with and without those rays.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "num/thread_pool.h"
#include "tests/referee/examples.h"
#include "tests/referee/random_scene.h"
#include "trace/tracer.h"
#include "trace/world/light_bound.h"

namespace strahl::bound {

View view_of(const Scene& scene, int depth, double error = 0) {
    return {.camera = scene.camera, .width = 24, .height = 18, .depth = depth, .error = error};
}
double brightest(const Frame& frame) {
    double most = 0;
    for (const double v : frame.rgb) most = std::max(most, std::abs(v));
    return most;
}
double difference(const Frame& a, const Frame& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) most = std::max(most, std::abs(a.rgb[i] - b.rgb[i]));
    return most;
}
/// The bound does not include rounding.
constexpr double rounding = 1e-9;

struct Traced {
    Frame frame;
    Counts counts;
};
Traced trace(const Scene& scene, int depth, double error = 0) {
    const View view = view_of(scene, depth, error);
    const Lattice whole{.columns = view.width, .rows = view.height};
    Traced traced{{view.width, view.height, std::vector<double>(3 * view.width * view.height)}, {}};
    Tracer tracer(scene, Precision::float64);
    ThreadPool pool(2);
    traced.counts = tracer.trace({view, pool, [&](const Tile& tile) { place(tile, whole, traced.frame.rgb); }}, whole);
    return traced;
}

void hold(const Scene& scene, int depth) {
    const auto [all, everything] = trace(scene, depth);
    const Frame deeper = trace(scene, depth + 3).frame;
    CHECK(brightest(all) <= bound_for(scene, depth).brightest.back() + rounding);
    const double past = everything.lost();  // only rays past the last generation are omitted here
    CHECK(difference(deeper, all) <= past + rounding);
    for (const double error : {1e-1, 1e-2, 1e-3, 1e-4}) {
        CAPTURE(error);
        const auto [frame, counts] = trace(scene, depth, error);
        CHECK(difference(frame, all) <= error + rounding);
        CHECK(difference(frame, deeper) <= counts.lost() + rounding);
        CHECK(counts.lost() <= error + past + rounding);
        CHECK(counts.lost() >= 0);
    }
}

TEST_CASE("no more radiance is lost than the bound says") {
    for (int seed = 0; seed < 40; ++seed) {
        CAPTURE(seed);
        const RandomScene what{.lights = seed % 3 == 1, .patterns = seed % 2 == 1, .camera_inside = seed % 4 == 3};
        hold(random_scene(seed, what), 1 + seed % 5);
    }
    for (const auto& [title, scene, depth] : examples()) {
        CAPTURE(std::string(title));
        if (scene.primitives.size() < 20) hold(scene, std::min(depth, 5));
    }
}

/// Words of POV-Ray's finishes.
constexpr void (*words[])(Material&) = {
    [](Material& own) { own.metallic = 1.4, own.gilding = .7; },
    [](Material& own) { own.blinn = .6, own.roughness = .1; },
    [](Material& own) { own.brilliance = 2; },
    [](Material& own) { own.facing = .3, own.falloff = 3; },
    [](Material& own) { own.fresnel = own.conserve = 1, own.ior = 1.4; },
    [](Material& own) { own.irid = .5, own.film = .6; },
    [](Material& own) { own.behind = 1.5; },
    [](Material& own) { own.both_sides = 1; },
    [](Material& own) { own.shadow = 0; },
    [](Material& own) { own.clarity = .6; },
    [](Material& own) {
        own.mirror = {1.3, .4, .9};
    },
    [](Material& own) { own.rgb.transmit = .4, own.rgb.filter = .5; },
    [](Material& own) { own.seen = 0; },
    [](Material& own) { own.mirrored = 0; },
    [](Material& own) {
        Material coat = own;
        coat.rgb = {.9, .7, .2}, coat.rgb.transmit = .4, coat.rgb.filter = .3, coat.refraction = 0;
        own.coats = {coat};
    },
    [](Material&) {},
};

/// Gives the bodies of a scene finishes of POV-Ray, and its lights what only POV-Ray's have.
Scene finished(Scene scene, int seed) {
    for (int number = seed; Material & own : scene.materials) words[number++ % std::size(words)](own);
    for (int number = seed; Light & own : scene.lights) {
        if (number % 3 == 1) own.fade_distance = 4, own.fade_power = 1.5;
        if (number++ % 3 == 2) own.shadowless = true;
    }
    if (seed % 5 == 1) scene.settings.adc_bailout = .004;
    if (seed % 5 == 2) scene.fog = Fog{.distance = 20, .color = {.5, .6, .7}, .filter = .4};
    return scene;
}

TEST_CASE("no more radiance is lost with finishes than the bound says") {
    for (int seed = 0; seed < 48; ++seed) {
        CAPTURE(seed);
        const RandomScene what{.lights = seed % 3 == 1, .patterns = seed % 2 == 1, .camera_inside = seed % 4 == 3};
        hold(finished(random_scene(seed, what), seed), 1 + seed % 5);
    }
}

TEST_CASE("bodies beside one with a finish are traced as without it") {
    std::uint64_t pruned = 0;
    for (int seed = 0; seed < 12; ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.patterns = seed % 2 == 1});
        const auto there = static_cast<int>(scene.materials.size());
        scene.materials.push_back({.reflection = 0, .diffuse = 0, .specular = 0});
        scene.primitives.push_back({Sphere{{1e3, 1e3, 1e3}, 1e-3}, there, {}});
        const auto [plain, rays] = trace(scene, 5, .3);
        for (double Material::*const word : {&Material::metallic, &Material::irid, &Material::gilding}) {
            scene.materials.back().*word = .7;
            const auto [beside, as_many] = trace(scene, 5, .3);
            CHECK(beside == plain);
            CHECK(as_many.total() == rays.total());
        }
        pruned += trace(scene, 5).counts.total() - rays.total();
    }
    CHECK(pruned > 0);
}

TEST_CASE("glass that brightens light") {
    Scene scene;
    scene.camera = {{0, -6, 2}, {0, 0, 0}, {0, 0, -1}, 20, {}};
    scene.lights = {{{0, 0, 5}, {1, 1, 1}}};
    scene.materials = {{.reflection = .5, .specular = 0},
                       {.rgb = {3, 2, 1}, .reflection = 0, .refraction = .9, .diffuse = 0, .specular = 0}};
    scene.primitives = {{Plane{}, 0, {}}, {Sphere{{0, 0, 2}, .8}, 1, {}}};
    hold(scene, 4);
    scene.primitives.insert(scene.primitives.end(), 500, scene.primitives[1]);  // the bound is infinite
    const auto [frame, counts] = trace(scene, 2, .1);
    CHECK(frame == trace(scene, 2).frame);
    CHECK(std::isinf(counts.lost()));
}

TEST_CASE("a larger error needs fewer rays, and error 0 traces all") {
    const Scene scene = facing_mirrors();
    const View view = view_of(scene, 20);
    Tracer tracer(scene, Precision::float64);
    ThreadPool pool(2);
    std::uint64_t last = 0;
    for (const double error : {1e9, 20., 10., 5., 2., 1., 0.}) {
        CAPTURE(error);
        View cut = view;
        cut.error = error;
        const Counts counts = tracer.trace({cut, pool, [](const Tile&) {}}, Lattice{.columns = 24, .rows = 18});
        CHECK(counts.total() >= last);
        if (error == 1e9) CHECK(counts.reflected == 0);
        if (error == 5) CHECK(counts.total() > last);
        last = counts.total();
    }
}

}  // namespace strahl::bound
