#include "pov/things/implicit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "num/vec_math.h"
#include "scene/kinds/triangle.h"

namespace strahl::pov {
namespace {

constexpr double outside = 1e30;  // stands for what is no number

/// A grid of points, (cells + 1)^3 of them.
struct PointGrid {
    Box box;
    int cells;

    DVec3 point(int i, int j, int k) const { return box.low + box.size() * DVec3(i, j, k) / double(cells); }
    std::size_t number(int i, int j, int k) const {
        return (std::size_t(k) * std::size_t(cells + 1) + std::size_t(j)) * std::size_t(cells + 1) + std::size_t(i);
    }
    DVec3 point(std::size_t number) const {
        const auto side = std::size_t(cells + 1);
        return point(int(number % side), int(number / side % side), int(number / side / side));
    }
};

std::vector<double> values_at(const Inside& inside, const std::vector<DVec3>& points) {
    std::vector<double> values(points.size());
    inside(points, values.data());
    for (double& own : values)
        if (!std::isfinite(own)) own = outside;
    return values;
}

/// An edge of a cell: where it begins, and the axis along which it leads. Bit 0 of a corner says whether it is the one
/// with the larger x, bits 1 and 2 y and z.
struct CellEdge {
    int corner, axis;

    constexpr explicit CellEdge(int number) : axis(number / 4) {
        corner = (number & 1) << (axis + 1) % 3 | (number >> 1) % 2 << (axis + 2) % 3;
    }
    constexpr static int number(int from, int to) {
        const int low = from & to, axis = (from ^ to) / 2;
        return 4 * axis + (low >> (axis + 1) % 3 & 1) + 2 * (low >> (axis + 2) % 3 & 1);
    }
    constexpr bool on_face_of(const CellEdge& other) const {
        for (int face = 0; face < 3; ++face)
            if (face != axis && face != other.axis && (corner >> face & 1) == (other.corner >> face & 1)) return true;
        return false;
    }
};

/// Triangles whose corners are on edges of a cell, and face outwards.
using CellTriangles = std::vector<std::array<int, 3>>;

/// Returns the triangles through a cell; bit n of `inside` says whether its corner n is inside. On a face of which two
/// opposite corners are inside these are apart, in both cells that share it, so that surfaces are closed.
CellTriangles triangles_through(int inside) {
    std::array<int, 12> next;  // of an edge: where the line over a face leads that begins there
    next.fill(-1);
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const int a = side << axis, b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3;
            const std::array<int, 4> ring = side ? std::array{a, a | b, a | b | c, a | c}  // seen from outside the cell
                                                 : std::array{a, a | c, a | b | c, a | b};
            const auto corner = [&](int i) { return ring[std::size_t(i % 4)]; };
            const auto is_in = [&](int i) { return (inside >> corner(i) & 1) != 0; };
            for (int i = 0; i < 4; ++i) {
                if (is_in(i) || !is_in(i + 1)) continue;
                int last = i + 1;
                while (is_in(last + 1)) ++last;
                next[std::size_t(CellEdge::number(corner(i), corner(i + 1)))] =
                    CellEdge::number(corner(last), corner(last + 1));
            }
        }
    CellTriangles triangles;
    for (int first = 0; first < 12; ++first) {
        std::vector<int> loop;
        for (int edge = first; next[std::size_t(edge)] >= 0;) {
            loop.push_back(edge);
            edge = std::exchange(next[std::size_t(edge)], -1);
        }
        // A fan, none of whose inner sides lies in a face of the cell: there the cell beside it could have the same.
        const auto lies_in_face = [&](std::size_t i, std::size_t k) {
            return CellEdge(loop[i]).on_face_of(CellEdge(loop[(i + k) % loop.size()]));
        };
        std::size_t middle = 0;
        for (std::size_t k = 2; k + 1 < loop.size(); ++k)
            if (lies_in_face(middle, k)) ++middle, k = 1;
        for (std::size_t k = 1; k + 1 < loop.size(); ++k)
            triangles.push_back({loop[middle], loop[(middle + k) % loop.size()], loop[(middle + k + 1) % loop.size()]});
    }
    return triangles;
}

/// A function's values on a grid near the surface on which it is 0. Looks for it at every second point, and follows it
/// from there.
class SurfaceGrid {
  public:
    SurfaceGrid(const Inside& inside, const Box& box, int cells)
        : grid{box, cells},
          inside(inside),
          blocks(cells / 2),
          values(grid.number(0, 0, cells + 1), unknown),
          visited(std::size_t(blocks * blocks * blocks)) {
        for (int k = 0; k <= cells; k += 2)
            for (int j = 0; j <= cells; j += 2)
                for (int i = 0; i <= cells; i += 2) ask(grid.number(i, j, k));
        answer();
        for (int k = 0; k < blocks; ++k)
            for (int j = 0; j < blocks; ++j)
                for (int i = 0; i < blocks; ++i)
                    if (is_cut(2 * i, 2 * j, 2 * k, {2, 2, 2}, 2)) visit(i, j, k);
        while (!found.empty()) {
            const std::vector<std::array<int, 3>> now = std::exchange(found, {});
            for (const auto& [i, j, k] : now)
                for (int n = 0; n < 27; ++n) ask(grid.number(2 * i + n % 3, 2 * j + n / 3 % 3, 2 * k + n / 9));
            answer();
            for (const auto& own : now)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    for (int side = 0; side < 2; ++side) {
                        std::array<int, 3> beside = own, at{2 * own[0], 2 * own[1], 2 * own[2]}, size{2, 2, 2};
                        beside[axis] += 2 * side - 1, at[axis] += 2 * side, size[axis] = 0;
                        if (beside[axis] >= 0 && beside[axis] < blocks && is_cut(at[0], at[1], at[2], size, 1))
                            visit(beside[0], beside[1], beside[2]);
                    }
        }
    }

