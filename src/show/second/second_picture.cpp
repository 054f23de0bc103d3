#include "show/second/second_picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "files/error.h"
#include "image/transfer.h"
#include "pov/open_scene.h"
#include "povref/compare/run_povray.h"
#include "scene/moving_scene.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

constexpr int amplified = 16;
constexpr int povray_grid = 3;  // 3 x 3 rays and one through the middle

ScreenImage encoded(std::span<const double> values, const View& view, const TransferTable& table) {
    ScreenImage image;
    image.resize(view.width, view.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = table.pixel(&values[3 * i]);
    return image;
}

/// Fills in the difference of two pictures as a screen with 16 bits would show them.
void compare(std::span<const double> a, std::span<const double> b, const SecondOrder& order, SecondPicture& result) {
    const double gamma = order.scene->settings.assumed_gamma;
    result.difference.resize(order.view.width, order.view.height);
    for (std::size_t i = 0; i < result.difference.pixels.size(); ++i) {
        std::uint32_t pixel = 0xff000000u;
        bool differs = false;
        for (unsigned c = 0; c < 3; ++c) {
            const int off = std::abs(quantise(a[3 * i + c], gamma, 65535) - quantise(b[3 * i + c], gamma, 65535));
            differs |= off > 257;
            pixel |= static_cast<std::uint32_t>(std::min(255, amplified * off / 257)) << 8 * (2 - c);
        }
        result.difference.pixels[i] = pixel;
        result.differing += differs;
    }
}

/// The scene with the tracks that the view has in place of its own.
Scene scene_of(const SecondOrder& order) {
    Scene scene = *order.scene;
    if (order.view.tracks) scene.tracks = *order.view.tracks;
    return scene;
}

std::vector<double> povray_values(const SecondOrder& order, int grid, int threads, const std::atomic<bool>& stop) {
    const View& view = order.view;
    if (is_pov(order.path)) {
        PovFile file{.path = order.path,
                     .width = view.width,
                     .height = view.height,
                     .gamma = order.scene->settings.assumed_gamma,
                     .grid = grid,
                     .mirrored = order.mirrored};
        if (view.camera != order.scene->camera) file.camera = view.camera;
        return run_povray_file(file, threads, &stop).picture.values;
    }
    return run_povray(without_tracks(scene_of(order), view.time),
                      {.title = std::filesystem::path(order.path).filename().string(),
                       .cameras = {view.camera},
                       .time = view.time,
                       .width = view.width,
                       .height = view.height,
                       .depth = view.depth,
                       .grid = grid},
                      threads, &stop)
        .picture.values;
}

std::vector<double> own_values(const SecondOrder& order, Precision precision, const Sampling& sampling,
                               ThreadPool& pool, const std::atomic<bool>& stop) {
    Tracer tracer(*order.scene, precision);
    const Lattice whole{.columns = order.view.width, .rows = order.view.height};
    std::vector<double> values = values_of(tracer, order.view, whole, pool, sampling, &stop);
    if (stop) throw Stopped{};
    return values;
}

/// Shows distances as shares: the nearest is white, twice that half as bright. Normals are colours: red to the right.
std::uint32_t layer_pixel(const SecondPicture::SeenPoint& seen, SecondKind kind, float nearest) {
    if (std::isinf(seen.distance)) return 0xff000000u;
    const auto bits = [](float share) { return static_cast<std::uint32_t>(std::lround(255 * share)); };
    const auto& n = seen.normal;
    if (kind == SecondKind::depth) return 0xff000000u | 0x10101u * bits(nearest / seen.distance);
    return 0xff000000u | bits((1 + n[0]) / 2) << 16 | bits((1 + n[1]) / 2) << 8 | bits((1 + n[2]) / 2);
}

/// Traces what the pixels show.
SecondPicture layer_picture(const SecondOrder& order, ThreadPool& pool, const std::atomic<bool>& stop) {
    View view = order.view;
    view.layers = {.depth = true, .normal = true, .position = true};
    SecondPicture result{.finished = true};
    result.seen.resize(std::size_t(view.width) * view.height);
    const auto keep = [&](const Tile& tile) {
        const float* from = tile.layers.data();
        for (int i = 0; i < tile.lattice.columns * tile.lattice.rows; ++i, from += 10) {
            const int x = tile.lattice.x + i % tile.lattice.columns, y = tile.lattice.y + i / tile.lattice.columns;
            // Behind red, green and blue.
            result.seen[std::size_t(y) * view.width + x] = {
                from[3], {from[4], from[5], from[6]}, {from[7], from[8], from[9]}};
        }
    };
    Tracer tracer(*order.scene, Precision::float64);
    tracer.trace({view, pool, keep, &stop}, Lattice{.columns = view.width, .rows = view.height});
    if (stop) throw Stopped{};
    float nearest = std::numeric_limits<float>::infinity();
    for (const auto& seen : result.seen) nearest = std::min(nearest, seen.distance);
    result.image.resize(view.width, view.height);
    std::ranges::transform(result.seen, result.image.pixels.begin(),
                           [&](const auto& seen) { return layer_pixel(seen, order.kind, nearest); });
    return result;
}

}  // namespace

