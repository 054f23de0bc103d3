// Lattices of which smooth parts are filled: what the window shows in motion.
#include "trace/cells/lattice_cells.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "files/read_file.h"
#include "num/thread_pool.h"
#include "tests/referee/random_scene.h"
#include "tests/unit/scenes.h"
#include "trace/tracer.h"

namespace strahl::lattice_cells {

constexpr double contrast = 3. / 255;

struct Traced {
    std::vector<std::uint32_t> colors;
    Counts rays;
};

std::uint32_t encoded(const double* rgb) {
    std::uint32_t color = 0;
    for (int c = 0; c < 3; ++c) color |= static_cast<std::uint32_t>(255 * std::clamp(rgb[c], 0., 1.) + .5) << 8 * c;
    return color;
}

View view_of(const Scene& scene, int width, int height) {
    return {.camera = scene.camera, .width = width, .height = height, .depth = 6, .error = .5 / 255};
}

/// Traces a picture, filled with patterns averaged over squares of this side, or a ray in each pixel.
Traced traced(const Scene& scene, const View& view, const Lattice& part, bool filled, int threads = 2,
              Simd simd = Simd::automatic, double side = 0) {
    ThreadPool pool(threads);
    Tracer tracer(scene, Precision::float32, simd);
    const std::size_t count = std::size_t(part.columns) * part.rows;
    Traced pixels{std::vector<std::uint32_t>(count), {}};
    if (filled) {
        pixels.rays =
            tracer.trace({view, pool, {}}, FilledLattice{part, contrast, encoded, pixels.colors.data(), side});
        return pixels;
    }
    std::vector<double> rgb(3 * count);
    pixels.rays = tracer.trace({view, pool, [&](const Tile& tile) { place(tile, part, rgb); }}, part);
    for (std::size_t i = 0; i < count; ++i) pixels.colors[i] = encoded(&rgb[3 * i]);
    return pixels;
}

/// The largest difference of each pixel, in steps of 1/255.
std::vector<double> differences(const Traced& a, const Traced& b) {
    std::vector<double> off(a.colors.size());
    for (std::size_t i = 0; i < off.size(); ++i)
        for (int shift = 0; shift < 24; shift += 8)
            off[i] =
                std::max(off[i], std::abs(double(a.colors[i] >> shift & 255) - double(b.colors[i] >> shift & 255)));
    return off;
}
/// Cuts a part out of a picture.
std::vector<std::uint32_t> colors_of(const Traced& picture, int columns, const Lattice& part) {
    std::vector<std::uint32_t> colors;
    for (int y = part.y; y < part.y + part.rows; ++y)
        for (int x = part.x; x < part.x + part.columns; ++x) colors.push_back(picture.colors[y * columns + x]);
    return colors;
}
double share_above(const std::vector<double>& values, double limit) {
    return double(std::ranges::count_if(values, [&](double v) { return v > limit; })) / double(values.size());
}

TEST_CASE("a picture that is filled where it is smooth looks like the one that is traced") {
    for (const std::string name : {"article", "flythrough", "die", "mirror_ball"}) {
        CAPTURE(name);
        const Scene scene = read_scene(name);
        const View view = view_of(scene, 640, 480);
        const Lattice all{.columns = view.width, .rows = view.height};
        const Traced plain = traced(scene, view, all, false), filled = traced(scene, view, all, true);
        const std::vector<double> off = differences(plain, filled);
        CHECK(share_above(off, 1.5) < .005);
        CHECK(share_above(off, 4) < .0004);
        CHECK(double(filled.rays.total()) < .8 * double(plain.rays.total()));
        // Pixels with a ray have the values of a plain lattice, but for the middles of filled cells.
        CHECK(share_above(off, 0) < 1 - double(filled.rays.camera) / double(all.columns * all.rows) + .04);
    }
}

TEST_CASE("patterns that are as fine as the cells are not filled") {
    const Scene scene = read_scene("demo");
    const View view = view_of(scene, 640, 360);
    const Lattice all{.columns = view.width, .rows = view.height};
    const Traced plain = traced(scene, view, all, false), filled = traced(scene, view, all, true);
    const std::vector<double> off = differences(plain, filled);
    CAPTURE(share_above(off, 1.5));
    CHECK(share_above(off, 1.5) < .005);
    CHECK(double(filled.rays.total()) < .9 * double(plain.rays.total()));
}

TEST_CASE("what is filled depends neither on threads, lanes nor crops") {
    for (const Scene& scene : {read_scene("article"), random_scene(17, {.camera_inside = true})}) {
        const View view = view_of(scene, 203, 141);
        for (const auto& [x, y] : {std::pair{1, 1}, {2, 1}, {2, 2}}) {
            const Lattice all{0, 0, (view.width + x - 1) / x, (view.height + y - 1) / y, x, y};
            const Traced picture = traced(scene, view, all, true);
            CHECK(picture.colors == traced(scene, view, all, true, 3).colors);
            CHECK(picture.colors == traced(scene, view, all, true, 1, Simd::scalar).colors);
            const Traced part = traced(scene, view, {24 * x, 16 * y, 70, 45, x, y}, true);
            CHECK(part.colors == colors_of(picture, all.columns, {24, 16, 70, 45}));
        }
    }
}

TEST_CASE("averaged patterns depend neither on threads, lanes nor crops") {
    for (const Scene& scene : {read_scene("mirror_ball"), read_scene("patterns/wood"),
                               random_scene(9, {.patterns = true}), random_scene(10, {.patterns = true})}) {
        const View view = view_of(scene, 203, 141);
        const Lattice all{.columns = view.width, .rows = view.height};
        const Traced picture = traced(scene, view, all, true, 2, Simd::automatic, 1.5);
        CHECK(picture.colors != traced(scene, view, all, true).colors);
        CHECK(picture.colors == traced(scene, view, all, true, 3, Simd::automatic, 1.5).colors);
        CHECK(picture.colors == traced(scene, view, all, true, 1, Simd::scalar, 1.5).colors);
        const Traced part = traced(scene, view, {24, 16, 70, 45}, true, 2, Simd::automatic, 1.5);
        CHECK(part.colors == colors_of(picture, all.columns, {24, 16, 70, 45}));
    }
}

TEST_CASE("nothing but corners and middles is traced of an empty scene") {
    Scene scene = read_scene("crosscheck/no_light");
    scene.primitives.clear();
    const Traced pixels = traced(scene, view_of(scene, 256, 256), {.columns = 256, .rows = 256}, true, 1);
    CHECK(pixels.rays.camera == 16 * (81 + 64));  // tiles of 64 cells with corners and a middle
}

TEST_CASE("wires thinner than the cells are not lost in motion") {
    const std::string path = STRAHL_SOURCE "/tests/bench/sampling/wires.rt";
    const Scene scene = parse_scene(read_text(path), path, {}, read_pixels);
    const View view = view_of(scene, 640, 480);
    const Lattice all{.columns = view.width, .rows = view.height};
    const std::vector<double> off = differences(traced(scene, view, all, false), traced(scene, view, all, true));
    CHECK(share_above(off, 2) == 0);
}

TEST_CASE("where everything differs, hardly more is traced than in a plain lattice") {
    const Scene scene = random_scene(17, {.camera_inside = true});
    const View view = view_of(scene, 320, 240);
    const Lattice all{.columns = view.width, .rows = view.height};
    const Traced plain = traced(scene, view, all, false, 1), filled = traced(scene, view, all, true, 1);
    // The only rays besides are those to corners of cells beyond the tiles' edges.
    CHECK(filled.rays.camera <= plain.rays.camera + 20 * (16 + 16 + 1));
}

TEST_CASE("worlds of very many bodies are traced as they are") {
    Scene scene = read_scene("article");
    const Primitive ball = scene.primitives.back();
    scene.primitives.resize(10001, ball);
    const View view = view_of(scene, 64, 48);
    const Lattice all{.columns = view.width, .rows = view.height};
    CHECK(traced(scene, view, all, true).colors == traced(scene, view, all, false).colors);
    CHECK(traced(scene, view, all, true).rays.camera == 64 * 48);
}

TEST_CASE("a picture that is stopped keeps the pixels that were not reached") {
    const Scene scene = read_scene("article");
    const View view = view_of(scene, 640, 480);
    ThreadPool pool(2);
    Tracer tracer(scene, Precision::float32);
    std::atomic<bool> stop = false;
    const Lattice all{.columns = view.width, .rows = view.height};
    std::vector<std::uint32_t> colors(640 * 480, 0x01020304);
    const auto encode = [&](const double*) { return stop = true, 0u; };
    tracer.trace({view, pool, {}, &stop}, FilledLattice{all, contrast, encode, colors.data()});
    const auto reached = std::ranges::count(colors, 0u);
    CHECK(reached >= 1);
    CHECK(reached <= 2 * 64 * 64);  // a tile of each thread
}

}  // namespace strahl::lattice_cells