    /// Calls visit(i, j, k, which of its corners are inside) for each cell that the surface cuts.
    template <class Visit>
    void for_each_cut_cell(const Visit& visit) const {
        for (int b = 0; b < blocks * blocks * blocks; ++b) {
            if (!visited[std::size_t(b)]) continue;
            for (int n = 0; n < 8; ++n) {
                const int i = 2 * (b % blocks) + n % 2, j = 2 * (b / blocks % blocks) + n / 2 % 2,
                          k = 2 * (b / blocks / blocks) + n / 4;
                int below = 0;
                for (int corner = 0; corner < 8; ++corner)
                    below |= (value(i + corner % 2, j + corner / 2 % 2, k + corner / 4) < 0) << corner;
                if (below != 0 && below != 255) visit(i, j, k, below);
            }
        }
    }
    double value(int i, int j, int k) const { return values[grid.number(i, j, k)]; }

    const PointGrid grid;

  private:
    static constexpr double unknown = 2e30, asked = 3e30;

    void ask(std::size_t number) {
        if (values[number] != unknown) return;
        values[number] = asked;
        wanted.push_back(number);
        points.push_back(grid.point(number));
    }
    void answer() {
        const std::vector<double> found_values = values_at(inside, points);
        for (std::size_t n = 0; n < wanted.size(); ++n) values[wanted[n]] = found_values[n];
        wanted.clear(), points.clear();
    }
    /// Are points both inside and outside? Those of a part of the grid, `step` apart.
    bool is_cut(int i, int j, int k, const std::array<int, 3>& size, int step) const {
        const bool first = value(i, j, k) < 0;
        for (int z = k; z <= k + size[2]; z += step)
            for (int y = j; y <= j + size[1]; y += step)
                for (int x = i; x <= i + size[0]; x += step)
                    if ((value(x, y, z) < 0) != first) return true;
        return false;
    }
    void visit(int i, int j, int k) {
        char& known = visited[std::size_t((k * blocks + j) * blocks + i)];
        if (!std::exchange(known, 1)) found.push_back({i, j, k});
    }

    const Inside& inside;
    int blocks;  // number of blocks, of two cells along each axis
    std::vector<double> values;
    std::vector<char> visited;
    std::vector<std::array<int, 3>> found;
    std::vector<std::size_t> wanted;
    std::vector<DVec3> points;
};

/// A place on an edge of the grid, between a point that is inside and one that is outside.
struct EdgePlace {
    DVec3 a, b, p;
    double at_a, at_b, at_p = 0;
};

/// Moves all places to where the function is 0, by up to four steps of the regula falsi.
void find_crossings(const Inside& inside, std::vector<EdgePlace>& all) {
    std::vector<EdgePlace*> open;
    for (EdgePlace& own : all) open.push_back(&own);
    std::vector<DVec3> points;
    for (int i = 0; i < 4 && !open.empty(); ++i) {
        points.clear();
        for (EdgePlace* const own : open) {
            const double range = own->at_a - own->at_b;
            const double share = std::fabs(range) < outside / 2 ? std::clamp(own->at_a / range, .01, .99) : .5;
            points.push_back(own->p = own->a + share * (own->b - own->a));
        }
        const std::vector<double> values = values_at(inside, points);
        std::size_t kept = 0;
        for (std::size_t n = 0; n < open.size(); ++n) {
            EdgePlace& own = *open[n];
            own.at_p = values[n];
            const double range = std::min(std::fabs(own.at_a - own.at_b), outside / 2);
            if (std::fabs(own.at_p) <= 1e-3 * range) continue;
            if ((own.at_p < 0) == (own.at_a < 0))
                own.a = own.p, own.at_a = own.at_p;
            else
                own.b = own.p, own.at_b = own.at_p;
            open[kept++] = &own;
        }
        open.resize(kept);
    }
}

}  // namespace

