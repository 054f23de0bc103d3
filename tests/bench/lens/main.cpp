// The error of pictures through a lens or a shutter against the rays that they take, beside regular grids of rays.
//
//   bench_lens SCENE.rt...
//   bench_lens --shutter SCENE.rt...
//
// Gives each scene's camera a lens of 1.5 % of its distance from look_at, which is sharp at four fifths of it, and
// writes a line for each: the aimed and the estimated error, the true one, rays in a pixel, and how many of them a
// regular grid needs for the same error. What counts as true are 784 pinholes all over the lens with 25 rays in a
// pixel each. Errors are RMS, in 510ths.
//
// With --shutter each scene is seen at a third of its flight through a shutter that is open for 1/12 of a second. Where
// nothing moves the camera goes past, by 3 degrees in that time. What counts as true are 1,000 moments with 4 rays in a
// pixel each; a regular grid of n^3 rays has n moments.
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <numbers>
#include <string_view>
#include <vector>

#include "files/read_file.h"
#include "image/pixels.h"
#include "num/thread_pool.h"
#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "text/parse.h"
#include "trace/cells/cell_picture.h"
#include "trace/shutter.h"
#include "trace/tracer.h"

namespace {

using namespace strahl;

/// Averages pinholes at n x n places of the lens, of equal areas, each with m x m rays in a pixel. With `spread` the
/// rays of each are at other places of the pixel (the sequence R2 of M. Roberts, 2018).
std::vector<double> by_pinholes(Tracer& tracer, const View& view, ThreadPool& pool, int n, int m, bool spread) {
    const CameraFrame frame = frame_of(view.camera, double(view.width) / view.height);
    const double sharp = focal_distance(view.camera);
    std::vector<double> sum(std::size_t(3) * view.width * view.height);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto [x, y] = lens_place(view.camera, (i + .5) / n, (j + .5) / n);
            View own = view;
            own.camera.aperture = 0;
            own.camera.position =
                view.camera.position + view.camera.aperture * x * frame.right + view.camera.aperture * y * frame.down;
            own.camera.look_at = own.camera.position + frame.forward;
            own.shift_x = -view.camera.aperture * x / sharp / frame.tan_x * view.width / 2;
            own.shift_y = -view.camera.aperture * y / sharp / frame.tan_y * view.height / 2;
            const auto part = [&](double step) { return spread ? (std::fmod((j * n + i) * step, 1) - .5) / m : 0; };
            own.shift_x += part(.7548776662466927), own.shift_y += part(.5698402909980532);
            const Lattice whole{.columns = view.width, .rows = view.height};
            const std::vector<double> one = values_of(tracer, own, whole, pool, {.grid = m});
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += one[k] / (n * n);
        }
    return sum;
}

double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return 510 * std::sqrt(sum / static_cast<double>(a.size()));
}

/// Averages pictures of n moments of the shutter, each with m x m rays in a pixel; with `spread` as above.
std::vector<double> by_moments(Tracer& tracer, const View& view, ThreadPool& pool, int n, int m, bool spread) {
    std::vector<double> sum(std::size_t(3) * view.width * view.height);
    for (int i = 0; i < n; ++i) {
        View own = view;
        own.moments = nullptr;
        own.time += view.camera.shutter * ((i + .5) / n - .5);
        own.camera = camera_at(tracer.declared(), own.time);
        const auto part = [&](double step) { return spread ? (std::fmod(i * step, 1) - .5) / m : 0; };
        own.shift_x = part(.7548776662466927), own.shift_y = part(.5698402909980532);
        const Lattice whole{.columns = view.width, .rows = view.height};
        const std::vector<double> one = values_of(tracer, own, whole, pool, {.grid = m});
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += one[k] / n;
    }
    return sum;
}

/// Writes the line of a scene. grid(n) traces a regular grid of n^dimensions rays in a pixel.
void write_line(const char* name, Tracer& tracer, const View& view, ThreadPool& pool, const std::vector<double>& exact,
                int dimensions, const std::function<std::vector<double>(int n)>& grid) {
    const Lattice whole{.columns = view.width, .rows = view.height};
    tracer.prepare(view, pool);
    CellPicture picture(tracer.scene(), view, whole, Sampling{}.error);
    picture.check(1000);
    std::vector<double> values(exact.size());
    const Counts counts =
        tracer.trace({view, pool, [&](const Tile& tile) { place(tile, whole, values); }}, CellPass{picture, 0});
    const double own = rms(values, exact), pixels = double(view.width) * view.height;
    // Between two grids the error is a power of the number of rays.
    double rays = 0, error = 0, needed = 0;
    for (int n = 2; std::pow(n, dimensions) <= 4096 && !(rays > 0 && error <= own); ++n) {
        const double next = std::pow(n, dimensions), off = rms(grid(n), exact);
        needed = rays > 0 ? rays * std::pow(next / rays, std::log(error / own) / std::log(error / off)) : next;
        rays = next, error = off;
    }
    std::printf("| %s | %.2f | %.2f | %.0f | %s%.0f | %.1f |\n", name, 510 * picture.sampled().error(), own,
                static_cast<double>(counts.camera) / pixels, error > own ? "> " : "", needed,
                needed * pixels / static_cast<double>(counts.camera));
    std::fflush(stdout);
}

void measure(const char* name, bool shutter) {
    Scene scene = parse_scene(read_text(name), name, {}, read_pixels);
    View view{.camera = scene.camera, .width = 32, .height = 24, .depth = 8};
    ThreadPool pool;
    if (shutter) {
        scene.camera.shutter = 1. / 12;
        if (!flight_of(scene)) {
            const DVec3 eye = scene.camera.position, at = scene.camera.look_at;
            const DVec3 by = .3 * length(at - eye) * frame_of(scene.camera, 4. / 3).right;
            scene.flythrough = {
                .duration = 1, .loop = false, .keys = {{0, eye - by, at, {}, {}}, {1, eye + by, at, {}, {}}}};
        }
        view.time = flight_for("--shutter", scene, name).duration / 3;
        view.camera = camera_at(scene, view.time);
        view.moments = shutter_moments(scene, view.time, scene.camera.shutter,
                                       [&](double time) { return camera_at(scene, time); });
    } else {
        const double distance = length(view.camera.look_at - view.camera.position);
        view.camera.aperture = .015 * distance, view.camera.focus = .8 * distance;
    }
    Tracer tracer(std::move(scene), Precision::float32);
    if (shutter)
        write_line(name, tracer, view, pool, by_moments(tracer, view, pool, 1000, 2, true), 3,
                   [&](int n) { return by_moments(tracer, view, pool, n, n, false); });
    else
        write_line(name, tracer, view, pool, by_pinholes(tracer, view, pool, 28, 5, true), 4,
                   [&](int n) { return by_pinholes(tracer, view, pool, n, n, false); });
}

}  // namespace

int main(int count, char** arguments) {
    const bool shutter = count > 1 && std::string_view(arguments[1]) == "--shutter";
    std::puts("| scene | estimated | true | rays | of a grid | ratio |\n|---|---|---|---|---|---|");
    for (int i = shutter ? 2 : 1; i < count; ++i) try {
            measure(arguments[i], shutter);
        } catch (const std::exception& error) {
            std::fprintf(stderr, "%s: %s\n", arguments[i], error.what());
            return 1;
        }
}
