// Glass: nested bodies, bubbles, and the threshold of total reflection.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "num/thread_pool.h"
#include "tests/referee/referee.h"
#include "tests/stability/naive.h"
#include "tests/stability/stage.h"
#include "tests/unit/levels.h"
#include "tests/unit/trace/cut_out.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

constexpr double degree = 3.14159265358979323846 / 180;

/// An eye in glass of index 1.5 below z = 0, looking along +x and up by `angle` degrees, over a red floor far below and
/// under a white sky. Rays that are totally reflected see the floor, others the sky.
Scene under_glass(double angle, double fov) {
    Stage stage;
    stage.look({0, 0, -1}, {std::cos(angle * degree), 0, -1 + std::sin(angle * degree)}, fov).background({1, 1, 1});
    stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, glass(1.5));
    stage.put(Plane{{0, 0, -9}, {1, 0, -9}, {0, 1, -9}}, glow({1, 0, 0}));
    return stage.scene;
}

/// Part of a picture of 48x36 pixels, traced alone.
std::vector<double> crop(const Scene& scene, Precision precision, const Lattice& pixels) {
    ThreadPool pool(1);
    Tracer tracer(scene, precision);
    return values_of(tracer, {.camera = scene.camera, .width = 48, .height = 36, .depth = 10}, pixels, pool);
}

}  // namespace

TEST_CASE("total reflection at its threshold") {
    // cos = sqrt(5/9), where k = 1 - n^2 (1 - cos^2) is 0: rounding makes it negative, positive or 0.
    const double critical = std::asin(std::sqrt(5. / 9)) / degree;  // of the ray above the horizon
    int naive_nan = 0, naive_wrong = 0;
    for (int i = -2000; i <= 2000; ++i) {
        const float cosine = static_cast<float>(std::sqrt(5. / 9)) + static_cast<float>(i) * 6e-8f;
        const float k = 1 - 1.5f * 1.5f * (1 - cosine * cosine);
        const Quadruple exact = 1 - Quadruple(2.25) * (1 - Quadruple(cosine) * cosine);
        naive_nan += std::isnan(std::sqrt(k));
        naive_wrong += (k < 0) != (exact < 0);
    }
    MESSAGE("sqrt(k) is no number for " << naive_nan << " of 4001 rays; k has the wrong sign for " << naive_wrong);
    CHECK(naive_nan > 1000);
    for (const double fov : {20., 1e-3, 1e-6, 1e-9, 1e-12})
        for (const Precision precision : precisions) {
            CAPTURE(fov);
            const Frame frame = shoot(under_glass(critical, fov), precision, {65, 49});
            CHECK(not_finite(frame) == 0);
            // Every pixel is one or the other; no light is lost or counted twice.
            CHECK(count(frame, {1, 1, 1}) + count(frame, {1, 0, 0}) == 65 * 49);
            // As long as double resolves the angles, the threshold is in the middle row.
            if (precision == Precision::float32 || fov < 1e-9 || fov > 1) continue;
            CHECK(pixel(frame, 32, 21) == Color(1, 1, 1));
            CHECK(pixel(frame, 32, 27) == Color(1, 0, 0));
        }
}

TEST_CASE("rays at the threshold of total reflection leave along the surface") {
    // Just above the threshold the ray leaves at a grazing angle and must not hit the glass again.
    const double critical = std::asin(std::sqrt(5. / 9)) / degree;
    for (const double above : {1e-3, 1e-6, 1e-9, 1e-12})
        for (const Precision precision : precisions) {
            const Frame frame = shoot(under_glass(critical + above, above / 10), precision, {9, 9});
            CHECK(not_finite(frame) == 0);
            if (precision != Precision::float32 || above > 1e-4) CHECK(count(frame, {1, 1, 1}) == 81);
        }
}

