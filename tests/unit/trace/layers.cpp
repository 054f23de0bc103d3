// Layers of pictures: alpha, the geometry of first hits, ids, and light apart.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "tests/referee/dice.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/sanitized.h"
#include "text/parse.h"
#include "trace/tracer.h"

namespace strahl::layers {

Scene scene_of(const char* text) { return parse_scene(text, "layers.cpp"); }

/// A picture with layers: its values by the names of their channels.
using Planes = std::map<std::string, std::vector<float>>;

LayerIds numbered(const Scene& scene) {
    LayerIds ids;
    for (std::size_t i = 0; i < scene.primitives.size(); ++i) ids.bodies.push_back(float(i + 1));
    for (std::size_t i = 0; i < scene.materials.size(); ++i) ids.materials.push_back(float(i + 1));
    return ids;
}

Planes planes(const Scene& scene, View view, const Sampling& sampling, Layers layers,
              Precision precision = Precision::float64, int threads = 2, Lattice part = {}) {
    if (part.columns == 0) part = {.columns = view.width, .rows = view.height};
    layers.ids = std::make_shared<const LayerIds>(numbered(scene));
    view.layers = layers;
    const std::vector<std::string> names = channels_of(layers, static_cast<int>(scene.lights.size()));
    Planes all;
    for (const std::string& name : names) all[name].resize(std::size_t(part.columns) * part.rows);
    ThreadPool pool(threads);
    Tracer tracer(scene, precision);
    const auto keep = [&](const Tile& tile) {
        const Lattice& own = tile.lattice;
        REQUIRE(tile.layers.size() == names.size() * std::size_t(own.columns) * own.rows);
        auto value = tile.layers.begin();
        for (int y = own.y - part.y; y < own.y - part.y + own.rows; ++y)
            for (int x = own.x - part.x; x < own.x - part.x + own.columns; ++x)
                for (const std::string& name : names) all[name][std::size_t(y) * part.columns + x] = *value++;
    };
    tracer.trace({view, pool, keep}, SampledRegion{part, sampling});
    return all;
}
std::vector<double> plain(const Scene& scene, const View& view, const Sampling& sampling,
                          Precision precision = Precision::float64) {
    ThreadPool pool(2);
    Tracer tracer(scene, precision);
    return values_of(tracer, view, {.columns = view.width, .rows = view.height}, pool, sampling);
}

View view_of(const Scene& scene, int width = 40, int height = 30) {
    return {.camera = scene.camera, .width = width, .height = height, .depth = 7};
}
constexpr std::array rgb{"R", "G", "B"};

/// Checks that values are equal but for a share of what they are, or of 1.
void check_near(const std::vector<float>& a, const std::vector<double>& b, std::size_t channel, double share) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double value = b[3 * i + channel];
        most = std::max(most, std::abs(double(a[i]) - value) / std::max(1., std::abs(value)));
    }
    CHECK(most <= share);
}

TEST_CASE("a picture with alpha before its background is the picture with that background") {
    for (std::uint64_t seed = 1; seed <= (sanitized() ? 4 : 40); ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.lights = seed % 2 == 0, .patterns = seed % 3 == 0});
        scene.background = Pigment(.25, .5, 2);
        const View view = view_of(scene);
        for (const Sampling& sampling : {Sampling{.grid = 1}, Sampling{.grid = 2, .centre = true}}) {
            const std::vector<double> whole = plain(scene, view, sampling);
            const Planes parts = planes(scene, view, sampling, {.alpha = true});
            for (std::size_t c = 0; c < 3; ++c) {
                std::vector<float> before = parts.at(rgb[c]);
                for (std::size_t i = 0; i < before.size(); ++i)
                    before[i] += (1 - parts.at("A")[i]) * float(scene.background.color[int(c)]);
                check_near(before, whole, c, 1e-6);
            }
        }
    }
}

TEST_CASE("light with alpha is that before black where no mirror shows the background") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.lights = true, .patterns = true});
        for (Material& material : scene.materials) material.reflection = material.refraction = 0;
        scene.background = Pigment(.25, .5, 2);
        View view = view_of(scene);
        const Planes parts = planes(scene, view, {.grid = 1}, {.alpha = true});
        scene.background = Pigment(0, 0, 0);
        const std::vector<double> black = plain(scene, view, {.grid = 1});
        for (std::size_t c = 0; c < 3; ++c) check_near(parts.at(rgb[c]), black, c, 1e-6);
    }
}

