#include "pov/things/implicit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "pov/things/mesh_builder.h"

namespace strahl::pov {
namespace {

/// A function's values on a grid of points, (cells + 1)^3 of them.
struct ValuesOnGrid {
    Box box;
    int cells;
    std::vector<double> values;

    ValuesOnGrid(const Inside& value, const Box& box, int cells) : box(box), cells(cells) {
        values.reserve(number(0, 0, cells + 1));
        for (int k = 0; k <= cells; ++k)
            for (int j = 0; j <= cells; ++j)
                for (int i = 0; i <= cells; ++i) {
                    const double own = value(point(i, j, k));
                    values.push_back(std::isfinite(own) ? own : 1e30);
                }
    }
    DVec3 point(int i, int j, int k) const { return box.low + box.size() * DVec3(i, j, k) / double(cells); }
    std::size_t number(int i, int j, int k) const {
        return (std::size_t(k) * std::size_t(cells + 1) + std::size_t(j)) * std::size_t(cells + 1) + std::size_t(i);
    }
};

/// A corner of a cell: bit 0 of `corner` says whether it is the one with the larger x, bits 1 and 2 y and z.
struct GridPoint {
    std::size_t number;
    DVec3 p;
    double value;
    std::size_t corner;
};

/// A point of the surface.
struct LevelPoint {
    DVec3 p, normal;
};

/// Returns where the function is 0 between two points on different sides, by four steps of the regula falsi.
DVec3 crossing(const Inside& value, GridPoint a, GridPoint b) {
    DVec3 p = a.p;
    for (int i = 0; i < 4; ++i) {
        const double share = std::clamp(a.value / (a.value - b.value), .01, .99);
        p = a.p + share * (b.p - a.p);
        const double own = value(p);
        if (!std::isfinite(own) || own == 0) break;
        ((own < 0) == (a.value < 0) ? a : b) = {0, p, own, 0};
    }
    return p;
}

}  // namespace

MeshData level_surface(const Inside& value, const Box& box, int cells) {
    // Each cell is divided into six tetrahedra around the diagonal from its first corner to its last (A. Doi and
    // A. Koide, "An Efficient Method of Triangulating Equi-Valued Surfaces by Using Tetrahedral Cells", 1991).
    static constexpr std::array<std::array<int, 2>, 6> between{{{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}}};
    const ValuesOnGrid grid(value, box, cells);
    const double step = length(box.size()) / cells * 1e-3;
    const auto slope = [&](const DVec3& p) {
        const auto along = [&](const DVec3& way) { return value(p + step * way) - value(p - step * way); };
        const DVec3 n(along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1}));
        return std::isfinite(n.x + n.y + n.z) ? n : DVec3(0);
    };
    MeshBuilder mesh;
    // From each point of the grid seven edges lead to points with larger coordinates. The cells around an edge share
    // its point, which costs ten values of the function. The cells of a layer need the points of edges from its lower
    // and its upper side only: those of odd and of even sides take turns.
    const std::size_t side = 7 * grid.number(0, 0, 1);
    std::vector<std::int32_t> numbers(2 * side, -1);
    std::vector<LevelPoint> known;
    const auto between_points = [&](GridPoint a, GridPoint b) {
        if (a.number > b.number) std::swap(a, b);
        std::int32_t& number = numbers[(7 * a.number + (b.corner - a.corner) - 1) % (2 * side)];
        if (number < 0) {
            number = static_cast<std::int32_t>(known.size());
            const DVec3 p = crossing(value, a, b);
            known.push_back({p, slope(p)});
        }
        return known[static_cast<std::size_t>(number)];
    };
    const auto add = [&](const LevelPoint& a, const LevelPoint& b, const LevelPoint& c, bool in_order) {
        const LevelPoint &second = in_order ? b : c, &third = in_order ? c : b;
        mesh.add_triangle({a.p, second.p, third.p}, {a.normal, second.normal, third.normal}, true);
    };
    const auto tetrahedron = [&](const std::array<GridPoint, 4>& corners) {
        std::array<GridPoint, 4> in{}, out{};
        std::size_t inside = 0, outside = 0;
        for (const GridPoint& own : corners) (own.value < 0 ? in[inside++] : out[outside++]) = own;
        const auto at = [&](std::size_t i, std::size_t o) { return between_points(in[i], out[o]); };
        // Do triangles whose sides lead along u and v face outwards?
        const auto face_out = [&](const DVec3& u, const DVec3& v) {
            return dot_product(cross_product(u, v), out[0].p - in[0].p) > 0;
        };
        if (inside == 1) add(at(0, 0), at(0, 1), at(0, 2), face_out(out[1].p - out[0].p, out[2].p - out[0].p));
        if (inside == 3) add(at(0, 0), at(1, 0), at(2, 0), face_out(in[1].p - in[0].p, in[2].p - in[0].p));
        if (inside != 2) return;
        const bool in_order = face_out(out[1].p - out[0].p, in[1].p - in[0].p);
        const LevelPoint a = at(0, 0), b = at(0, 1), c = at(1, 1), d = at(1, 0);
        add(a, b, c, in_order), add(a, c, d, in_order);
    };
    for (int k = 0; k < cells; ++k) {
        std::fill_n(numbers.begin() + std::ptrdiff_t((k + 1) % 2 * side), side, -1);
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                std::array<GridPoint, 8> corners;
                int below = 0;
                for (int n = 0; n < 8; ++n) {
                    const int x = i + (n & 1), y = j + (n >> 1 & 1), z = k + (n >> 2);
                    const std::size_t number = grid.number(x, y, z);
                    corners[std::size_t(n)] = {number, grid.point(x, y, z), grid.values[number], std::size_t(n)};
                    below += grid.values[number] < 0;
                }
                if (below == 0 || below == 8) continue;
                for (const auto& [a, b] : between)
                    tetrahedron({corners[0], corners[std::size_t(a)], corners[std::size_t(b)], corners[7]});
            }
    }
    return mesh.finish();
}

double polynomial(int order, std::span<const double> coefficients, const DVec3& p) {
    double result = 0;  // by Horner's rule in x, in y and in z
    std::size_t next = 0;
    for (int i = order; i >= 0; --i) {
        double of_x = 0;
        for (int j = order - i; j >= 0; --j) {
            double of_y = 0;
            for (int k = order - i - j; k >= 0; --k) of_y = of_y * p.z + coefficients[next++];
            of_x = of_x * p.y + of_y;
        }
        result = result * p.x + of_x;
    }
    return result;
}

Box region_of(const Inside& value, const Box& within) {
    constexpr int cells = 40;
    const ValuesOnGrid grid(value, within, cells);
    Box found;
    for (int k = 0; k <= cells; ++k)
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i)
                if (grid.values[grid.number(i, j, k)] < 0) found.add(grid.point(i, j, k));
    if (found.empty()) return found;
    const DVec3 more = within.size() / double(cells);
    return {max(found.low - more, within.low), min(found.high + more, within.high)};
}

}  // namespace strahl::pov
