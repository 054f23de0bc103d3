#include "pov/things/bicubic.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "num/vec_math.h"
#include "pov/things/mesh_builder.h"

namespace strahl::pov {
namespace {

using ControlPoints = std::array<DVec3, 16>;

/// Splits a patch in the middle, across its rows or along them.
std::array<ControlPoints, 2> halves(const ControlPoints& whole, bool across) {
    const std::size_t line = across ? 1 : 4, step = across ? 4 : 1;
    const auto middle = [](const DVec3& a, const DVec3& b) { return .5 * (a + b); };
    std::array<ControlPoints, 2> parts;
    for (std::size_t first = 0; first < 4 * line; first += line) {
        const auto p = [&](std::size_t i) { return whole[first + i * step]; };
        const DVec3 a = middle(p(0), p(1)), b = middle(p(1), p(2)), c = middle(p(2), p(3));
        const DVec3 ab = middle(a, b), bc = middle(b, c), centre = middle(ab, bc);
        const std::array<DVec3, 7> all{p(0), a, ab, centre, bc, c, p(3)};
        for (std::size_t i = 0; i < 4; ++i)
            parts[0][first + i * step] = all[i], parts[1][first + i * step] = all[i + 3];
    }
    return parts;
}

/// Returns how far control points are from the plane through three corners of the patch, as POV-Ray chooses them;
/// infinity if these are no triangle.
double off_plane(const ControlPoints& patch) {
    constexpr double none = std::numeric_limits<double>::infinity(), nothing = 1e-10;
    const bool joined = length(patch[0] - patch[3]) < nothing;
    const DVec3 a = patch[0] - patch[joined ? 15 : 3], c = patch[12] - patch[joined ? 15 : 3];
    if (length(a) < nothing || length(c) < nothing) return none;
    const DVec3 across = cross_product(a, c);
    if (dot_product(across, across) <= nothing * dot_product(a, a) * dot_product(c, c)) return none;
    double most = 0;
    for (const DVec3& p : patch) most = std::max(most, std::fabs(dot_product(p - patch[0], normalize(across))));
    return most;
}

/// Divides a patch.
class PatchDivider {
  public:
    explicit PatchDivider(const BicubicPatch& patch) : patch(patch) {}
    std::optional<MeshData> mesh() {
        if (!divide({patch.points, {0, 0}, {1, 1}}, 0)) return std::nullopt;
        MeshData made = builder.finish();
        made.places = std::move(places);
        return made;
    }

  private:
    /// A part of the patch, between parameters across rows and along them.
    struct SubPatch {
        ControlPoints points;
        std::array<double, 2> low, high;
    };
    /// Adds the triangles of a part that has been halved so often; returns whether there are not too many.
    bool divide(const SubPatch& part, int depth) {
        constexpr int deepest = 24;
        const auto halved = [&](std::size_t way) { return depth < std::min(patch.steps[way], deepest); };
        if (!(halved(0) || halved(1)) || off_plane(part.points) < patch.flatness) return add(part);
        std::vector<SubPatch> parts{part};
        for (std::size_t way = 0; way < 2; ++way) {
            if (!halved(way)) continue;
            std::vector<SubPatch> both;
            for (const SubPatch& whole : parts) {
                const auto [first, second] = halves(whole.points, way == 0);
                const double middle = (whole.low[way] + whole.high[way]) / 2;
                both.push_back({first, whole.low, whole.high}), both.back().high[way] = middle;
                both.push_back({second, whole.low, whole.high}), both.back().low[way] = middle;
            }
            parts = std::move(both);
        }
        return std::ranges::all_of(parts, [&](const SubPatch& own) { return divide(own, depth + 1); });
    }
    bool add(const SubPatch& part) {
        if (places.size() + 4 > 2 * BicubicPatch::most_triangles) return false;
        const auto& [low, high] = std::pair(part.low, part.high);
        const std::array<std::array<double, 2>, 4> at{{low, {low[0], high[1]}, high, {high[0], low[1]}}};
        const std::array<DVec3, 4> points{part.points[0], part.points[3], part.points[15], part.points[12]};
        std::array<DVec3, 4> normals;
        const auto first = std::int32_t(places.size());
        for (std::size_t k = 0; k < 4; ++k)
            normals[k] = normal_at(at[k][0], at[k][1]), places.push_back(place_at(at[k][0], at[k][1]));
        const MeshData::Corners one{first, first + 1, first + 2}, other{first, first + 2, first + 3};
        builder.add_triangle({points[0], points[1], points[2]}, {normals[0], normals[1], normals[2]}, true, &one);
        builder.add_triangle({points[0], points[2], points[3]}, {normals[0], normals[2], normals[3]}, true, &other);
        return true;
    }
    /// Returns the normal of the surface, of length 1; where it has none, that along x.
    DVec3 normal_at(double u, double v) const {
        const auto weights = [](double t) {
            const double s = 1 - t;
            return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        };
        const auto slopes = [](double t) {
            const double s = 1 - t;
            return std::array{-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
        };
        const auto sum = [&](const std::array<double, 4>& across, const std::array<double, 4>& along) {
            DVec3 p(0);
            for (std::size_t i = 0; i < 16; ++i) p += across[i / 4] * along[i % 4] * patch.points[i];
            return p;
        };
        const DVec3 a = sum(slopes(u), weights(v)), b = sum(weights(u), slopes(v)), normal = cross_product(a, b);
        const bool known = dot_product(normal, normal) > 1e-10 * dot_product(a, a) * dot_product(b, b);
        return known ? normalize(normal) : DVec3(1, 0, 0);
    }
    MeshData::Place place_at(double u, double v) const {
        const auto& own = patch.places;
        MeshData::Place place;
        for (std::size_t k = 0; k < 2; ++k)
            place[k] = std::lerp(std::lerp(own[0][k], own[1][k], v), std::lerp(own[3][k], own[2][k], v), u);
        return place;
    }

    const BicubicPatch& patch;
    MeshBuilder builder;
    std::vector<MeshData::Place> places;
};

}  // namespace

std::optional<MeshData> BicubicPatch::mesh() const { return PatchDivider(*this).mesh(); }

}  // namespace strahl::pov
