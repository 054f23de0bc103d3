// The parts into which adaptive sampling divides the grid of an area light, as in POV-Ray; and, where the points of the
// grid jitter, the mean of what it finds.
#pragma once
#include <array>
#include <vector>

#include "num/lane_math.h"

namespace strahl::inline STRAHL_LEVEL {

/// Columns u1 to u2 and rows v1 to v2 of a grid, whose points are counted column by column.
struct GridPart {
    int u1, v1, u2, v2;

    bool divisible() const { return u2 - u1 > 1 || v2 - v1 > 1; }
    /// Returns the numbers of its corners, around it.
    std::array<int, 4> corners(int rows) const {
        const auto at = [rows](int column, int row) { return column * rows + row; };
        return {at(u1, v1), at(u2, v1), at(u2, v2), at(u1, v2)};
    }
    /// The corner of a part that each of its quarters has, which is that quarter's corner of the same number.
    static constexpr std::array<int, 4> corner_of_quarter{0, 3, 1, 2};
    std::array<GridPart, 4> quarters() const {
        const int u = u1 + u2, v = v1 + v2;
        return {{{u1, v1, u / 2, v / 2},
                 {u1, (v + 1) / 2, u / 2, v2},
                 {(u + 1) / 2, v1, u2, v / 2},
                 {(u + 1) / 2, (v + 1) / 2, u2, v2}}};
    }
};

/// Does the light of two corners beside each other differ by more than .1, the differences of channels added up? Their
/// shares of it are given, and its color.
template <class T>
bool differs(const std::array<Vec3<T>, 4>& shares, const Vec3<T>& color) {
    for (int i = 0; i < 4; ++i) {
        const Vec3<T> off = (shares[i] - shares[(i + 1) % 4]) * color;
        if (abs(off.x) + abs(off.y) + abs(off.z) > T(.1)) return true;
    }
    return false;
}

/// The share of light that comes from a point of a grid that jitters: `high` with this chance, else `low`.
template <class T>
struct JitteredPoint {
    Vec3<T> low{0}, high{0};
    T chance = 0;
};

/// Finds the mean share of light that adaptive sampling finds, over all places to which points jitter, each apart from
/// the others. Parts are divided if their corners differ, which is so for some of the 16 states of the four. Corners
/// that quarters have in common do not matter, since the mean of a sum is the sum of the means: a quarter depends on
/// its part only by the one corner that both have.
template <class T>
class AdaptiveMean {
  public:
    AdaptiveMean(const std::vector<JitteredPoint<T>>& points, int columns, int rows, int adaptive, const Vec3<T>& color)
        : points(points), columns(columns), rows(rows), adaptive(adaptive), color(color) {}

    Vec3<T> mean() const {
        const CornerMeans all = means({0, 0, columns - 1, rows - 1}, 0, 0);
        return fma(points[0].chance, all.high - all.low, all.low);
    }

  private:
    /// The means of a part if one of its corners is low, and if it is high.
    struct CornerMeans {
        Vec3<T> low{0}, high{0};
        const Vec3<T>& at(bool is_high) const { return is_high ? high : low; }
    };

    CornerMeans means(const GridPart& part, int level, int given) const {
        const std::array<int, 4> corners = part.corners(rows);
        std::array<CornerMeans, 4> quarters;
        bool divided = false;
        const auto divide = [&] {
            const auto parts = part.quarters();
            for (int i = 0; i < 4; ++i) quarters[i] = means(parts[i], level + 1, GridPart::corner_of_quarter[i]);
            divided = true;
        };
        CornerMeans result;
        for (int state = 0; state < 16; ++state) {
            const auto is_high = [state](int corner) { return bool(state >> corner & 1); };
            T chance = chance_of(corners, given, is_high);
            if (!(chance > T(0))) continue;
            std::array<Vec3<T>, 4> shares;
            for (int i = 0; i < 4; ++i) shares[i] = is_high(i) ? points[corners[i]].high : points[corners[i]].low;
            Vec3<T> sum{0};
            if (part.divisible() && (level < adaptive || differs(shares, color))) {
                if (!divided) divide();
                for (int i = 0; i < 4; ++i) sum = sum + quarters[i].at(is_high(GridPart::corner_of_quarter[i]));
            } else {
                for (const Vec3<T>& share : shares) sum = sum + share;
            }
            Vec3<T>& own = is_high(given) ? result.high : result.low;
            own = fma(chance / 4, sum, own);
        }
        return result;
    }
    /// Returns the chance of a state of the corners, given that of one of them. Where a part is one point wide corners
    /// are the same point, and in one state.
    template <class IsHigh>
    T chance_of(const std::array<int, 4>& corners, int given, const IsHigh& is_high) const {
        T all = 1;
        for (int i = 0; i < 4; ++i) {
            bool known = corners[i] == corners[given];
            if (known && is_high(i) != is_high(given)) return 0;
            for (int k = 0; k < i; ++k) {
                if (corners[i] != corners[k]) continue;
                if (is_high(i) != is_high(k)) return 0;
                known = true;
            }
            const T own = points[corners[i]].chance;
            if (!known) all *= is_high(i) ? own : 1 - own;
        }
        return all;
    }

    const std::vector<JitteredPoint<T>>& points;
    const int columns, rows, adaptive;
    const Vec3<T> color;
};

}  // namespace strahl::inline STRAHL_LEVEL
