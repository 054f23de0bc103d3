// strahl stability: the picture in float, double and long double, and where they part.
#include "main/command_stability.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "image/picture.h"
#include "image/transfer.h"
#include "main/errors.h"
#include "text/parse.h"
#include "trace/thread_pool.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

enum Part { agree, float_differs, double_differs };
// Grey as it is, orange, and red.
constexpr std::array<std::array<double, 3>, 3> colors{{{}, {1, .6, 0}, {1, 0, .1}}};

/// The scene in all precisions.
class Trio {
  public:
    Trio(const Scene& scene, int threads)
        : linear(scene.settings.linear),
          tracers{Tracer(scene, Precision::single), Tracer(scene, Precision::twice),
                  Tracer(scene, Precision::extended)},
          pool(threads),
          alone(1) {}

    /// For every pixel of the lattice, row by row, if it has the same 8-bit colour in all. `shown` is the picture in
    /// double.
    std::vector<Part> compare(const View& view, const Lattice& lattice, std::vector<double>& shown) {
        ThreadPool& threads = lattice.columns * lattice.rows > 1 ? pool : alone;
        std::vector<double> rgb[3];
        for (int i = 0; i < 3; ++i) rgb[i] = trace(tracers[i], view, lattice, threads);
        std::vector<Part> map;
        for (std::size_t i = 0; i < rgb[0].size(); i += 3)
            map.push_back(!same(&rgb[1][i], &rgb[2][i])   ? double_differs
                          : !same(&rgb[0][i], &rgb[2][i]) ? float_differs
                                                          : agree);
        shown = std::move(rgb[1]);
        return map;
    }

  private:
    bool same(const double* a, const double* b) const {
        for (int c = 0; c < 3; ++c)
            if (quantise(a[c], linear, 255) != quantise(b[c], linear, 255)) return false;
        return true;
    }
    static std::vector<double> trace(Tracer& tracer, const View& view, const Lattice& lattice, ThreadPool& threads) {
        std::vector<double> values(std::size_t(3) * lattice.columns * lattice.rows);
        tracer.trace(view, lattice, threads, [&](const Tile& tile) {
            std::visit(
                [&](const auto& rgb) {
                    const Lattice& part = tile.lattice;
                    for (int row = 0; row < part.rows; ++row)
                        std::copy_n(rgb.begin() + std::ptrdiff_t(3) * row * part.columns, 3 * part.columns,
                                    values.begin() + std::ptrdiff_t(3) *
                                                         (std::ptrdiff_t(part.y - lattice.y + row) * lattice.columns +
                                                          part.x - lattice.x));
                },
                tile.rgb);
        });
        return values;
    }

    bool linear;
    std::array<Tracer, 3> tracers;
    ThreadPool pool, alone;
};

void write_map(const std::string& path, const View& view, const std::vector<double>& shown,
               const std::vector<Part>& parts, bool linear) {
    Picture map{view.width, view.height, 3, std::vector<double>(shown.size())};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        double grey = 0;
        for (int c = 0; c < 3; ++c) grey += quantise(shown[3 * i + c], linear, 255) / (3. * 255);
        for (std::size_t c = 0; c < 3; ++c)
            map.values[3 * i + c] = parts[i] == agree ? .25 + .5 * grey : colors[parts[i]][c];
    }
    write_picture(map, path, {});
}

/// Pixels that part, by the depth of the rays at which they do so first.
std::vector<std::array<std::size_t, 3>> by_depth(Trio& trio, View view, const std::vector<Part>& parts) {
    std::vector<std::array<std::size_t, 3>> counts(view.depth + 1);
    const int deepest = view.depth;
    std::vector<double> unused;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] == agree) continue;
        const Lattice pixel{int(i % view.width), int(i / view.width), 1, 1};
        for (view.depth = 1; view.depth < deepest; ++view.depth)
            if (trio.compare(view, pixel, unused)[0] != agree) break;
        ++counts[view.depth][parts[i]];
    }
    return counts;
}

}  // namespace

int stability_command(const StabilityOptions& options) {
    if (!options.output.empty())
        if (const std::string fault = format_fault(options.output, 0); !fault.empty()) throw UsageError(fault);
    const Scene scene = parse_scene(read_text(options.scene), options.scene == "-" ? "standard input" : options.scene);
    const View view{.camera = scene.camera,
                    .width = options.size.width,
                    .height = options.size.height,
                    .depth = options.depth.value_or(scene.settings.max_trace_level)};
    Trio trio(scene, options.threads);
    std::vector<double> shown;
    const std::vector<Part> map = trio.compare(view, {.columns = view.width, .rows = view.height}, shown);
    if (!options.output.empty()) write_map(options.output, view, shown, map, scene.settings.linear);

    const auto counts = by_depth(trio, view, map);
    std::array<std::size_t, 3> sums{};
    const auto row = [&](const std::string& depth, const std::array<std::size_t, 3>& count) {
        const double percent = 100. / static_cast<double>(map.size());
        std::printf("| %5s | %9zu | %8.4f %% | %10zu | %8.4f %% |\n", depth.c_str(), count[float_differs],
                    percent * static_cast<double>(count[float_differs]), count[double_differs],
                    percent * static_cast<double>(count[double_differs]));
    };
    std::printf(
        "Pixels, of %zu, whose 8-bit colour is not that of long double, by the depth of rays at which that is so "
        "first.\n\n"
        "| depth | float only |            | double too |            |\n"
        "|------:|----------:|-----------:|-----------:|-----------:|\n",
        map.size());
    for (std::size_t depth = 1; depth < counts.size(); ++depth) {
        for (int i = 0; i < 3; ++i) sums[i] += counts[depth][i];
        if (counts[depth][float_differs] + counts[depth][double_differs] > 0) row(std::to_string(depth), counts[depth]);
    }
    row("all", sums);
    return exit_status::done;
}

}  // namespace strahl
