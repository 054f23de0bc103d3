// Rectangles that shine, against many points in their place.
#define STRAHL_LEVEL area_light_test
#define STRAHL_SCALAR
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "num/vec_math.h"
#include "tests/referee/dice.h"
#include "tests/unit/levels.h"
#include "tests/unit/scenes.h"
#include "text/parse.h"
#include "trace/lights/area_mean_kernel.h"
#include "trace/lights/grid_parts.h"

using namespace strahl;

namespace {

const std::string stage = R"(
camera { position <0, -9, 4>  look_at <0, 0, 0.8>  up <0, 0, -1>  fov 22 }
defaultmaterial { rgb <0.8, 0.3, 0.2>  reflection 0  diffuse 0.8  ambient 0.05  specular 0.5  pow 40 }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb <0.6, 0.6, 0.55>  specular 0 } }
)";
const std::string lamp = "light { position <-1, -1, 4>  color <1, .9, .8>  edges <2, 0, 0>, <0, 1.5, 0> }\n";
const std::string bodies = R"(
sphere { <-1, 0, 1>, 1 }
box { <0.8, 1, 0>, <2, 2.2, 2> }
cylinder { <1, -2, 0>, <1, -2, 1.5>, 0.3 }
sphere { <-1.5, -2.5, 0.6>, 0.5  material { rgb <0.9, 0.6, 0.5>  ambient 0  diffuse 0.05  refraction 0.85  ior 1.3 } }
)";
/// Returns so many balls that they are looked for in a hierarchy.
std::string many_balls() {
    std::string text;
    for (int i = 0; i < 81; ++i)
        text += "sphere { <" + std::to_string(i % 9 * .5 - 2) + ", " + std::to_string(i / 9 * .5 - 2) + ", " +
                std::to_string(.2 + .1 * (i % 4)) + ">, .2 }\n";
    return text;
}

/// Replaces each rectangle of light by n * n points, at the middles of as many equal rectangles.
Scene with_points(Scene scene, int n) {
    std::vector<Light> lights;
    for (const Light& light : scene.lights)
        for (int i = 0; i < n * n; ++i)
            lights.push_back(
                {light.position + ((i % n + .5) / n - .5) * light.area->u + ((i / n + .5) / n - .5) * light.area->v,
                 light.color / (double(n) * n)});
    scene.lights = lights;
    return scene;
}

Frame picture(const Scene& scene, Precision precision, Simd simd = Simd::automatic, double error = 0) {
    const View view{.camera = scene.camera, .width = 40, .height = 30, .depth = 4, .error = error};
    return render(scene, view, precision, 2, simd);
}

struct Deviation {
    double root_mean_square = 0, largest = 0;
};
Deviation difference(const Frame& a, const Frame& b) {
    Deviation result;
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const double off = std::abs(a.rgb[i] - b.rgb[i]);
        sum += off * off, result.largest = std::max(result.largest, off);
    }
    result.root_mean_square = std::sqrt(sum / double(a.rgb.size()));
    return result;
}

/// Traces the scene of a text with one light, with or without its shadows, in a square picture.
Frame light_of(const std::string& text, int size, bool shadows) {
    Scene scene = parse_scene(text, "x");
    scene.lights[0].shadowless = !shadows;
    const View view{.camera = scene.camera, .width = size, .height = size, .depth = 2, .error = 1e-5};
    return render(scene, view, Precision::float64, 2, Simd::automatic);
}

}  // namespace

TEST_CASE("what nothing can hide is the mean over the rectangle") {
    // The middles of 60 by 60 cells are off by about the square of a cell, seen from here.
    for (const char* light :
         {"position <-1, -1, 4>  edges <2, 0, 0>, <0, 1.5, 0>", "position <0, 0, .5>  edges <0, 1, 0>, <.5, 0, 0>",
          "position <3, 2, 2>  edges <0, 0, 1>, <-.6, .8, 0>",
          "position <-1, 0, 3>  edges <1e-5, 0, 0>, <0, 2e-5, 0>"}) {
        CAPTURE(light);
        const Scene scene = parse_scene(stage + "light { color <1, 1, 1>  " + light + " }", "x");
        const Frame points = picture(with_points(scene, 60), Precision::float64);
        const Deviation off = difference(picture(scene, Precision::float64), points);
        CHECK(off.largest < 3e-4);
        CHECK(off.root_mean_square < 3e-5);
        CHECK(difference(picture(scene, Precision::float32), picture(scene, Precision::float64)).largest < 1e-4);
    }
}

TEST_CASE("soft shadows and highlights, of few bodies and of many") {
    for (const std::string& what : {bodies, many_balls()}) {
        const Scene scene = parse_scene(stage + lamp + what, "x");
        const Frame points = picture(with_points(scene, 48), Precision::float64);
        const Deviation off = difference(picture(scene, Precision::float64), points);
        MESSAGE("root mean square " << 510 * off.root_mean_square << "/510, largest " << 255 * off.largest << "/255");
        CHECK(off.root_mean_square < .75 / 510);
        CHECK(off.largest < 4. / 255);
        const Deviation fine = difference(picture(scene, Precision::float64, Simd::automatic, 1e-4), points);
        CHECK(fine.root_mean_square < .25 / 510);
        CHECK(fine.root_mean_square < off.root_mean_square);
        CHECK(difference(picture(scene, Precision::float32), points).root_mean_square < .5 / 510);
    }
}

