#include "trace/cells/chord.h"

#include <cmath>

namespace strahl {
namespace {

struct SidePoint {
    double x, y;
};
// Corners around the square: side k leads from corner k to corner k + 1.
constexpr SidePoint corners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

SidePoint on_side(int side, double position) {
    const SidePoint a = corners[side], b = corners[(side + 1) % 4];
    return {a.x + position * (b.x - a.x), a.y + position * (b.y - a.y)};
}

}  // namespace

std::optional<std::array<int, 2>> changing_sides(const std::array<std::uint32_t, 4>& signatures) {
    std::array<int, 2> sides{};
    int found = 0;
    for (int k = 0; k < 4; ++k) {
        if (signatures[k] == signatures[(k + 1) % 4]) continue;
        if (found == 2) return std::nullopt;
        sides[found++] = k;
    }
    // With two changes there are two signatures.
    return found == 2 ? std::optional(sides) : std::nullopt;
}

ChordParts parts_of(const std::array<int, 2>& sides, const std::array<double, 2>& positions) {
    const SidePoint p = on_side(sides[0], positions[0]), q = on_side(sides[1], positions[1]);
    std::array<SidePoint, 6> polygon{p};
    int count = 1;
    for (int k = sides[0] + 1; k <= sides[1]; ++k) polygon[count++] = corners[k];
    polygon[count++] = q;
    double twice = 0;
    for (int i = 0; i < count; ++i) {
        const SidePoint a = polygon[i], b = polygon[(i + 1) % count];
        twice += a.x * b.y - a.y * b.x;
    }
    const double x = q.x - p.x, y = q.y - p.y, length = std::hypot(x, y);
    // The polygon is on the left of the way from q back to p, as x and y are counted.
    return {.first_area = twice / 2,
            .middle_x = (p.x + q.x) / 2,
            .middle_y = (p.y + q.y) / 2,
            .normal_x = length > 0 ? -y / length : 0,
            .normal_y = length > 0 ? x / length : 0,
            .length = length};
}

}  // namespace strahl
