// Resolution from the times of the last pictures.
#include "show/resolution.h"

#include <algorithm>

#include "show/progressive.h"

namespace strahl {
namespace {

constexpr double room = 0.75;  // share of the budget that a finer level may need
constexpr int patience = 6;    // observations before it is tried

}  // namespace

double Resolution::seconds_for(int l) const {
    std::array<double, 3> sorted = costs;
    std::ranges::sort(sorted);
    return sorted[1] * count(pixels_of(l, width, height));  // the median: one slow picture is no news
}

void Resolution::observe(double pixels, double seconds) {
    if (pixels <= 0) return;
    const double cost = seconds / pixels;
    if (observed == 0) costs.fill(cost);
    costs[observed++ % costs.size()] = cost;
    const bool spare = level < finest_level && budget > 0 && seconds_for(level + 1) < room * budget;
    calm = spare ? calm + 1 : 0;
}

int Resolution::choose(int new_width, int new_height, double new_budget, int finest) {
    width = new_width, height = new_height, budget = new_budget;
    if (observed > 0) {
        for (; level > 0 && seconds_for(level) > budget; --level) calm = 0;
        if (calm >= patience) {
            while (level < finest_level && seconds_for(level + 1) < room * budget) ++level;
            calm = 0;
        }
    }
    return std::min(level, finest);
}

}  // namespace strahl
