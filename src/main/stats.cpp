// Statistics as JSON. No value needs escaping: all are numbers or words of our own.
#include "main/stats.h"

#include <sstream>

namespace strahl {

std::string to_json(const Stats& stats) {
    std::ostringstream json;
    json.precision(9);
    json << "{\n";
    json << "  \"finished\": " << (stats.finished ? "true" : "false") << ",\n";
    json << "  \"width\": " << stats.size.width << ",\n  \"height\": " << stats.size.height << ",\n";
    if (const auto& crop = stats.crop)
        json << "  \"crop\": [" << crop->x << ", " << crop->y << ", " << crop->columns << ", " << crop->rows << "],\n";
    json << "  \"frames\": " << stats.frames << ",\n  \"depth\": " << stats.depth << ",\n";
    json << "  \"precision\": \"" << name(stats.precision) << "\",\n  \"simd\": \"" << name(stats.simd) << "\",\n";
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