TEST_CASE("a bubble of air in glass of water") {
    // Naive: a surface hit from outside is entered from air. In a ball of index 1.5 with one of 1.2 inside, the ratio
    // at the inner surface is 1.5 / 1.2, not 1 / 1.2.
    Stage stage;
    stage.background({.1, .2, .3}).light({-4, -5, 6});
    stage.put(Sphere{{0, 0, 0}, 1}, glass(1.5, .95)).put(Sphere{{.1, -.2, .1}, .6}, glass(1.2, .95));
    stage.put(Sphere{{.2, -.1, .1}, .2}, glass(1., .95)).put(Sphere{{.4, 3, .2}, 1}, paint({.9, .3, .1}));
    stage.put(Plane{{0, 0, -1.5}, {1, 0, -1.5}, {0, 1, -1.5}}, paint({.3, .6, .3}));
    const Referee<long double> exact(stage.scene, stage.scene.camera, 32, 24, 10);
    // The naive picture equals that of glass whose inner bodies have the indices 1.2 * 1.5 and 1.5.
    Scene naive_scene = stage.scene;
    naive_scene.materials[naive_scene.primitives[1].material].ior = 1.5 * 1.2;
    naive_scene.materials[naive_scene.primitives[2].material].ior = 1.5 * 1.2;
    const Frame naive_frame = shoot(naive_scene, Precision::float64, {32, 24, 10});
    for (const Precision precision : precisions) {
        const Frame frame = shoot(stage.scene, precision, {32, 24, 10});
        CHECK(not_finite(frame) == 0);
        CHECK(share_apart(frame, naive_frame, .02) > .05);
        const double tolerance = precision == Precision::float32 ? 1e-3 : 1e-9;
        int wrong = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 32; ++x) wrong += !exact.explains(x, y, &frame.rgb[3 * (y * 32 + x)], tolerance, 3e-3);
        CHECK(wrong == 0);
    }
}

TEST_CASE("glass of index 1, or almost 1, does not refract") {
    for (const double ior : {1., 1 + 0x1p-52, 1 - 0x1p-53}) {
        Stage stage;
        stage.background({.5, .5, .5}).put(Sphere{{.3, 3, .2}, .8}, glow({1, .5, .25}));
        const Frame without = shoot(stage.scene, Precision::float64);
        for (int i = 0; i < 4; ++i) stage.put(Sphere{{.1 * i, 0, 0}, 1}, glass(ior));
        CHECK(share_apart(shoot(stage.scene, Precision::float64, {.depth = 20}), without, 1e-9) < .003);
    }
}

TEST_CASE("indices of refraction from 1e-9 to 1e9: right, and the same with any threads, lanes and crop") {
    // Naive: k = 1 - n^2 (1 - cos^2) is all rounding, and refracted directions are of any length.
    const float cosine = 1 - 0x1p-24f;  // of a ray that should be totally reflected if n is above 2896
    const float naive = 1 - 1e9f * 1e9f * (1 - cosine * cosine);
    CHECK(std::abs(naive) > 1e10);
    const Lattice window{.x = 8, .y = 4, .columns = 9, .rows = 7};
    int lit = 0;
    for (const double ior : {1e-9, 1e-4, .01, 10., 17., 100., 1e4, 1e6, 1e9})
        for (const bool nested : {false, true}) {
            CAPTURE(ior);
            CAPTURE(nested);
            Stage stage;
            stage.look({0, 0, 2}, {1, 3, 1}, nested ? 10 : 1, {2, 3, 1}).light({2, 0, 0}, {0, 0, 1});
            Material body = glass(ior);
            body.rgb = {.9, .8, .7}, body.diffuse = 1;
            stage.put(Cylinder{{0, 0, 1}, {0, 1, 0}, 3}, body);
            if (nested) stage.put(Sphere{{0, 2, 1}, 1}, glass(1 / ior)).put(Sphere{{0, 4, 1}, 1.5}, glass(1e9));
            const Still shot{48, 36, 10, 1, Simd::scalar};
            const Frame exact = shoot(stage.scene, Precision::extended, shot);
            for (const Precision precision : {Precision::float32, Precision::float64}) {
                const Frame frame = shoot(stage.scene, precision, shot);
                for (const Simd simd : fused_levels())
                    for (const int threads : {1, 3})
                        CHECK(shoot(stage.scene, precision, {48, 36, 10, threads, simd}) == frame);
                CHECK(crop(stage.scene, precision, window) == cut_out(frame.rgb, frame.width, window));
                if (!nested) CHECK(share_apart(frame, exact, precision == Precision::float32 ? 1e-2 : 1e-4) < .01);
            }
            lit += *std::max_element(exact.rgb.begin(), exact.rgb.end()) > .1;
        }
    CHECK(lit > 9);
}

TEST_CASE("extreme indices of refraction") {
    for (const double ior : {1e-3, .5, 10., 1e3, 1e6, 1e9, 1e-9})
        for (const Precision precision : precisions) {
            CAPTURE(ior);
            Stage stage;
            stage.background({.25, .5, 1}).light({-4, -5, 6});
            stage.put(Sphere{{0, 0, 0}, 1}, glass(ior)).put(Sphere{{1.5, 0, 0}, 1}, glass(1.5));
            const Frame frame = shoot(stage.scene, precision, {.depth = 10});
            CHECK(not_finite(frame) == 0);
        }
}
