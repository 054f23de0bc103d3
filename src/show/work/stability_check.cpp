// Renders in three precisions, and again with bounds, and lists the pixels that differ or are not proved.
#include "show/work/stability_check.h"

#include <algorithm>
#include <utility>

#include "image/transfer.h"
#include "trace/measure/precision_agreement.h"
#include "trace/measure/prove_again.h"

namespace strahl {
namespace {

/// Finds the pixels whose bounds leave more than one colour open, both in double and in extended precision.
class Undecided {
  public:
    Undecided(const Scene& scene, int threads)
        : tracer(scene, Precision::float64),
          extended(scene, Precision::extended),
          pool(threads),
          gamma(scene.settings.assumed_gamma) {}

    void add_rows(View view, const Lattice& rows, Stability& found, const std::atomic<bool>* stop) {
        view.prove = true;
        std::vector<char> proved(std::size_t(rows.columns) * rows.rows);
        const auto keep = [&](const Tile& tile) {
            const Lattice& part = tile.lattice;
            const double* const rgb = std::get<std::span<const double>>(tile.rgb).data();
            bool all = true;
            for (int i = 0; i < part.columns * part.rows; ++i) {
                const int x = part.x + i % part.columns, y = part.y - rows.y + i / part.columns;
                all &= proved[std::size_t(y) * rows.columns + x] = decided(rgb + 3 * i, tile.bounds[i], 8, gamma);
            }
            return all;
        };
        tracer.trace({view, pool, keep, stop}, rows);
        std::vector<Pixel> open;
        for (int i = 0; i < std::ssize(proved); ++i)
            if (!proved[i]) open.push_back({i % rows.columns, rows.y + i / rows.columns});
        if (!open.empty()) prove_again(extended, {view, pool, {}, stop}, open, keep);
        for (int i = 0; i < std::ssize(proved);) {
            const int x = i % rows.columns, y = rows.y + i / rows.columns;
            const auto first = proved.begin() + i, end = first + (rows.columns - x);
            const int columns = static_cast<int>(std::find(first, end, !*first) - first);
            if (!*first) found.undecided.push_back({x, y, columns});
            i += columns;
        }
        *found.proved += double(std::count(proved.begin(), proved.end(), 1)) / (double(view.width) * view.height);
    }

  private:
    Tracer tracer, extended;
    ThreadPool pool;
    const double gamma;
};

}  // namespace

void StabilityCheck::start(std::shared_ptr<const Scene> scene, const View& view) {
    cancel();
    started = true;
    share = 0;
    worker.add([this, scene = std::move(scene), view](const std::atomic<bool>& stop) {
        Stability found;
        Agreements agreements(*scene, threads,
                              [gamma = scene->settings.assumed_gamma](double v) { return quantise(v, gamma, 255); });
        std::optional<Undecided> undecided;
        if (proves()) undecided.emplace(*scene, threads), found.proved = 0;
        constexpr int band = 64;  // rows at a time
        for (int y = 0; y < view.height && !stop; y += band) {
            const Lattice rows{.y = y, .columns = view.width, .rows = std::min(band, view.height - y)};
            const auto map = agreements.of(view, rows, nullptr, &stop);
            for (std::size_t i = 0; i < map.size(); ++i)
                if (map[i] != Agreement::all)
                    found.marks.push_back(
                        {int(i) % view.width, y + int(i) / view.width, map[i] == Agreement::not_float64});
            if (undecided) undecided->add_rows(view, rows, found, &stop);
            share = double(y + rows.rows) / view.height;
            worker.notify();
        }
        return found;
    });
}

void StabilityCheck::cancel() {
    worker.cancel();
    while (worker.take()) continue;
    started = false;
    result = {};
}

bool StabilityCheck::take() {
    auto found = worker.take();
    if (found) result = *std::move(found);
    return found.has_value();
}

}  // namespace strahl