bool SecondOrder::operator==(const SecondOrder& other) const {
    return kind == other.kind && path == other.path && mirrored == other.mirrored && exposure == other.exposure &&
           brief == other.brief && same_picture(view, other.view) &&
           (scene == other.scene || (scene && other.scene && *scene == *other.scene));
}

void compare(const ScreenImage& other, SecondPicture& result) {
    result.difference.resize(other.width, other.height);
    result.differing = 0;
    for (std::size_t i = 0; i < other.pixels.size(); ++i) {
        std::uint32_t pixel = 0xff000000u;
        bool differs = false;
        for (unsigned shift = 0; shift < 24; shift += 8) {
            const auto channel = [&](const ScreenImage& image) { return int(image.pixels[i] >> shift & 255); };
            const int off = std::abs(channel(other) - channel(result.image));
            differs |= off > 1;
            pixel |= static_cast<std::uint32_t>(std::min(255, amplified * off)) << shift;
        }
        result.difference.pixels[i] = pixel;
        result.differing += differs;
    }
}

void make_second(const SecondOrder& order, ThreadPool& pool, const std::atomic<bool>& stop,
                 const std::function<void(SecondPicture)>& publish) {
    if (order.kind >= SecondKind::depth) return publish(layer_picture(order, pool, stop));
    const TransferTable table(order.scene->settings.assumed_gamma, order.exposure);
    const Sampling one_ray{.grid = 1};
    const bool povray = order.kind == SecondKind::povray;
    SecondPicture result;
    if (povray && order.view.camera.stereo != Stereo::none) throw FileError("POV-Ray has no pictures for two eyes");
    if (order.kind == SecondKind::flight) {
        const Sampling sampling = order.brief ? one_ray : Sampling{};
        result.image = encoded(own_values(order, Precision::float32, sampling, pool, stop), order.view, table);
        result.finished = true;
        return publish(std::move(result));
    }
    const std::vector<double> second = povray ? povray_values(order, 0, pool.size(), stop)
                                       : order.kind == SecondKind::one_ray
                                           ? own_values(order, Precision::float32, one_ray, pool, stop)
                                           : own_values(order, Precision::extended, {}, pool, stop);
    result.image = encoded(second, order.view, table);
    compare(
        second,
        own_values(order, povray ? Precision::float64 : Precision::float32, povray ? one_ray : Sampling{}, pool, stop),
        order, result);
    result.finished = !povray;
    publish(result);
    if (!povray) return;
    result.image = encoded(povray_values(order, povray_grid, pool.size(), stop), order.view, table);
    result.finished = true;
    publish(std::move(result));
}

}  // namespace strahl
