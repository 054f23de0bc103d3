#include "pov/things/surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

#include "mesh/split.h"
#include "num/vec_math.h"
#include "pov/things/mesh_builder.h"
#include "pov/things/outlines.h"

namespace strahl::pov {
namespace {

/// Returns the points of a curve with these coefficients: a t^3 + b t^2 + c t + d, t from 0 to 1.
std::vector<Point2> curve(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
    std::vector<Point2> line;
    for (int i = 0; i <= curve_pieces; ++i) {
        const double t = double(i) / curve_pieces;
        line.push_back({((a[0] * t + b[0]) * t + c[0]) * t + d[0], ((a[1] * t + b[1]) * t + c[1]) * t + d[1]});
    }
    return line;
}

}  // namespace

void join_points(MeshData& mesh) {
    const auto join = [](std::vector<DVec3>& list, std::vector<MeshData::Corners>& corners) {
        PointJoiner joined;
        for (MeshData::Corners& own : corners)
            for (std::int32_t& n : own) n = joined.number_of(list[static_cast<std::size_t>(n)]);
        list = std::move(joined.points());
    };
    if (!mesh.places.empty() && mesh.corner_places.empty()) mesh.corner_places = mesh.triangles;
    join(mesh.points, mesh.triangles);
    if (!mesh.corner_normals.empty()) join(mesh.normals, mesh.corner_normals);
}

void turn_alike(MeshData& mesh) {
    // The triangles at each side, and whether they run along it from the lower number of a point to the higher.
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::pair<std::size_t, bool>>> sides;
    const auto each_side = [&](std::size_t i, const auto& visit) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::int32_t from = mesh.triangles[i][k], to = mesh.triangles[i][(k + 1) % 3];
            visit(sides[std::minmax(from, to)], from < to);
        }
    };
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; ++i) each_side(i, [&](auto& own, bool rises) { own.emplace_back(i, rises); });
    std::vector<int> turned(count, -1);  // -1 while it is not known
    for (std::size_t first = 0; first < count; ++first) {
        if (turned[first] >= 0) continue;
        std::vector<std::size_t> found{first};
        turned[first] = 0;
        double volume = 0;
        for (std::size_t n = 0; n < found.size(); ++n) {
            const std::size_t i = found[n];
            each_side(i, [&](const auto& own, bool rises) {
                if (own.size() != 2) return;
                const auto& [other, other_rises] = own[own[0].first == i ? 1 : 0];
                if (turned[other] < 0) turned[other] = turned[i] ^ (rises == other_rises), found.push_back(other);
            });
            const auto at = [&](std::size_t k) {
                return mesh.points[static_cast<std::size_t>(mesh.triangles[i][k])] - mesh.points[0];
            };
            volume += (turned[i] ? -1 : 1) * dot_product(at(0), cross_product(at(1), at(2)));
        }
        for (const std::size_t i : found) {
            if ((turned[i] != 0) == (volume < 0)) continue;
            for (auto* const corners : {&mesh.triangles, &mesh.corner_normals, &mesh.corner_places})
                if (!corners->empty()) std::swap((*corners)[i][1], (*corners)[i][2]);
        }
    }
}

