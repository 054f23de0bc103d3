#include "scene/ray_hits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"

namespace strahl {

bool meets(const Box& box, const Ray<double>& ray) {
    double near = 0, far = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (ray.direction[i] == 0) {
            if (!(box.low[i] <= ray.origin[i] && ray.origin[i] <= box.high[i])) return false;
            continue;
        }
        const double a = (box.low[i] - ray.origin[i]) / ray.direction[i];
        const double b = (box.high[i] - ray.origin[i]) / ray.direction[i];
        near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
    }
    return near <= far * (1 + 1e-9) + 1e-9;
}

namespace {

/// Returns a box around a triangle, a little wider than that.
Box box_of(const MeshData& mesh, std::size_t triangle) {
    Box box;
    for (const std::int32_t corner : mesh.triangles[triangle]) box.add(mesh.points[static_cast<std::size_t>(corner)]);
    const DVec3 margin = 1e-9 * (abs(box.low) + abs(box.high) + DVec3(1e-6));
    return {box.low - margin, box.high + margin};
}

/// Returns the triangles of a mesh whose boxes the ray meets; the ray is in the mesh's space.
Mesh met_by(const Mesh& mesh, const Ray<double>& ray, MeshTrees* trees) {
    const MeshData& all = *mesh.data;
    std::vector<std::size_t> met;
    if (trees)
        met = trees->met_by(ray, mesh.data);
    else
        for (std::size_t i = 0; i < all.triangles.size(); ++i)
            if (meets(box_of(all, i), ray)) met.push_back(i);
    MeshData some;
    for (const std::size_t i : met) {
        const auto first = static_cast<std::int32_t>(some.points.size());
        some.triangles.push_back({first, first + 1, first + 2});
        for (const std::int32_t corner : all.triangles[i])
            some.points.push_back(all.points[static_cast<std::size_t>(corner)]);
        if (all.corner_normals.empty()) continue;
        some.corner_normals.push_back({first, first + 1, first + 2});
        for (const std::int32_t corner : all.corner_normals[i])
            some.normals.push_back(all.normals[static_cast<std::size_t>(corner)]);
    }
    return {std::make_shared<const MeshData>(std::move(some)), ""};
}

/// Returns the pieces of a body whose crossings are listed; null if it has none.
template <class Kind>
auto pieces_of(const Kind& kind) {
    if constexpr (has_pieces<Kind>)
        return kind.data->pieces.data();
    else
        return static_cast<const void*>(nullptr);
}

/// Adds where a ray crosses the surface of a simple body.
void add_crossings(std::vector<RayHit>& all, const Primitive& leaf, int number, const glm::dmat4& to_world,
                   const Ray<double>& ray, double from, MeshTrees* trees) {
    const auto look = [&](const auto& kernel) {
        const auto add = [&](double t, double face) {
            if constexpr (requires { kernel.at(ray, t, face); })
                if (t > from && std::isfinite(t))
                    all.push_back({t, kernel.at(ray, t, face).normal, number, static_cast<int>(face)});
        };
        if constexpr (requires { kernel.crossings(ray, -1.); }) {
            const auto found = kernel.crossings(ray, -1.);
            if (!any(found.hit)) return;
            for (const double t : found.t) add(t, 0);
        } else if constexpr (requires { kernel.span(ray, -1.); }) {
            const auto span = kernel.span(ray, -1.);
            if (!any(span.hit)) return;
            add(span.near, span.near_face), add(span.far, span.far_face);
        }
    };
    std::visit(
        [&]<class Kind>(const Kind& kind) {
            const WorldTransform there{to_world, 0, DVec3(0), 1};
            if constexpr (std::is_same_v<Kind, Mesh>) {
                const glm::dmat4 back = glm::inverse(to_world);
                const Ray<double> own{transform_point(back, ray.origin), glm::dmat3(back) * ray.direction, {}};
                met_by(kind, own, trees).template emit<double>(there, look);
            } else if constexpr (lists_crossings<Kind> && !has_contours<Kind>) {
                kind.template emit<double>(there, [&](const auto& kernel) {
                    const auto* const pieces = pieces_of(kind);
                    kernel.each_crossing(pieces, BlobData::unlimited, ray, -1., true, [&](bool, double t, double) {
                        if (t > from && std::isfinite(t))
                            all.push_back({t, kernel.at(pieces, ray, t).normal, number, 0});
                    });
                });
            } else if constexpr (has_contours<Kind>) {
                kind.template emit<double>(there, [&](const auto& kernel) {
                    const ContourPiece<double>* const pieces = kind.data->pieces.data();
                    const auto piece_of = [&](double face) {
                        return pieces[std::max(static_cast<int>(face) - kernel.caps, 0)];
                    };
                    kernel.each_crossing(pieces, piece_of, ray, -1., true, [&](bool, double t, double face) {
                        if (t > from && std::isfinite(t))
                            all.push_back(
                                {t, kernel.at(piece_of(face), ray, t, face).normal, number, static_cast<int>(face)});
                    });
                });
            } else {
                kind.template emit<double>(there, look);
            }
        },
        leaf.shape);
}

}  // namespace

std::vector<std::size_t> MeshTrees::met_by(const Ray<double>& ray, const std::shared_ptr<const MeshData>& mesh) {
    auto known = trees.find(mesh);
    if (known == trees.end()) {
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < mesh->triangles.size(); ++i) boxes.push_back(box_of(*mesh, i));
        known = trees.emplace(mesh, BoxTree(std::move(boxes))).first;
    }
    std::vector<std::size_t> met;
    known->second.visit([&](const Box& box) { return meets(box, ray); }, [&](std::size_t i) { met.push_back(i); });
    std::ranges::sort(met);
    return met;
}

std::vector<RayHit> ray_hits(const Primitive& body, const Ray<double>& ray, double from, double to, MeshTrees* trees) {
    std::vector<RayHit> all, hits;
    bool simple = true;
    int leaves = 0;
    for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4& m) {
        simple &= &leaf == &body;
        add_crossings(all, leaf, leaves++, m, ray, from, trees);
    });
    std::ranges::sort(all, {}, &RayHit::t);
    const auto is_inside = [&](double t) { return contains(body, ray.origin + t * ray.direction); };
    for (std::size_t i = 0; i < all.size() && all[i].t < to; ++i) {
        RayHit hit = all[i];
        const double before = i > 0 ? all[i - 1].t : 0, behind = i + 1 < all.size() ? all[i + 1].t : 2 * hit.t + 1;
        if (!simple) {
            const bool leads_in = is_inside((hit.t + behind) / 2);
            if (is_inside((before + hit.t) / 2) == leads_in) continue;
            if (leads_in == (dot_product(hit.normal, ray.direction) > 0)) hit.normal = -hit.normal;
        }
        hits.push_back(hit);
    }
    return hits;
}

std::vector<BodyHit> bodies_along(const Scene& scene, const Ray<double>& ray) {
    std::vector<BodyHit> found;
    for (int body = 0; body < std::ssize(scene.primitives); ++body) {
        const Primitive& own = scene.primitives[body];
        if (!meets(world_bounds(own), ray)) continue;
        if (const std::vector<RayHit> hits = ray_hits(own, ray, 0); !hits.empty()) found.push_back({body, hits[0]});
    }
    std::ranges::stable_sort(found, {}, [](const BodyHit& at) { return at.hit.t; });
    return found;
}

}  // namespace strahl
