#include "show/second/second_picture.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

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
    const TransferTable table(order.scene->settings.assumed_gamma, order.exposure);
    const Sampling one_ray{.grid = 1};
    const bool povray = order.kind == SecondKind::povray;
    SecondPicture result;
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