TEST_CASE("how opaque the background is counts where it is seen and where glass shows it, not in mirrors") {
    Scene scene = scene_of(
        "camera { position <0, -9, 0> look_at <0, 0, 0> up <0, 0, -1> fov 20 }\n"
        "background { color <.2, .4, .8> }\n"
        "sphere { <-3, 0, 0>, 1 material { reflection 1 diffuse 0 ambient 0 specular 0 } }\n"
        "sphere { <0, 0, 0>, 1 material { reflection 0 refraction .5 diffuse 0 ambient 0 specular 0 } }\n"
        "sphere { <3, 0, 0>, 1 material { reflection 0 diffuse 0 ambient 0 specular 0 } }\n");
    const View view = view_of(scene, 90, 30);
    const auto at = [](const std::vector<float>& values, int x) { return double(values[15 * 90 + std::size_t(x)]); };
    const Planes clear = planes(scene, view, {.grid = 1}, {.alpha = true});
    const Planes half = planes(scene, view, {.grid = 1}, {.alpha = true, .background = .5});
    for (const auto& [x, alpha, of_half, blue, blue_of_half] :
         {std::tuple(24, 0., .5, 0., .4), std::tuple(4, 1., 1., .8, .8), std::tuple(45, .75, .875, 0., .1),
          std::tuple(86, 1., 1., 0., 0.)}) {
        CAPTURE(x);
        CHECK(at(clear.at("A"), x) == doctest::Approx(alpha));
        CHECK(at(half.at("A"), x) == doctest::Approx(of_half));
        CHECK(at(clear.at("B"), x) == doctest::Approx(blue));
        CHECK(at(half.at("B"), x) == doctest::Approx(blue_of_half));
    }
}

TEST_CASE("edges of alpha are as exact as those of colours, also where both are black") {
    Scene scene = scene_of(
        "camera { position <0, -9, 0> look_at <0, 0, 0> up <0, 0, -1> fov 18 }\n"
        "sphere { <0, 0, 0>, 2 material { reflection 0 diffuse 0 ambient 0 specular 0 } }\n"
        "box { <1, -1, -3>, <1.4, 1, 3> material { reflection 0 diffuse 0 ambient 0 specular 0 } }\n");
    const View view = view_of(scene, 64, 48);
    const Planes cells = planes(scene, view, {}, {.alpha = true}),
                 grid = planes(scene, view, {.grid = 32}, {.alpha = true});
    double squares = 0;
    int between = 0;
    for (std::size_t i = 0; i < cells.at("A").size(); ++i) {
        const double off = double(cells.at("A")[i]) - double(grid.at("A")[i]);
        squares += off * off;
        between += cells.at("A")[i] > 0 && cells.at("A")[i] < 1;
    }
    CHECK(between > 100);
    CHECK(std::sqrt(squares / (64 * 48)) < 1. / 510);
}

TEST_CASE("alpha decides how many rays a lens takes where all light is black") {
    Scene scene = scene_of(
        "camera { position <0, 0, 0> look_at <0, 1, 0> up <0, 0, -1> fov 20 aperture .5 focus 4 }\n"
        "box { <0, 10, -100>, <100, 10.01, 100> material { reflection 0 diffuse 0 ambient 0 specular 0 } }\n");
    const View view = view_of(scene, 64, 8);
    const Planes parts = planes(scene, view, {}, {.alpha = true});
    const double tan_x = frame_of(scene.camera, 8).tan_x, off = (10. / 4 - 1) * .5;
    double squares = 0;
    for (int x = 0; x < 64; ++x) {
        double exact = 0;
        constexpr int places = 1000;
        for (int i = 0; i < places; ++i) {
            const double c = std::clamp(((x + (i + .5) / places) / 32 - 1) * tan_x * 10 / off, -1., 1.);
            exact += (.5 + (c * std::sqrt(1 - c * c) + std::asin(c)) / 3.14159265358979323846) / places;
        }
        for (std::size_t y = 0; y < 8; ++y) {
            const double wrong = double(parts.at("A")[y * 64 + std::size_t(x)]) - exact;
            squares += wrong * wrong / (64 * 8);
        }
    }
    CHECK(std::sqrt(squares) * 510 < 1.5);
}

/// Returns a view through a shutter of two moments, between which the camera moves.
View with_shutter(View view) {
    Camera moved = view.camera;
    moved.position = moved.position + DVec3(.1, 0, .05);
    view.moments = std::make_shared<const std::vector<Shot>>(std::vector<Shot>{{view.camera, 0}, {moved, 0}});
    return view;
}

