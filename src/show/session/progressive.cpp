// Resolution levels and passes.
#include "show/session/progressive.h"

#include <cassert>
#include <cmath>

namespace strahl {
namespace {

/// Returns how many of 0, step, 2 step, ... are below `end`.
int steps_below(int end, int step) { return (end + step - 1) / step; }

}  // namespace

Steps steps_of(int level) {
    assert(level >= 0 && level <= finest_level);
    return level_steps[static_cast<std::size_t>(level)];
}

Lattice pixels_of(int level, int width, int height) {
    const Steps steps = steps_of(level);
    return {0, 0, steps_below(width, steps.x), steps_below(height, steps.y), steps.x, steps.y};
}

double averaged_side(Steps steps) { return std::max(1., std::sqrt(double(steps.area())) / 2); }

std::span<const Pass> passes_after(int level) {
    std::span<const Pass> left = passes;
    while (!left.empty() && left.front().level <= level) left = left.subspan(1);
    return left;
}

}  // namespace strahl
