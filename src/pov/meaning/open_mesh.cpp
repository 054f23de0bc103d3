#include "pov/meaning/open_mesh.h"

#include <algorithm>
#include <map>
#include <vector>

#include "num/bounding_box.h"
#include "num/vec_math.h"

namespace strahl::pov {
namespace {

using Side = std::pair<std::int32_t, std::int32_t>;

/// Returns the sides that only one triangle has, from corner to corner as it does, with the triangle's third corner.
std::map<Side, std::int32_t> open_sides(const MeshData& mesh) {
    std::map<Side, std::int32_t> open;
    for (const MeshData::Corners& own : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Side side{own[k], own[(k + 1) % 3]};
            if (!open.erase({side.second, side.first})) open[side] = own[(k + 2) % 3];
        }
    return open;
}

/// Adds a copy of a mesh below it, with its triangles turned over, and walls between their open sides.
Mesh with_depth(MeshData top, const DVec3& down) {
    const std::map<Side, std::int32_t> open = open_sides(top);
    const auto count = static_cast<std::int32_t>(top.points.size());
    const std::size_t triangles = top.triangles.size();
    for (std::int32_t i = 0; i < count; ++i) top.points.push_back(top.points[std::size_t(i)] + down);
    for (std::size_t i = 0; i < triangles; ++i) {
        const auto [a, b, c] = top.triangles[i];
        top.triangles.push_back({a + count, c + count, b + count});
    }
    for (const auto& [side, third] : open) {
        const auto [a, b] = side;
        top.triangles.push_back({b, a, a + count}), top.triangles.push_back({b, a + count, b + count});
    }
    if (!top.corner_normals.empty()) {
        const auto first = static_cast<std::int32_t>(top.normals.size());
        top.normals.push_back(down);
        top.corner_normals.resize(top.triangles.size(), {first, first, first});
    }
    if (!top.places.empty() && !top.corner_places.empty()) top.corner_places.resize(top.triangles.size(), {0, 0, 0});
    if (!top.places.empty() && top.corner_places.empty()) top.places.resize(top.points.size());
    return Mesh{std::make_shared<const MeshData>(std::move(top)), ""};
}

}  // namespace

std::optional<std::pair<Mesh, Mesh>> closed_along(const MeshData& open, const DVec3& up) {
    constexpr double hair = 1e-6, brim = 1e-4, depth = 1e3;  // in sizes of the mesh
    const std::map<Side, std::int32_t> sides = open_sides(open);
    Box box;
    for (const DVec3& point : open.points) box.add(point);
    const double size = length(box.high - box.low);
    if (!(length(up) > 0) || !(size > 0) || sides.empty()) return {};
    const DVec3 above = size * normalize(up);
    // The first body has a brim outside of the open sides, so that its walls are outside of the second one's.
    std::map<std::int32_t, DVec3> outwards;
    for (const auto& [side, third] : sides) {
        const DVec3 from = open.points[std::size_t(side.first)], way = open.points[std::size_t(side.second)] - from;
        DVec3 out = cross_product(way, above);
        if (!(length(out) > 1e-9 * size * length(way))) continue;
        out = normalize(out) * (dot_product(out, open.points[std::size_t(third)] - from) > 0 ? -1. : 1.);
        for (const std::int32_t corner : {side.first, side.second}) {
            DVec3& sum = outwards.try_emplace(corner, DVec3(0)).first->second;
            sum = sum + out;
        }
    }
    MeshData first = open, second = open;
    std::map<std::int32_t, std::int32_t> brims;  // the points of the brim
    const auto beside = [&](std::int32_t corner) {
        const auto [known, is_new] = brims.try_emplace(corner, static_cast<std::int32_t>(first.points.size()));
        if (is_new) {
            const DVec3 out = outwards[corner];
            const DVec3 way = length(out) > 0 ? brim * size * normalize(out) : DVec3(0);
            first.points.push_back(open.points[std::size_t(corner)] + way);
        }
        return known->second;
    };
    for (const auto& [side, third] : sides) {
        const auto [a, b] = side;
        const std::int32_t outer_a = beside(a), outer_b = beside(b);
        first.triangles.push_back({b, a, outer_a}), first.triangles.push_back({b, outer_a, outer_b});
    }
    for (DVec3& point : second.points) point = point + hair * above;
    second.normals.clear(), second.corner_normals.clear(), second.places.clear(), second.corner_places.clear();
    const Mesh whole = with_depth(std::move(first), -depth * above),
               cut = with_depth(std::move(second), -.5 * depth * above);
    if (whole.open() || cut.open()) return {};
    return std::pair{whole, cut};
}

}  // namespace strahl::pov