TEST_CASE("every level gives the same picture of soft shadows") {
    for (const std::string& what : {bodies, many_balls()}) {
        const Scene scene = parse_scene(stage + lamp + what, "x");
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            const Frame scalar = picture(scene, precision, Simd::scalar);
            for (const Simd simd : fused_levels())
                CHECK(std::memcmp(picture(scene, precision, simd).rgb.data(), scalar.rgb.data(),
                                  8 * scalar.rgb.size()) == 0);
        }
    }
}

TEST_CASE("a rectangle that is partly below the horizon shines by what is above") {
    const Scene scene =
        parse_scene(stage + "light { position <0, 2, 0>  color <1, 1, 1>  edges <1, 0, 0>, <0, 0, 2> }", "x");
    const Frame points = picture(with_points(scene, 64), Precision::float64);
    CHECK(difference(picture(scene, Precision::float64), points).largest < .005);
}

TEST_CASE("points that jitter shine from half way to their neighbours, and the middle one of three counts twice") {
    // At half of the light's height an edge hangs: what arrives at (x, 0, 0) comes from points with x below -x.
    const std::string scene_text = R"(
camera { position <0, 0, 4>  look_at <0, 0, 0>  up <0, 1, 0>  fov 30  aspectratio 1 }
light { position <0, 0, 10>  color <1, 1, 1>  edges <2, 0, 0>, <0, 2, 0>  grid COUNT, 3  soft  jitter }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb <1, 1, 1>  reflection 0  ambient 0  specular 0 } }
box { <0, -99, 5>, <99, 99, 5.000001> }
)";
    constexpr int size = 48;
    for (const int points : {1, 2, 3, 4, 5, 6}) {
        std::string text = scene_text;
        text.replace(text.find("COUNT"), 5, std::to_string(points));
        const Frame shaded = light_of(text, size, true), whole = light_of(text, size, false);
        // Each point's share of the light is the sum of its shares in the parts of the row that it belongs to.
        std::vector<double> shares(points);
        const auto halve = [&](const auto& self, int first, int last, double share) -> void {
            if (last - first <= 1) {
                shares[first] += share / 2, shares[last] += share / 2;
            } else {
                self(self, first, (first + last) / 2, share / 2);
                self(self, (first + last + 1) / 2, last, share / 2);
            }
        };
        halve(halve, 0, points - 1, 1);
        for (int column = 0; column < size; ++column) {
            const double x = 4 * std::tan(std::acos(-1.) / 6) * (1 - 2 * (column + .5) / size);
            double share = points == 1 ? x < 0 : 0;
            for (int i = 0; i < points && points > 1; ++i) {
                const double step = 2. / (points - 1), low = -1 + (i - .5) * step;
                share += shares[i] * std::clamp((-x - low) / step, 0., 1.);
            }
            const std::size_t at = 3 * (std::size_t(size) * size / 2 + column);
            CAPTURE(points);
            CAPTURE(column);
            CHECK(std::fabs(shaded.rgb[at] / whole.rgb[at] - share) < 1. / 60);  // 64 cells along an edge
        }
    }
}

namespace {

/// Samples a grid once as POV-Ray does: corners first, and quarters where they differ. Each point has one share of
/// light in all parts.
double sampled(int columns, int rows, int adaptive, double strength, const std::function<double(int, int)>& light_of) {
    std::map<std::pair<int, int>, double> known;
    const auto at = [&](int column, int row) {
        const auto [own, is_new] = known.try_emplace({column, row});
        if (is_new) own->second = light_of(column, row);
        return own->second;
    };
    const auto part = [&](const auto& self, int u1, int v1, int u2, int v2, int level) -> double {
        const double a = at(u1, v1), b = at(u2, v1), c = at(u2, v2), d = at(u1, v2);
        const auto differ = [&](double one, double other) { return 3 * strength * std::fabs(one - other) > .1; };
        const bool mixed = differ(a, b) || differ(b, c) || differ(c, d) || differ(d, a);
        if ((u2 - u1 <= 1 && v2 - v1 <= 1) || !(level < adaptive || mixed)) return (a + b + c + d) / 4;
        const int u = u1 + u2, v = v1 + v2;
        return (self(self, u1, v1, u / 2, v / 2, level + 1) + self(self, (u + 1) / 2, v1, u2, v / 2, level + 1) +
                self(self, u1, (v + 1) / 2, u / 2, v2, level + 1) +
                self(self, (u + 1) / 2, (v + 1) / 2, u2, v2, level + 1)) /
               4;
    };
    return part(part, 0, 0, columns - 1, rows - 1, 0);
}

}  // namespace

