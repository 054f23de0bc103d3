// Resolution levels and passes.
#include "show/session/progressive.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace strahl {
namespace {

/// Returns how many of 0, step, 2 step, ... are below `end`.
int steps_below(int end, int step) { return (end + step - 1) / step; }

}  // namespace

Steps steps_of(int level, double aspect) {
    assert(level >= 0 && level <= finest_level);
    const int area = level_areas[static_cast<std::size_t>(level)];
    Steps best;
    double least = std::numeric_limits<double>::infinity();
    for (int y = 1; y <= 16; ++y)
        for (int x = 1; x <= 16; ++x) {
            const double off = std::abs(std::log(x / (y * aspect)));
            const bool close = x * y == area || (x * y == area - 1 && area > 8);
            if (close && off < least) least = off, best = {x, y};
        }
    return best;
}

Lattice pixels_of(Steps steps, int width, int height) {
    return {0, 0, steps_below(width, steps.x), steps_below(height, steps.y), steps.x, steps.y};
}

double averaged_side(Steps steps) { return std::max(1., std::sqrt(double(steps.area())) / 2); }

std::span<const Pass> passes_after(int level) {
    std::span<const Pass> left = passes;
    while (!left.empty() && left.front().level <= level) left = left.subspan(1);
    return left;
}

}  // namespace strahl
