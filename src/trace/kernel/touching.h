// Rays that start where two bodies touch.
#pragma once
#include <algorithm>

#include "trace/kernel/kernel.h"
#include "trace/kernel/query.h"
#include "trace/kernel/surface_at.h"
#include "trace/patterns/triangle_of.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns a pack of the rays of a queue, from number `i` on.
template <class S>
STRAHL_INLINE Ray<S> rays_at(const RayQueue<Element<S>>& rays, int i) {
    const auto at = [i](const Element<S>* values) { return load_lanes<S>(values + i); };
    return {{at(rays.origin.x), at(rays.origin.y), at(rays.origin.z)},
            {at(rays.direction.x), at(rays.direction.y), at(rays.direction.z)},
            at(rays.source)};
}

/// Moves the starts of a pack of rays of a queue, from number `i` on.
template <class S>
STRAHL_INLINE void store_starts(const RayQueue<Element<S>>& rays, int i, const Ray<S>& ray) {
    for (int c = 0; c < 3; ++c) store_lanes(rays.origin[c] + i, ray.origin[c]);
    store_lanes(rays.source + i, ray.source);
}

/// Returns up to which distance from their starts crossings may be rounding errors.
template <class S>
STRAHL_INLINE S touching_distance(const Vec3<S>& origin) {
    return S(16 * std::numeric_limits<Element<S>>::epsilon()) * (abs(origin.x) + abs(origin.y) + abs(origin.z));
}

/// Returns the first surface of the composite that a surface is of, else `first_of_item`.
template <class T>
int first_of_body(const World<T>& world, int surface, int first_of_item) {
    const CompositeInfo* const list = world.composites.list;
    const int count = world.groups.template get<CompositeForm>().count;
    const CompositeInfo* const next = std::upper_bound(
        list, list + count, surface, [](int own, const CompositeInfo& composite) { return own < composite.surface; });
    return next != list && surface < next[-1].surface + next[-1].surfaces ? next[-1].surface : first_of_item;
}
/// Returns true if a ray passes a surface that it starts on besides its source: if that is of another body, which lets
/// light through or which the ray leaves. Rays get into opaque bodies only with the eye. Triangles count as one body.
template <class S>
bool passes(const World<Element<S>>& world, const Ray<S>& ray, const Nearest<S>& hit, int k) {
    const auto at = [&](int surface, SurfaceHit<S>& point) {
        const Element<S> surfaces[1]{static_cast<Element<S>>(surface)};
        alignas(64) Element<S> none[width<S>] = {};
        int materials[width<S>];
        const int form = world.sort_bins[world.references[surface].bin].form;
        point =
            surfaces_at(world, form, surfaces, LaneIndices<S>(none, 1), lane_of(ray, k), S(lane(hit.t, k)), materials);
        return materials[0];
    };
    const int source = static_cast<int>(lane(ray.source, k)), surface = static_cast<int>(lane(hit.surface, k));
    SurfaceHit<S> from, to;
    at(source, from);
    const int material = at(surface, to);
    const auto body = [&](int own, const SurfaceHit<S>& point) {
        return first_of_body(world, own, static_cast<int>(lane(point.body, 0)));
    };
    const auto flat = [&](int own) { return triangle_of(world, own) || placed_mesh_of(world, own); };
    return body(source, from) != body(surface, to) && !(flat(source) && flat(surface)) &&
           (passes_light(world, material) || lane(dot(ray.direction, to.point.normal), k) > 0);
}

/// Lets rays pass surfaces that they start on besides their source, those of bodies that touch or overlap there: which
/// of these a ray starts before and which behind is left to rounding, so that without this it could meet two in turn
/// until its generations end. The rays of the queue, from number `i` on, then start beyond these surfaces, and `hit`
/// is what they meet there. POV-Ray passes all that is nearer than 1e-4.
template <class S, class T>
[[gnu::noinline]] void pass_touching(const World<T>& world, const RayQueue<T>& rays, int i, Mask<S> lanes,
                                     Nearest<S>& hit) {
    Ray<S> ray = rays_at<S>(rays, i);
    const S step = S(2) * touching_distance(ray.origin);
    for (int tries = 0; tries < 4; ++tries) {
        alignas(64) T other[width<S>] = {};
        lanes = lanes & (hit.t <= step) & (ray.source >= S(0));
        for (unsigned left = bits(lanes); left; left &= left - 1) {
            const int k = std::countr_zero(left);
            other[k] = passes(world, ray, hit, k);
        }
        lanes = lanes & (load_lanes<S>(other) > S(0));
        if (none(lanes)) return;
        pass_over(world, step, lanes, S(hit.surface), ray, hit);
        store_starts(rays, i, ray);
    }
}

/// Returns false if rays go on straight through a material as if it were not there: that of what clips a body, or of
/// bodies that not all rays see.
template <class T>
bool is_there(const World<T>& world, int material) {
    if (!world.finishes.list) return true;
    const FinishKernel<T>& own = world.finishes.list[material];
    const MaterialKernel<T>& kernel = world.materials[material];
    const bool nothing =
        own.ior == 1 && kernel.refraction == 1 && kernel.filter == Vec3<T>(1) && kernel.reflection == 0;
    return own.seen && own.mirrored && !nothing;
}

/// Lets rays pass over what is too near to their starts on other surfaces: they then start behind it, and `hit` is what
/// they meet there. The rays are those of the queue from number `i` on, in the lanes of `near`.
template <class S, class T>
[[gnu::noinline]] void pass_near(const World<T>& world, const RayQueue<T>& rays, int i, Mask<S> near, Nearest<S>& hit) {
    Ray<S> ray = rays_at<S>(rays, i);
    alignas(64) T starts[width<S>] = {};
    for (unsigned left = bits(near); left; left &= left - 1) {
        const int k = std::countr_zero(left), source = static_cast<int>(lane(ray.source, k));
        starts[k] = source < 0 || is_there(world, material_of(world, source));
    }
    near = near & (load_lanes<S>(starts) > S(0));
    if (none(near)) return;
    pass_over(world, S(world.passed_over), near, S(-1), ray, hit);
    store_starts(rays, i, ray);
}

}  // namespace strahl::inline STRAHL_LEVEL