TEST_CASE("the mean of adaptive sampling of a grid that jitters is that of many pictures") {
    Dice dice(3);
    for (int scene = 0; scene < 30; ++scene) {
        const int columns = 1 + static_cast<int>(dice.in(0, 9.99)), rows = 1 + static_cast<int>(dice.in(0, 9.99));
        const int adaptive = static_cast<int>(dice.in(0, 2.99));
        const double strength = scene % 5 == 0 ? .02 : 1;  // of faint light no differences count
        std::vector<JitteredPoint<double>> points(std::size_t(columns) * rows);
        for (JitteredPoint<double>& own : points) {
            const double low = dice.in(0, .2), kind = dice.in(0, 1);
            own.low = DVec3(low), own.high = DVec3(kind < .3 ? low : 1);
            own.chance = kind < .5 ? 0 : kind < .7 ? 1 : dice.in(0, 1);
        }
        constexpr int pictures = 4000;
        double sum = 0, squares = 0;
        for (int i = 0; i < pictures; ++i) {
            const double own = sampled(columns, rows, adaptive, strength, [&](int column, int row) {
                const auto& point = points[std::size_t(column) * rows + row];
                return (dice.in(0, 1) < point.chance ? point.high : point.low).x;
            });
            sum += own, squares += own * own;
        }
        const double mean = sum / pictures,
                     sigma = std::sqrt(std::max(squares / pictures - mean * mean, 0.) / pictures);
        const AdaptiveMean<double> exact(points, columns, rows, adaptive, DVec3(strength));
        CAPTURE(scene);
        CHECK(std::fabs(exact.mean().y - mean) < 4 * sigma + 1e-9);
    }
}

TEST_CASE("soft shadows of a grid that jitters, with quarters that remain whole, are the mean of many pictures") {
    // An edge hangs before half of the light, as in the case above.
    const std::string scene_text = R"(
camera { position <0, 0, 4>  look_at <0, 0, 0>  up <0, 1, 0>  fov 30  aspectratio 1 }
light { position <0, 0, 10>  color <1, 1, 1>  edges <2, 0, 0>, <0, 2, 0>  grid COUNT, 6  soft  adaptive 0  jitter }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb <1, 1, 1>  reflection 0  ambient 0  specular 0 } }
box { <0, -99, 5>, <99, 99, 5.000001> }
)";
    constexpr int size = 24, pictures = 2000;
    Dice dice(5);
    for (const int columns : {4, 7, 16}) {
        std::string text = scene_text;
        text.replace(text.find("COUNT"), 5, std::to_string(columns));
        const Frame shaded = light_of(text, size, true), whole = light_of(text, size, false);
        for (int column = 0; column < size; ++column) {
            const double x = 4 * std::tan(std::acos(-1.) / 6) * (1 - 2 * (column + .5) / size);
            double sum = 0;
            for (int i = 0; i < pictures; ++i)
                sum += sampled(columns, 6, 0, 1, [&](int own, int) {
                    return -1 + (own + dice.in(-.5, .5)) * 2 / (columns - 1) < -x ? 1. : 0.;
                });
            const std::size_t at = 3 * (std::size_t(size) * size / 2 + column);
            CAPTURE(columns);
            CAPTURE(column);
            CHECK(std::fabs(shaded.rgb[at] / whole.rgb[at] - sum / pictures) < .02);
        }
    }
}

TEST_CASE("a very long rectangle takes no light away") {
    Dice dice(1);
    for (int i = 0; i < 20000; ++i) {
        // The rectangle is almost in the plane of the surface, and wholly in front of it.
        const DVec3 u = std::pow(10, dice.in(0, 14)) * dice.direction();
        const DVec3 across = std::pow(10, dice.in(-9, 0)) * dice.direction(),
                    v = across - dot_product(across, u) / dot_product(u, u) * u;
        const DVec3 middle = dice.vector(-3, 3);
        const DVec3 normal = normalize(cross_product(u, dice.direction()) + dice.in(0, 1e-3) * normalize(v));
        const auto in_front = [&](double a, double b) { return dot(normal, middle + a * u + b * v) > 0; };
        if (in_front(-.5, -.5) && in_front(-.5, .5) && in_front(.5, -.5) && in_front(.5, .5))
            REQUIRE((mean_cosine(normal, middle, u, v) >= 0 && mean_cosine(normal, middle, u, 1e-9 * v) <= 1));
    }
}

TEST_CASE("a point in a lamp is lit by a number") {
    // Straight below the camera is the middle of a cell of the lamp.
    const Scene scene = parse_scene(
        "camera { position <3, 0, 9>  look_at <3, 0, 0>  up <0, 1, 0>  fov 22 }\n"
        "light { position <0, 0, 3>  color <1, 1, 1>  edges <64, 0, 0>, <0, 0, 64> }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { reflection 0 } }\n",
        "x");
    const View view{.camera = scene.camera, .width = 1, .height = 1, .depth = 4};
    for (const Precision precision : {Precision::float32, Precision::float64})
        for (const double value : render(scene, view, precision).rgb) CHECK(std::isfinite(value));
}
