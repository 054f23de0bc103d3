// Resolution levels and passes.
#include "show/progressive.h"

#include <algorithm>
#include <cassert>

namespace strahl {
namespace {

/// How many of first, first + step, ... are below `end`.
int steps_below(int end, int first, int step) { return std::max(0, (end - first + step - 1) / step); }

Lattice lattice(int x, int y, Steps steps, int width, int height) {
    return {x, y, steps_below(width, x, steps.x), steps_below(height, y, steps.y), steps.x, steps.y};
}

}  // namespace

Steps steps_of(int level) {
    assert(level >= 0 && level <= finest_level);
    return {16 >> ((level + 1) / 2), 16 >> (level / 2)};
}

Lattice pixels_of(int level, int width, int height) { return lattice(0, 0, steps_of(level), width, height); }

Lattice new_pixels_of(int level, int width, int height) {
    assert(level > 0);
    const Steps now = steps_of(level), before = steps_of(level - 1);
    const bool columns = now.x != before.x;  // else rows
    return lattice(columns ? now.x : 0, columns ? 0 : now.y, columns ? Steps{before.x, now.y} : Steps{now.x, before.y},
                   width, height);
}

}  // namespace strahl
