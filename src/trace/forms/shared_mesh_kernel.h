// Ray queries on meshes that worlds share: rays are turned into the mesh's coordinates, and ask its own world there.
#pragma once
#include <bit>

#include "trace/forms/form_kernel.h"
#include "trace/hierarchy/traverse.h"

namespace strahl::inline STRAHL_LEVEL {

template <class S>
struct FormFunctions<SharedMeshForm, S> : SingleByPack<FormFunctions<SharedMeshForm, S>, S> {
    using T = Element<S>;
    static void intersect(const World<T>& world, int first, int count, const Ray<S>& ray, Mask<S> mask,
                          Nearest<S>& best) {
        for (int i = first; i < first + count; ++i) {
            const PlacedMesh<T>& own = placed_mesh(world, i);
            const Ray<S> moved = in_mesh(own, ray);
            const S before(own.surface);
            Nearest<S> found{best.t, best.surface - before, best.bin};
            const auto look = [&](const Leaf& leaf, Mask<S> lanes) {
                calls<S>(leaf.form()).intersect(own.mesh, leaf.first, leaf.count(), moved, lanes, found);
                return false;
            };
            const auto single = [&](int k, const Leaf& from, const auto& line) {
                SingleRay<S> one{lane_of(moved, k), lane(found.t, k), lane(found.surface, k)};
                each_leaf<true>(own, from, line, one.t, [&](const Leaf& leaf) {
                    calls<S>(leaf.form()).intersect_single(own.mesh, leaf.first, leaf.count(), one);
                    return false;
                });
                found.t = with_lane(found.t, k, one.t), found.surface = with_lane(found.surface, k, one.surface);
            };
            const TraversalRay<S> line = traversal_ray(moved);
            traverse<true>(own.mesh.nodes, line, mask, found.t, look,
                           [&](int k, const Leaf& from) { single(k, from, lane_of(line, k)); });
            best.t = found.t, best.surface = found.surface + before;
        }
    }
    static bool occlude(const World<T>& world, int first, int count, const Ray<S>& ray, const S& distance, Mask<S> mask,
                        Transmission<S>& light) {
        for (int i = first; i < first + count; ++i) {
            const PlacedMesh<T>& own = placed_mesh(world, i);
            const Ray<S> moved = in_mesh(own, ray);
            S limit;  // up to where rays still have to be looked at
            const auto set_limit = [&] { limit = select(light.limit < S(0), S(-1), distance); };
            const auto look = [&](const Leaf& leaf, Mask<S> lanes) {
                const bool dark =
                    calls<S>(leaf.form()).occlude(own.mesh, leaf.first, leaf.count(), moved, distance, lanes, light);
                set_limit();
                return dark;
            };
            const auto single = [&](int k, const Leaf& from, const auto& line) {
                SingleRay<S> one{.ray = lane_of(moved, k), .t = lane(distance, k), .notes = light.notes, .lane = k};
                each_leaf<false>(own, from, line, one.t, [&](const Leaf& leaf) {
                    if (!calls<S>(leaf.form()).occlude_single(own.mesh, leaf.first, leaf.count(), one)) return false;
                    light.limit = with_lane(light.limit, k, T(-1));
                    return true;
                });
                set_limit();
            };
            const TraversalRay<S> line = traversal_ray(moved);
            set_limit();
            traverse<false>(own.mesh.nodes, line, mask, limit, look,
                            [&](int k, const Leaf& from) { single(k, from, lane_of(line, k)); });
            if (all(light.limit < S(0))) return true;
        }
        return false;
    }
    /// Does what it does for other forms; `faces` are the numbers of triangles.
    static void surfaces_at(const World<T>& world, const int* items, const Ray<S>& ray, const S& t, const S& faces,
                            SurfaceHit<S>& hit, int* materials) {
        const auto& group = world.groups.template get<SharedMeshForm>();
        for (int k = 0; k < width<S>; ++k) materials[k] = static_cast<int>(group.items[items[k]].material);
        for (unsigned left = bits(all_lanes<S>()); left;) {
            const int any = std::countr_zero(left);
            unsigned lanes = 0;
            int triangles[width<S>];
            const PlacedMesh<T>& own = placed_mesh(world, items[any]);
            for (int k = 0; k < width<S>; ++k) {
                const bool alike = items[k] == items[any];
                lanes |= unsigned(alike) << k;
                triangles[k] = own.mesh.references[static_cast<int>(lane(faces, alike ? k : any))].item;
            }
            left &= ~lanes;
            SurfaceHit<S> found;
            int unused[width<S>];
            const int form = own.mesh.sort_bins[own.mesh.references[static_cast<int>(lane(faces, any))].bin].form;
            calls<S>(form).surfaces_at(own.mesh, triangles, in_mesh(own, ray), t, S(-1), found, unused);
            const Vec3<S> normal = own.normals.turn(found.point.normal);
            const Mask<S> mask = mask_of<S>(lanes);
            hit.point = {select(mask, own.out.point(found.point.position), hit.point.position),
                         select(mask, scale(S(1) / sqrt(dot(normal, normal)), normal), hit.point.normal)};
            hit.body = select(mask, S(own.surface), hit.body);
        }
        hit.surface = hit.body + faces;
    }

  private:
    static Ray<S> in_mesh(const PlacedMesh<T>& own, const Ray<S>& ray) {
        const S face = ray.source - S(own.surface);
        return {own.in.point(ray.origin), own.in.turn(ray.direction),
                select((face >= S(0)) & (face < S(static_cast<T>(own.surfaces))), face, S(-1))};
    }
    /// Visits what is left of the mesh's hierarchy from a leaf or a node on.
    template <bool sorted, class Visit>
    STRAHL_INLINE static void each_leaf(const PlacedMesh<T>& own, const Leaf& from, const auto& line, const T& limit,
                                        const Visit& visit) {
        if (from.code != 0)
            visit(from);
        else
            traverse_single<sorted>(own.mesh.nodes, from.first, line, limit, visit);
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
