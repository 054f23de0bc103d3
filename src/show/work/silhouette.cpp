#include "show/work/silhouette.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "num/thread_pool.h"
#include "scene/leaves.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

constexpr std::size_t most_lines = 4000;  // as many are drawn without delay

/// The scene with nothing but these bodies, which shine evenly.
Scene alone(const Scene& scene, const std::vector<int>& bodies) {
    Scene own;
    own.camera = scene.camera, own.flythrough = scene.flythrough, own.music = scene.music, own.tracks = scene.tracks;
    own.materials = {Material{.rgb = {1, 1, 1}, .reflection = 0, .diffuse = 0, .ambient = 1, .specular = 0}};
    const auto paint = [](const auto& self, Primitive& part) -> void {
        part.material = 0;
        change_parts(part, [&](Primitive& inner) { self(self, inner); });
    };
    for (const int body : bodies) paint(paint, own.primitives.emplace_back(scene.primitives[std::size_t(body)]));
    return own;
}

std::vector<SilhouetteLine> traced_lines(const Scene& scene, View view, const std::atomic<bool>& stop) {
    ThreadPool pool(1);
    Tracer tracer(scene, Precision::float32);
    view.depth = 1, view.error = 0;
    // Coarsens the picture as long as it has too many lines, as that of an uneven body such as a tree.
    for (int step = 1;; step *= 2) {
        const Lattice lattice{.x = step / 2,
                              .y = step / 2,
                              .columns = std::max(1, view.width / step),
                              .rows = std::max(1, view.height / step),
                              .step_x = step,
                              .step_y = step};
        const std::vector<double> rgb = values_of(tracer, view, lattice, pool, {.grid = 1}, &stop);
        std::vector<bool> inside(rgb.size() / 3);
        for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = rgb[3 * i] > .5;
        std::vector<SilhouetteLine> lines = lines_around(inside, lattice.columns, lattice.rows);
        if (lines.size() > most_lines && step < 64 && !stop) continue;
        for (SilhouetteLine& line : lines) line.x0 *= step, line.y0 *= step, line.x1 *= step, line.y1 *= step;
        return lines;
    }
}

}  // namespace

std::vector<SilhouetteLine> lines_around(const std::vector<bool>& inside, int width, int height) {
    std::vector<SilhouetteLine> lines;
    const auto at = [&](int x, int y) { return inside[std::size_t(y) * width + x]; };
    for (int y = 1; y < height; ++y)
        for (int x = 0, begin = -1; x <= width; ++x) {
            const bool border = x < width && at(x, y - 1) != at(x, y);
            if (border && begin < 0) begin = x;
            if (!border && begin >= 0) lines.push_back({std::exchange(begin, -1), y, x, y});
        }
    for (int x = 1; x < width; ++x)
        for (int y = 0, begin = -1; y <= height; ++y) {
            const bool border = y < height && at(x - 1, y) != at(x, y);
            if (border && begin < 0) begin = y;
            if (!border && begin >= 0) lines.push_back({x, std::exchange(begin, -1), x, y});
        }
    return lines;
}

void Silhouette::want(std::shared_ptr<const Scene> scene, std::vector<int> bodies, const View& view) {
    const View& last = wanted.view;
    if (wanted.scene == scene && wanted.bodies == bodies && last.camera == view.camera && last.width == view.width &&
        last.height == view.height && last.time == view.time && last.tracks == view.tracks)
        return;
    wanted = {std::move(scene), std::move(bodies), view};
    // The one under way is finished first, or none would be seen while the camera moves.
    worker.replace(
        [subject = wanted](const std::atomic<bool>& stop) {
            return traced_lines(alone(*subject.scene, subject.bodies), subject.view, stop);
        },
        false);
}

void Silhouette::drop() { wanted = {}, worker.drop(), found.clear(); }

bool Silhouette::take() {
    auto lines = worker.take();
    if (lines && wanted.scene) found = *std::move(lines);
    return lines.has_value();
}

}  // namespace strahl
