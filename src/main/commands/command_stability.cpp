// strahl stability: renders in float, double and long double, and shows where they disagree.
#include "main/commands/command_stability.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "files/output_file.h"
#include "image/picture.h"
#include "image/transfer.h"
#include "main/commands/scene_file.h"
#include "main/process/exit_status.h"
#include "trace/measure/precision_agreement.h"

namespace strahl {
namespace {

constexpr int float_differs = 1, double_differs = 2;  // values of Agreement

// The colours of the map by Agreement: none, since grey is used; orange; red.
constexpr std::array<std::array<double, 3>, 3> colors{{{}, {1, .6, 0}, {1, 0, .1}}};

void write_map(const std::string& path, const View& view, const std::vector<double>& shown,
               const std::vector<Agreement>& parts, double gamma) {
    Picture map{view.width, view.height, 3, std::vector<double>(shown.size())};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        double grey = 0;
        for (int c = 0; c < 3; ++c) grey += quantise(shown[3 * i + c], gamma, 255) / (3. * 255);
        for (std::size_t c = 0; c < 3; ++c)
            map.values[3 * i + c] =
                parts[i] == Agreement::all ? .25 + .5 * grey : colors[static_cast<std::size_t>(parts[i])][c];
    }
    write_picture(map, path, {});
}

/// Counts pixels that disagree, by the smallest depth at which they do.
std::vector<std::array<std::size_t, 3>> by_depth(Agreements& agreements, View view,
                                                 const std::vector<Agreement>& parts) {
    std::vector<std::array<std::size_t, 3>> counts(view.depth + 1);
    const int deepest = view.depth;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i] == Agreement::all) continue;
        const Lattice pixel{int(i % view.width), int(i / view.width), 1, 1};
        for (view.depth = 1; view.depth < deepest; ++view.depth)
            if (agreements.of(view, pixel)[0] != Agreement::all) break;
        ++counts[view.depth][static_cast<std::size_t>(parts[i])];
    }
    return counts;
}

}  // namespace

int stability_command(const StabilityOptions& options) {
    if (!options.output.empty())
        if (const std::string fault = format_fault(options.output, 0); !fault.empty()) throw UsageError(fault);
    refuse_overwriting("-o", options.output, "the scene", options.scene);
    const auto& [width, height] = options.opening.size;
    const Scene scene = load_scene(options.scene, options.opening);
    const View view{.camera = scene.camera,
                    .width = width,
                    .height = height,
                    .depth = options.depth.value_or(scene.settings.max_trace_level)};
    Agreements agreements(scene, options.threads,
                          [gamma = scene.settings.assumed_gamma](double v) { return quantise(v, gamma, 255); });
    std::vector<double> shown;
    const std::vector<Agreement> map = agreements.of(view, {.columns = view.width, .rows = view.height}, &shown);
    if (!options.output.empty()) write_map(options.output, view, shown, map, scene.settings.assumed_gamma);

    const auto counts = by_depth(agreements, view, map);
    std::array<std::size_t, 3> sums{};
    const auto row = [&](const std::string& depth, const std::array<std::size_t, 3>& count) {
        const double percent = 100. / static_cast<double>(map.size());
        std::printf("| %5s | %9zu | %8.4f %% | %10zu | %8.4f %% |\n", depth.c_str(), count[float_differs],
                    percent * static_cast<double>(count[float_differs]), count[double_differs],
                    percent * static_cast<double>(count[double_differs]));
    };
    std::printf(
        "Pixels (of %zu) whose 8-bit colour differs from long double (exact halves not counted), by the first "
        "generation "
        "of rays with which it does.\n\n"
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
