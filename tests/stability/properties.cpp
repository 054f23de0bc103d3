// Pictures do not depend on the unit of length, the origin, mirroring, order, lanes and threads.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/stability/stage.h"
#include "tests/unit/levels.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

Scene mirrored(Scene scene) {
    const auto flip = [](DVec3& p) { p.x = -p.x; };
    flip(scene.camera.position), flip(scene.camera.look_at), flip(scene.camera.up);
    for (Light& light : scene.lights) flip(light.position);
    for (Primitive& primitive : scene.primitives) primitive.transformations.push_back(Scale{{-1, 1, 1}});
    return scene;
}
Frame left_to_right(const Frame& frame) {
    Frame result = frame;
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            for (int c = 0; c < 3; ++c)
                result.rgb[3 * (y * frame.width + x) + c] = frame.rgb[3 * (y * frame.width + frame.width - 1 - x) + c];
    return result;
}

}  // namespace

TEST_CASE("any power of two as the unit of length gives the same bits") {
    const Scene scene = still_life();
    for (const Precision precision : precisions) {
        const Frame frame = shoot(scene, precision);
        REQUIRE(not_finite(frame) == 0);
        for (const int k : {-200, -60, -20, -3, -1, 1, 2, 10, 30, 47}) {
            CAPTURE(k);
            CHECK(shoot(placed(scene, std::ldexp(1, k)), precision) == frame);
        }
    }
}

TEST_CASE("any other unit of length, and any origin: equal up to the rounding of the scene's numbers") {
    const Scene scene = still_life();
    for (const Precision precision : precisions) {
        const Frame frame = shoot(scene, precision);
        const double epsilon = precision == Precision::float32 ? 1e-7 : 2e-16;
        for (const double factor : {1e-6, 1e-3, 10., 1e6}) {
            CAPTURE(factor);
            CHECK(share_apart(shoot(placed(scene, factor), precision), frame, 1e4 * epsilon) < .01);
        }
        // Numbers that are multiples of 2^-6 are exact at 1e12, and so the picture is the same.
        for (const DVec3& by : {DVec3{64, 0, 0}, {-4096, 1024, 64}, {1 << 20, 0, -(1 << 20)}, {0x1p40, 0x1p40, 0x1p40}})
            CHECK(shoot(placed(scene, 1, by), precision) == frame);
        for (const double far : {1e4, 1e6, 1e8}) {
            CAPTURE(far);
            const Frame moved = shoot(placed(scene, 1, {far, -far, far}), precision);
            CHECK(not_finite(moved) == 0);
            // Another point of the grid may become the origin, which changes the last bits; 1e8 itself is exact.
            CHECK(share_apart(moved, frame, 1e4 * epsilon) < .01);
        }
    }
}

TEST_CASE("naive: untransformed float coordinates 1e6 from the origin are off by a sixteenth") {
    const float there = 1e6f + .03f;
    CHECK(std::abs((there - 1e6f) - .03f) > .01f);
}

TEST_CASE("mirror images") {
    const Scene scene = still_life();
    for (const Precision precision : precisions) {
        const Frame frame = shoot(scene, precision, {65, 48}), other = shoot(mirrored(scene), precision, {65, 48});
        const double tolerance = precision == Precision::float32 ? 1e-4 : 1e-11;
        CHECK(share_apart(left_to_right(other), frame, tolerance) < .005);
    }
}

TEST_CASE("the order of separate bodies does not matter, nor, except for the last bits, that of lights") {
    const Scene scene = still_life();
    Scene reversed = scene, lights = scene;
    std::ranges::reverse(reversed.primitives);
    lights.lights.assign(scene.lights.rbegin(), scene.lights.rend());
    for (const Precision precision : precisions) {
        const Frame frame = shoot(scene, precision);
        // Bodies of one kind keep the order in which the light that they transmit is multiplied.
        CHECK(share_apart(shoot(reversed, precision), frame, precision == Precision::float32 ? 1e-6 : 1e-14) == 0);
        CHECK(share_apart(shoot(lights, precision), frame, precision == Precision::float32 ? 1e-6 : 1e-14) == 0);
    }
}

TEST_CASE("the number of threads and lanes does not matter") {
    // Products of round numbers are exact, and would not show whether they are fused with a sum.
    Scene scene = still_life();
    for (Material& m : scene.materials) m.reflection *= .7, m.refraction *= .9, m.rgb.color *= .83, m.ior *= 1.01;
    for (Primitive& primitive : scene.primitives) primitive.transformations.push_back(Rotate{{1, 2, 3}});
    for (const Precision precision : precisions) {
        const Frame frame = shoot(scene, precision, {.threads = 1, .simd = Simd::scalar});
        for (const int threads : {2, 3, 5})
            CHECK(shoot(scene, precision, {.threads = threads, .simd = Simd::scalar}) == frame);
        for (const Simd simd : fused_levels()) CHECK(shoot(scene, precision, {.simd = simd}) == frame);
    }
}

TEST_CASE("turning scene and camera together by 90 degrees") {
    const Scene scene = still_life();
    Scene turned = scene;
    const auto turn = [](DVec3& p) { p = {-p.y, p.x, p.z}; };
    turn(turned.camera.position), turn(turned.camera.look_at), turn(turned.camera.up);
    for (Light& light : turned.lights) turn(light.position);
    for (Primitive& primitive : turned.primitives) primitive.transformations.push_back(Rotate{{0, 0, 90}});
    for (const Precision precision : precisions)
        CHECK(share_apart(shoot(turned, precision), shoot(scene, precision),
                          precision == Precision::float32 ? 1e-4 : 1e-11) < .005);
}

TEST_CASE("precision depends on the distance from the camera, not from the origin") {
    // In float at coordinates of 1e4 to 1e8, where untransformed coordinates give whole percents of wrong pixels.
    const Scene scene = still_life();
    for (const double far : {1e4, 1e6, 1e8}) {
        CAPTURE(far);
        const Scene moved = placed(scene, 1, {far, 0, 0});
        const Frame exact = shoot(moved, Precision::extended);
        CHECK(share_apart(shoot(moved, Precision::float64), exact, 1. / 510) == 0);
        CHECK(share_apart(shoot(moved, Precision::float32), exact, 1. / 510) < .005);
    }
}
