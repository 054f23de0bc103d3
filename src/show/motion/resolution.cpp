// Chooses the resolution by the times of the last pictures.
#include "show/motion/resolution.h"

#include <algorithm>

#include "show/session/progressive.h"

namespace strahl {
namespace {

constexpr double headroom = 0.85;  // share of the budget that a finer level may need if its time grows as its pixels
                                   // do: with filled cells (trace/cells/lattice_cells.h) it grows less
constexpr int patience = 4;        // observations before it is tried

}  // namespace

void RecentCosts::add(double cost) {
    if (count == 0) costs.fill(cost);
    costs[count++ % costs.size()] = cost;
}

double RecentCosts::median() const {
    std::array<double, 5> sorted = costs;
    std::ranges::sort(sorted);
    return sorted[sorted.size() / 2];
}

double allowed_seconds(int level, double budget) { return level <= sixteenth_level ? 4 * budget : budget; }

double Resolution::seconds_for(int l) const { return costs.median() * count(pixels_of(l, width, height)); }

void Resolution::observe(double pixels, double seconds) {
    if (pixels <= 0) return;
    costs.add(seconds / pixels);
    ++since;
}

int Resolution::choose(int new_width, int new_height, double budget, int finest, double share) {
    width = new_width, height = new_height;
    if (!costs.any()) return std::min(level, finest);
    const auto allowed = [&](int l) { return allowed_seconds(l, budget) * (l > ninth_level ? share : 1); };
    for (; level > 0 && seconds_for(level) > allowed(level); --level) since = 0;
    if (since >= patience && level < finest_level && seconds_for(level + 1) < headroom * allowed(level + 1))
        ++level, since = 0;
    return std::min(level, finest);
}

}  // namespace strahl