MeshData level_surface(const Inside& inside, const Box& box, int cells) {
    // Marching cubes (W. E. Lorensen and H. E. Cline, 1987).
    static const std::vector<CellTriangles> triangles = [] {
        std::vector<CellTriangles> all;
        for (int i = 0; i < 256; ++i) all.push_back(triangles_through(i));
        return all;
    }();
    const SurfaceGrid surface(inside, box, cells);
    const PointGrid& grid = surface.grid;
    std::vector<EdgePlace> crossings;
    std::vector<std::int32_t> numbers(3 * grid.number(0, 0, cells + 1), -1);  // of the edges from each point
    MeshData mesh;
    surface.for_each_cut_cell([&](int i, int j, int k, int below) {
        std::array<std::int32_t, 12> own{};
        for (const auto& triangle : triangles[std::size_t(below)]) {
            for (const int n : triangle) {
                const CellEdge edge(n);
                const int x = i + edge.corner % 2, y = j + edge.corner / 2 % 2, z = k + edge.corner / 4;
                std::int32_t& number = numbers[3 * grid.number(x, y, z) + std::size_t(edge.axis)];
                if (number < 0) {
                    number = static_cast<std::int32_t>(crossings.size());
                    const int x2 = x + (edge.axis == 0), y2 = y + (edge.axis == 1), z2 = z + (edge.axis == 2);
                    crossings.push_back({grid.point(x, y, z),
                                         grid.point(x2, y2, z2),
                                         {},
                                         surface.value(x, y, z),
                                         surface.value(x2, y2, z2)});
                }
                own[std::size_t(n)] = number;
            }
            mesh.triangles.push_back(
                {own[std::size_t(triangle[0])], own[std::size_t(triangle[1])], own[std::size_t(triangle[2])]});
        }
    });
    find_crossings(inside, crossings);
    const double step = length(box.size()) / cells * 1e-3;
    std::vector<DVec3> beside;
    for (const EdgePlace& own : crossings)
        for (const DVec3& way : {DVec3(step, 0, 0), DVec3(0, step, 0), DVec3(0, 0, step)})
            beside.push_back(own.p + way);
    const std::vector<double> values = values_at(inside, beside);
    for (std::size_t n = 0; n < crossings.size(); ++n) {
        mesh.points.push_back(crossings[n].p);
        const DVec3 slope = DVec3(values[3 * n], values[3 * n + 1], values[3 * n + 2]) - crossings[n].at_p;
        mesh.normals.push_back(
            std::max({std::fabs(slope.x), std::fabs(slope.y), std::fabs(slope.z)}) < outside / 2 ? slope : DVec3(0));
    }
    const auto at = [&](std::int32_t n) -> const DVec3& { return mesh.points[std::size_t(n)]; };
    std::erase_if(mesh.triangles, [&](const MeshData::Corners& own) {
        if (Triangle{at(own[0]), at(own[1]), at(own[2])}.fault()) return true;
        for (const std::int32_t n : own)
            if (DVec3& normal = mesh.normals[std::size_t(n)]; !(length(normal) > 0))
                normal = cross_product(at(own[1]) - at(own[0]), at(own[2]) - at(own[0]));
        return false;
    });
    mesh.corner_normals = mesh.triangles;
    return mesh;
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

Box region_of(const Inside& inside, const Box& within) {
    constexpr int cells = 40;
    const PointGrid grid{within, cells};
    std::vector<DVec3> points;
    for (std::size_t n = 0; n < grid.number(0, 0, cells + 1); ++n) points.push_back(grid.point(n));
    const std::vector<double> values = values_at(inside, points);
    Box found;
    for (std::size_t n = 0; n < points.size(); ++n)
        if (values[n] < 0) found.add(points[n]);
    if (found.empty()) return found;
    const DVec3 more = within.size() / double(cells);
    return {max(found.low - more, within.low), min(found.high + more, within.high)};
}

}  // namespace strahl::pov