TEST_CASE("layers of light add up to the picture bit for bit") {
    for (std::uint64_t seed = 1; seed <= (sanitized() ? 5 : 16); ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.lights = true, .patterns = true, .bumps = seed % 4 == 0});
        if (seed % 3 == 0) scene.materials[0].metallic = .5;  // a finish
        if (seed % 5 == 0) scene.camera.aperture = .1;
        const View view = seed == 7 ? with_shutter(view_of(scene)) : view_of(scene);
        const Precision precision = seed % 4 == 1 ? Precision::float32 : Precision::float64;
        const auto lights = scene.lights.size();
        for (const Sampling& sampling : {Sampling{.grid = 1}, Sampling{.grid = 3}, Sampling{.error = 1. / 64}}) {
            const Planes parts = planes(scene, view, sampling, {.alpha = seed % 2 == 0, .light = true}, precision);
            std::vector<double> whole;
            if (seed % 2 == 1) whole = plain(scene, view, sampling, precision);
            for (std::size_t c = 0; c < 3; ++c) {
                const std::string letter = std::string(".") + rgb[c];
                std::vector<float> sum = parts.at("own" + letter);
                const auto add = [&](const std::string& name) {
                    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += parts.at(name + letter)[i];
                };
                for (std::size_t i = 1; i <= lights; ++i) add("light" + std::to_string(i));
                add("reflected"), add("refracted");
                CHECK(sum == parts.at(rgb[c]));
                // In float, cells with patterns are further off: they subtract what colours explain.
                const double off = precision == Precision::float64 ? 1e-5 : sampling.grid == 0 ? 1. / 64 : 1e-4;
                if (seed % 2 == 1) check_near(sum, whole, c, off);
            }
        }
    }
}

TEST_CASE("the layer of a light is the picture that it makes alone, without bounces") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.lights = true, .patterns = seed % 2 == 0});
        scene.fog.reset();
        if (seed % 3 == 0) scene.materials[0].metallic = .5;
        const View view = view_of(scene);
        const Planes parts = planes(scene, view, {.grid = 1}, {.light = true});
        View direct = view;
        direct.depth = 1;
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            Scene alone = scene;
            alone.lights = {scene.lights[i]};
            alone.settings.ambient_light = Color(0), alone.background = Pigment(0, 0, 0);
            const std::vector<double> own = plain(alone, direct, {.grid = 1});
            for (std::size_t c = 0; c < 3; ++c)
                check_near(parts.at("light" + std::to_string(i + 1) + "." + rgb[c]), own, c, 2e-6);
        }
    }
}

TEST_CASE("light that mirrors and glass send is in layers of its own") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed);
        const View view = view_of(scene);
        for (const bool mirrors : {false, true}) {
            Scene some = scene;
            for (Material& material : some.materials) (mirrors ? material.refraction : material.reflection) = 0;
            const Planes parts = planes(some, view, {.grid = 1}, {.light = true});
            if (!mirrors && std::ranges::any_of(some.materials, [](const Material& m) { return m.refraction > 0; }))
                continue;  // total reflection
            for (std::size_t c = 0; c < 3; ++c) {
                const auto& none = parts.at(std::string(mirrors ? "refracted." : "reflected.") + rgb[c]);
                CHECK(std::ranges::all_of(none, [](float value) { return value == 0; }));
            }
        }
    }
}

TEST_CASE("geometry is that of the first hit: distance, position and normal of a ball") {
    const Scene scene = scene_of(
        "camera { position <1, -9, 2> look_at <1, 0, 2> up <0, 0, -1> fov 40 }\n"
        "light { position <0, -20, 0> color <1, 1, 1> }\n"
        "sphere { <1, 0, 2>, 2 material { refraction .5 ior 1.5 } }\n"
        "plane { <0, 5, 0>, <1, 5, 0>, <0, 5, 1> }\n");
    const View view = view_of(scene, 41, 31);
    for (const Precision precision : {Precision::float32, Precision::float64, Precision::extended}) {
        const Planes all = planes(scene, view, {.grid = 1},
                                  {.depth = true, .normal = true, .position = true, .body = true}, precision);
        const std::size_t middle = 15 * 41 + 20, corner = 0;
        const auto vector = [&](const char* layer, std::size_t i) {
            const auto of = [&](const char* axis) { return double(all.at(std::string(layer) + axis)[i]); };
            return DVec3(of(".X"), of(".Y"), of(".Z"));
        };
        CHECK(all.at("depth.Z")[middle] == doctest::Approx(7));
        CHECK(length(vector("position", middle) - DVec3(1, -2, 2)) < 1e-5);
        CHECK(length(vector("normal", middle) - DVec3(0, -1, 0)) < 1e-5);
        CHECK(all.at("CryptoBody00.R")[middle] == 1);
        CHECK(all.at("CryptoBody00.R")[corner] == 2);
        CHECK(vector("position", corner).y == doctest::Approx(5));
        CHECK(all.at("depth.Z")[corner] == doctest::Approx(length(vector("position", corner) - DVec3(1, -9, 2))));
    }
}

