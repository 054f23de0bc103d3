#include "trace/cell_sample.h"

#include <algorithm>
#include <cmath>

namespace strahl {

double glint_range(const std::array<const CellSample*, 4>& corners) {
    float least = corners[0]->glint, most = least;
    for (const CellSample* corner : corners)
        least = std::min(least, corner->glint), most = std::max(most, corner->glint);
    return most - least;
}

double middle_off(const std::array<const CellSample*, 4>& corners, const CellSample& middle) {
    double off = 0;
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (const CellSample* corner : corners) sum += corner->rgb[c];
        off = std::max(off, std::abs(sum / 4 - middle.rgb[c]));
    }
    return off;
}

bool looks_smooth(const std::array<const CellSample*, 4>& corners, const CellSample& middle, double contrast) {
    for (const CellSample* corner : corners)
        if (corner->signature != middle.signature) return false;
    return glint_range(corners) <= most_glint && middle_off(corners, middle) <= contrast / 2;
}

}  // namespace strahl
