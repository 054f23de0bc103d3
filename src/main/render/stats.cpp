// Writes statistics as JSON.
#include "main/render/stats.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace strahl {
namespace {

using Json = nlohmann::ordered_json;  // which has null for what is not finite

/// Returns the figures of the averages over pixels. Their error is a target and an estimate; that of pruning is
/// bounded.
Json samples(const Stats& stats) {
    const auto& [grid, centre, error] = stats.sampling;
    if (grid > 0) return {{"in_each_pixel", grid * grid + centre}};
    const double aimed = std::max(error, least_sampling_error), estimated = stats.sampled.error();
    return {{"aimed", aimed},
            {"estimated", estimated},
            {"reached", estimated <= aimed},
            {"checked", stats.sampled.measured.checked},
            {"median", stats.sampled.median()},
            {"most", stats.sampled.most()}};
}

}  // namespace

std::string to_json(const Stats& stats) {
    const Accuracy& accuracy = stats.accuracy;
    Json json{{"finished", stats.finished}, {"width", stats.size.width}, {"height", stats.size.height}};
    if (const auto& crop = stats.crop) json["crop"] = {crop->x, crop->y, crop->columns, crop->rows};
    json["frames"] = stats.frames, json["depth"] = accuracy.depth, json["deepest"] = stats.rays.depth;
    json["precision"] = name(accuracy.precision), json["simd"] = name(stats.simd);
    json["error"] = {{"allowed", stats.error},
                     {"dropped", stats.rays.dropped},
                     {"past_depth", stats.rays.past},
                     {"rounding", accuracy.rounding.value_or(std::numeric_limits<double>::quiet_NaN())},
                     {"omitted", stats.rays.lost()}};
    json["samples"] = samples(stats);
    if (const auto& proved = stats.proved)
        json["proof"] = {{"bits", proved->bits},
                         {"proved", proved->proved},
                         {"in_extended", proved->in_extended},
                         {"undecided", proved->undecided},
                         {"bound_median", proved->median}};
    json["lanes"] = stats.lanes, json["threads"] = stats.threads;
    json["parse_seconds"] = stats.parse_seconds, json["build_seconds"] = stats.build_seconds;
    json["trace_seconds"] = stats.trace_seconds, json["write_seconds"] = stats.write_seconds;
    json["rays"] = {{"camera", stats.rays.camera},
                    {"reflected", stats.rays.reflected},
                    {"refracted", stats.rays.refracted},
                    {"shadow", stats.rays.shadow},
                    {"total", stats.rays.total()}};
    return json.dump(2) + "\n";
}

}  // namespace strahl