TEST_CASE("ids have shares that add up to what bodies cover, the largest first") {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.transparent = false});
        if (seed % 2 == 0) scene.camera.aperture = .1;
        const View view = view_of(scene);
        const Planes all =
            planes(scene, view, {.error = 1. / 64}, {.alpha = true, .depth = true, .body = true, .material = true});
        for (std::size_t i = 0; i < all.at("A").size(); ++i)
            for (const std::string layer : {"CryptoBody0", "CryptoMaterial0"}) {
                double sum = 0, before = 2;
                for (const char* const rank : {"0.R", "0.B", "1.R", "1.B", "2.R", "2.B"}) {
                    const char* const share = rank[2] == 'R' ? "G" : "A";
                    const double own = double(all.at(layer + rank[0] + "." + share)[i]);
                    CHECK(own <= before);
                    CHECK((all.at(layer + rank)[i] > 0) == (own > 0));
                    sum += own, before = own;
                }
                CHECK(sum == doctest::Approx(double(all.at("A")[i])).epsilon(1e-5));
                CHECK((sum > 0) == (all.at("depth.Z")[i] < HUGE_VALF));
            }
    }
}

TEST_CASE("unions that are split count as one body, and copies of their materials as one") {
    const Scene scene = scene_of(
        "camera { position <0, -9, 0> look_at <0, 0, 0> up <0, 0, -1> fov 40 }\n"
        "sphere { <0, 0, 9>, .1 }\n"
        "union { sphere { <-2, 0, 0>, 1 } sphere { <2, 0, 0>, 1 translate <0, .1, 0> } "
        "material { rgb checker { <1, 0, 0>, <0, 1, 0> } } }\n");
    const View view = view_of(scene, 60, 20);
    const Planes all = planes(scene, view, {.grid = 1}, {.body = true, .material = true});
    for (const int x : {22, 38}) {
        CHECK(all.at("CryptoBody00.R")[10 * 60 + std::size_t(x)] == 2);
        CHECK(all.at("CryptoMaterial00.R")[10 * 60 + std::size_t(x)] == 2);
    }
}

TEST_CASE("small bright balls out of focus have their light and what they cover in layers as well") {
    for (int seed = 0; seed < (sanitized() ? 1 : 6); ++seed) {
        CAPTURE(seed);
        Dice dice(seed);
        Scene scene = scene_of(
            "camera { position <0,0,0> look_at <0,1,0> up <0,0,-1> fov 4 aperture .1 focus 5 }\n"
            "global_settings { ambient_light <1,1,1> }  background { color <.1,0,0> }\n"
            "sphere { <0,20,0>, .1  material { rgb <1,1,1>  ambient 1  diffuse 0  specular 0  reflection 0 } }");
        const double radius = dice.in(.01, .08), disc = .3;
        scene.materials[0].ambient = 4 * disc * disc / (radius * radius);
        scene.primitives[0].shape = Sphere{{dice.in(-.3, .3), 20, dice.in(-.3, .3)}, radius};
        const View view = view_of(scene, 24, 24);
        const Sampling sampling{.error = 1. / 510};
        const Planes parts = planes(scene, view, sampling, {.body = true, .light = true});
        const std::vector<double> light = plain(scene, view, sampling);
        for (std::size_t c = 0; c < 3; ++c) check_near(parts.at(rgb[c]), light, c, 1e-4);
        double most = 0;
        const std::vector<float>& covered = parts.at("CryptoBody00.G");
        for (std::size_t i = 0; i < covered.size(); ++i)
            most = std::max(most, std::abs(covered[i] - light[3 * i + 1] / scene.materials[0].ambient));
        CHECK(most < 1e-6);
    }
}

TEST_CASE("layers do not depend on threads, and are the same in a crop, by cells, a lens and a shutter") {
    const int size = sanitized() ? 6 : 9;  // in tenths of the width
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        CAPTURE(seed);
        Scene scene = random_scene(seed, {.lights = true});
        if (seed == 2) scene.camera.aperture = .1;
        const View view =
            seed == 4 ? with_shutter(view_of(scene, 10 * size, 7 * size)) : view_of(scene, 10 * size, 7 * size);
        const Layers layers{.alpha = true,
                            .depth = true,
                            .normal = true,
                            .position = true,
                            .body = true,
                            .material = true,
                            .light = true};
        const Sampling sampling{.error = 1. / 24};
        const Planes whole = planes(scene, view, sampling, layers, Precision::float64, 1);
        CHECK(whole == planes(scene, view, sampling, layers, Precision::float64, 3));
        const Lattice part{.x = size + 4, .y = 2 * size + 3, .columns = 6 * size, .rows = 4 * size + 3};
        for (const auto& [name, values] : planes(scene, view, sampling, layers, Precision::float64, 2, part)) {
            CAPTURE(name);
            bool same = true;
            for (int y = 0; y < part.rows; ++y)
                for (int x = 0; x < part.columns; ++x)
                    same = same && values[std::size_t(y) * part.columns + x] ==
                                       whole.at(name)[std::size_t(y + part.y) * view.width + x + part.x];
            CHECK(same);
        }
    }
}

}  // namespace strahl::layers