std::vector<std::vector<Point2>> lines_of(SplineKind kind, std::span<const Point2> points) {
    std::vector<std::vector<Point2>> lines;
    const auto mix = [](std::initializer_list<std::pair<double, Point2>> terms) {
        Point2 sum{};
        for (const auto& [factor, p] : terms) sum[0] += factor * p[0], sum[1] += factor * p[1];
        return sum;
    };
    const std::size_t count = points.size();
    switch (kind) {
        case SplineKind::linear:
            for (std::size_t i = 0; i + 1 < count; ++i) lines.push_back({points[i], points[i + 1]});
            break;
        case SplineKind::quadratic:
            for (std::size_t i = 0; i + 2 < count; ++i) {
                const Point2 &p = points[i], &q = points[i + 1], &r = points[i + 2];
                lines.push_back(curve({}, mix({{.5, p}, {-1, q}, {.5, r}}), mix({{-.5, p}, {.5, r}}), q));
            }
            break;
        case SplineKind::cubic:
            for (std::size_t i = 0; i + 3 < count; ++i) {
                const Point2 &p = points[i], &q = points[i + 1], &r = points[i + 2], &s = points[i + 3];
                lines.push_back(curve(mix({{-.5, p}, {1.5, q}, {-1.5, r}, {.5, s}}),
                                      mix({{1, p}, {-2.5, q}, {2, r}, {-.5, s}}), mix({{-.5, p}, {.5, r}}), q));
            }
            break;
        case SplineKind::bezier:
            for (std::size_t i = 0; i + 3 < count; i += 4) {
                const Point2 &p = points[i], &q = points[i + 1], &r = points[i + 2], &s = points[i + 3];
                lines.push_back(curve(mix({{-1, p}, {3, q}, {-3, r}, {1, s}}), mix({{3, p}, {-6, q}, {3, r}}),
                                      mix({{-3, p}, {3, q}}), p));
            }
            break;
    }
    // Each curve goes on exactly where the one before ends.
    for (std::size_t i = 1; i < lines.size(); ++i)
        if (std::hypot(lines[i][0][0] - lines[i - 1].back()[0], lines[i][0][1] - lines[i - 1].back()[1]) < 1e-9)
            lines[i][0] = lines[i - 1].back();
    return lines;
}

MeshData swept(std::vector<Outline> outlines, const Sweep& sweep) {
    const auto& [low, high, conic, caps, smooth] = sweep;
    MeshBuilder mesh;
    const auto at = [&conic = conic](const Point2& p, double y) {
        return conic ? DVec3(p[0] * y, y, p[1] * y) : DVec3(p[0], y, p[1]);
    };
    for (const Outline& outline : turned_as_faces(outlines)) {
        const std::size_t count = outline.size();
        const auto side = [&](std::size_t i) {  // the normal of the side that begins at a corner
            const Point2 &p = outline[i % count], &q = outline[(i + 1) % count];
            return normalize(DVec3(p[1] - q[1], 0, q[0] - p[0]));
        };
        for (std::size_t i = 0; i < count; ++i) {
            const Point2 &p = outline[i], &q = outline[(i + 1) % count];
            const DVec3 own = side(i), before = side(i + count - 1), behind = side(i + 1);
            constexpr double hardly = .9;  // the cosine of 26 degrees
            const DVec3 first = dot_product(own, before) > hardly ? own + before : own;
            const DVec3 last = dot_product(own, behind) > hardly ? own + behind : own;
            mesh.add_square({at(p, low), at(q, low), at(q, high), at(p, high)}, {first, last, last, first},
                            smooth && !conic);
        }
    }
    for (const Outline& face : faces_of(outlines))
        for (const double y : {low, high}) {
            if (!caps || (conic && y == 0)) continue;
            std::vector<DVec3> points;
            std::vector<std::int32_t> corners;
            for (const Point2& p : face)
                corners.push_back(static_cast<std::int32_t>(points.size())), points.push_back(at(p, y));
            FaceSplitter splitter;
            for (const auto& [a, b, c] : splitter.split(points, corners)) {
                const DVec3 &p = points[std::size_t(a)], &q = points[std::size_t(b)], &r = points[std::size_t(c)];
                mesh.add_triangle(y == low ? std::array{p, r, q} : std::array{p, q, r}, {}, false);
            }
        }
    return mesh.finish();
}

