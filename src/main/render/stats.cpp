// Writes statistics as JSON. No string needs escaping: all are constants of the program.
#include "main/render/stats.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/streams.h"

namespace strahl {

namespace {

std::string number(double value) {
    TextStream text;
    text.precision(9);
    if (std::isfinite(value))
        text << value;
    else
        text << "null";
    return text.str();
}

/// Returns the figures of the averages over pixels. Their error is a target and an estimate; that of pruning is
/// bounded.
std::string samples(const Stats& stats) {
    const auto& [grid, centre, error] = stats.sampling;
    if (grid > 0) return "{ \"in_each_pixel\": " + std::to_string(grid * grid + centre) + " }";
    const double aimed = std::max(error, least_sampling_error), estimated = stats.sampled.error();
    return "{ \"aimed\": " + number(aimed) + ", \"estimated\": " + number(estimated) +
           ", \"reached\": " + (estimated <= aimed ? "true" : "false") +
           ", \"checked\": " + std::to_string(stats.sampled.measured.checked) +
           ", \"median\": " + std::to_string(stats.sampled.median()) +
           ", \"most\": " + std::to_string(stats.sampled.most()) + " }";
}

}  // namespace

std::string to_json(const Stats& stats) {
    const Accuracy& accuracy = stats.accuracy;
    TextStream json;
    json.precision(9);
    json << "{\n";
    json << "  \"finished\": " << (stats.finished ? "true" : "false") << ",\n";
    json << "  \"width\": " << stats.size.width << ",\n  \"height\": " << stats.size.height << ",\n";
    if (const auto& crop = stats.crop)
        json << "  \"crop\": [" << crop->x << ", " << crop->y << ", " << crop->columns << ", " << crop->rows << "],\n";
    json << "  \"frames\": " << stats.frames << ",\n  \"depth\": " << accuracy.depth
         << ",\n  \"deepest\": " << stats.rays.depth << ",\n";
    json << "  \"precision\": \"" << name(accuracy.precision) << "\",\n  \"simd\": \"" << name(stats.simd) << "\",\n";
    const double rounding = accuracy.rounding.value_or(std::numeric_limits<double>::quiet_NaN());
    json << "  \"error\": { \"allowed\": " << number(stats.error) << ", \"dropped\": " << number(stats.rays.dropped)
         << ", \"past_depth\": " << number(stats.rays.past) << ", \"rounding\": " << number(rounding)
         << ", \"omitted\": " << number(stats.rays.lost()) << " },\n";
    json << "  \"samples\": " << samples(stats) << ",\n";
    if (const auto& proved = stats.proved)
        json << "  \"proof\": { \"bits\": " << proved->bits << ", \"proved\": " << proved->proved
             << ", \"in_extended\": " << proved->in_extended << ", \"undecided\": " << proved->undecided
             << ", \"bound_median\": " << number(proved->median) << " },\n";
    json << "  \"lanes\": " << stats.lanes << ",\n  \"threads\": " << stats.threads << ",\n";
    json << "  \"parse_seconds\": " << stats.parse_seconds << ",\n  \"build_seconds\": " << stats.build_seconds
         << ",\n";
    json << "  \"trace_seconds\": " << stats.trace_seconds << ",\n  \"write_seconds\": " << stats.write_seconds
         << ",\n";
    json << "  \"rays\": { \"camera\": " << stats.rays.camera << ", \"reflected\": " << stats.rays.reflected
         << ", \"refracted\": " << stats.rays.refracted << ", \"shadow\": " << stats.rays.shadow
         << ", \"total\": " << stats.rays.total() << " }\n}\n";
    return json.str();
}

}  // namespace strahl
