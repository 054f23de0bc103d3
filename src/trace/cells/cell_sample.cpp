#include "trace/cells/cell_sample.h"

#include <algorithm>
#include <cmath>

namespace strahl {

double glint_range(const std::array<const CellSample*, 4>& corners) {
    float least = corners[0]->glint, most = least;
    for (const CellSample* corner : corners)
        least = std::min(least, corner->glint), most = std::max(most, corner->glint);
    return most - least;
}

double middle_off(const std::array<const CellSample*, 4>& corners, const CellSample& middle, int channels) {
    double off = 0;
    for (int c = 0; c < channels; ++c) {
        double sum = 0;
        for (const CellSample* corner : corners) sum += corner->rgb[c];
        off = std::max(off, std::abs(sum / 4 - middle.rgb[c]));
    }
    return off;
}

double deviation_of(const std::array<const CellSample*, 4>& corners, const CellSample& middle) {
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        double sum = middle.rgb[c], squares = middle.rgb[c] * middle.rgb[c];
        for (const CellSample* corner : corners) sum += corner->rgb[c], squares += corner->rgb[c] * corner->rgb[c];
        most = std::max(most, squares - sum * sum / 5);
    }
    return std::sqrt(most / 4);
}

std::array<std::array<double, 4>, 5> without_pattern(std::span<const CellSample* const> samples) {
    std::array<std::array<double, 4>, 5> result{};
    for (std::size_t i = 0; i < samples.size(); ++i) result[i][3] = samples[i]->rgb[3];
    for (int c = 0; c < 3; ++c) {
        const double per = 1 / static_cast<double>(samples.size());
        double color = 0, light = 0, variance = 0, covariance = 0;
        for (const CellSample* sample : samples) color += per * double(sample->color[c]), light += per * sample->rgb[c];
        for (const CellSample* sample : samples) {
            const double off = double(sample->color[c]) - color;
            variance += off * off, covariance += off * (sample->rgb[c] - light);
        }
        const double slope = variance > 0 ? covariance / variance : 0;
        const double own = samples.size() > 4 ? double(samples[4]->color[c]) : color;
        for (std::size_t i = 0; i < samples.size(); ++i)
            result[i][c] = samples[i]->rgb[c] - slope * (double(samples[i]->color[c]) - own);
    }
    return result;
}

bool looks_smooth(const std::array<const CellSample*, 4>& corners, const CellSample& middle, double contrast,
                  int channels) {
    for (const CellSample* corner : corners)
        if (corner->signature != middle.signature) return false;
    return glint_range(corners) <= most_glint && middle_off(corners, middle, channels) <= contrast / 2;
}

}  // namespace strahl