MeshData superellipsoid(double e, double n, int cells) {
    const int around = std::min(4 * cells, 128), up = around / 2;
    const auto power = [](double v, double exponent) { return std::copysign(std::pow(std::fabs(v), exponent), v); };
    const auto exact = [](double v) { return std::fabs(v) < 1e-12 ? 0 : v; };
    const auto powers = [&](int count, const auto& angle, double exponent) {
        std::vector<Point2> all;
        for (int i = 0; i <= count; ++i)
            all.push_back({power(exact(std::cos(angle(i))), exponent), power(exact(std::sin(angle(i))), exponent)});
        return all;
    };
    const auto u = [=](int i) { return 2 * std::numbers::pi * (i % around) / around; };
    const auto v = [=](int j) { return std::numbers::pi * (double(j) / up - .5); };
    const std::vector<Point2> east = powers(around, u, e), north = powers(up, v, n);
    const std::vector<Point2> east_slopes = powers(around, u, 2 - e), north_slopes = powers(up, v, 2 - n);
    const auto place = [](const Point2& about, const Point2& along) {
        return DVec3(along[0] * about[0], along[0] * about[1], along[1]);
    };
    MeshBuilder mesh;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < up; ++j) {
            const std::array<std::array<int, 2>, 4> corners{{{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}}};
            std::array<DVec3, 4> points, normals;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto x = std::size_t(corners[k][0]), y = std::size_t(corners[k][1]);
                points[k] = place(east[x], north[y]);
                normals[k] = e < 2 && n < 2 ? place(east_slopes[x], north_slopes[y]) : DVec3(0);
            }
            mesh.add_square(points, normals);
        }
    return mesh.finish();
}

MeshData patch(int pieces, const std::function<std::pair<DVec3, DVec3>(double u, double v)>& at,
               const std::function<Point2(const Point2& uv)>& place) {
    const auto side = std::size_t(pieces) + 1;
    std::vector<std::pair<DVec3, DVec3>> corners;
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j < side; ++j) corners.push_back(at(double(i) / pieces, double(j) / pieces));
    MeshBuilder mesh;
    for (std::size_t i = 0; i + 1 < side; ++i)
        for (std::size_t j = 0; j + 1 < side; ++j) {
            const auto first = std::int32_t(i * side + j), next = first + std::int32_t(side);
            for (const MeshData::Corners& own :
                 {MeshData::Corners{first, next, next + 1}, {first, next + 1, first + 1}}) {
                std::array<DVec3, 3> p, n;
                double sum = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    std::tie(p[k], n[k]) = corners[std::size_t(own[k])];
                    sum += p[k].x + p[k].y + p[k].z;
                }
                if (std::isfinite(sum)) mesh.add_triangle(p, n, true, &own);
            }
        }
    MeshData made = mesh.finish();
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j < side; ++j) made.places.push_back(place({double(i) / pieces, double(j) / pieces}));
    return made;
}

MeshData height_field(int width, int height, std::span<const double> heights, double water, bool smooth) {
    MeshData mesh;
    const auto value = [&](int i, int j) { return heights[std::size_t(j) * std::size_t(width) + std::size_t(i)]; };
    const double dx = 1. / (width - 1), dz = 1. / (height - 1);
    // Returns the normal of the triangle between three neighbours in a row, one apart, as steep as heights of 0 to
    // 65536 make it, or 0 outside.
    const auto steep = [&](int i, int j, int x, int z) {
        if (std::min(i + x, j + z) < 0 || i + x >= width || j + z >= height) return DVec3(0);
        const double here = 65536 * value(i, j);
        return normalize(DVec3(x * (here - 65536 * value(i + x, j)), 1, z * (here - 65536 * value(i, j + z))));
    };
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            mesh.points.push_back({i * dx, value(i, j), j * dz});
            if (!smooth) continue;
            // POV-Ray keeps normals as whole 32767ths, in a space in which cells are 1 wide and 65536 high.
            DVec3 n =
                32767. * normalize(steep(i, j, 1, 1) + steep(i, j, -1, 1) + steep(i, j, -1, -1) + steep(i, j, 1, -1));
            for (int k = 0; k < 3; ++k) n[k] = std::trunc(n[k]);
            mesh.normals.push_back({n.x / dx, 65536 * n.y, n.z / dz});
        }
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        const auto above = [&](std::int32_t n) { return mesh.points[std::size_t(n)].y > water; };
        if (above(a) || above(b) || above(c)) mesh.triangles.push_back({a, b, c});
    };
    for (int j = 0; j + 1 < height; ++j)
        for (int i = 0; i + 1 < width; ++i) {
            const int a = j * width + i, b = a + 1, c = a + width, d = c + 1;
            add(a, c, b), add(b, c, d);
        }
    if (smooth) mesh.corner_normals = mesh.triangles;
    return mesh;
}

}  // namespace strahl::pov
