// Data that the stages of a generation share: its rays, hits and queues, and a pack of hits.
#pragma once
#include "num/lane_math.h"
#include "trace/kernel/kernel.h"
#include "trace/kernel/query.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns how many rays a hit makes at most: two for each of the normals of its layers.
template <class T>
int rays_of_hit(const World<T>& world) {
    return 2 * (1 + world.finishes.most_bends);
}
/// Returns how many of its rays a queue may hold before a further pack of hits.
template <class T>
int room_of_queue(const World<T>& world, int rays) {
    return rays - 2 * world.finishes.most_bends * static_cast<int>(widest_pack);
}

/// The inputs and outputs of shading one generation, by a kernel of policy P (see plain.h).
template <class S, class P>
struct Shading {
    using T = Element<S>;
    const World<T>& world;
    const Limits<T>& limits;
    const Generation<T>& rays;
    const HitList<T>& hits;  // of the open rays
    const PixelBatch<T>& batch;
    Generation<T>& next;
    RayQueue<T>& refracted;  // open rays, to follow the reflected ones in `next`
    Workspace<T>& workspace;
    Counts& counts;
    int depth;
    bool has_notes;  // hits have HitNotes: sights are noted, patterns filtered, or normals bent

    bool full() const {
        const int room = room_of_queue(world, batch.count > 1 ? limits.queue : batch_rays);
        return next.open.count + refracted.count > room || next.inside.count > room;
    }
};

/// Picks the values of up to `lanes` rays from arrays by ray; lanes left over get those of any ray.
template <class S>
struct LaneIndices {
    using T = Element<S>;
    int index[width<S>] = {};
    int lanes;
    bool consecutive = true;
    STRAHL_INLINE LaneIndices(int first, int left) : lanes(left < width<S> ? left : width<S>) { index[0] = first; }
    STRAHL_INLINE LaneIndices(const T* order, int left) : LaneIndices(static_cast<int>(order[0]), left) {
        for (int k = 1; k < width<S>; ++k) index[k] = static_cast<int>(order[k < lanes ? k : 0]);
        consecutive = lanes == width<S> && index[width<S> - 1] - index[0] == width<S> - 1;
    }
    STRAHL_INLINE S operator()(const T* values) const {
        return consecutive ? load_lanes<S>(values + index[0]) : gather<S>(values, index);
    }
};

/// A pack of hits.
template <class S>
struct Hit {
    Mask<S> active;
    Vec3<S> direction, position, normal;  // the normal is turned towards the incident ray
    Mask<S> outside;                      // lanes whose ray comes from the side that the surface faces
    S surface, body, pixel, weight, medium;
    const MaterialKernel<S>& material;
    bool uniform;  // all lanes have the same material
    int bin;
};

/// What rays carry besides weights, where FinishTables::carries; see RayQueue.
template <class S>
struct Carried {
    Vec3<S> tint;
    S level, mirrored;
};
/// Returns what rays have carried to hits.
template <class S, class P>
STRAHL_INLINE Carried<S> carried_by(const Shading<S, P>& shading, const RayQueue<Element<S>>& rays,
                                    const LaneIndices<S>& pick) {
    if (!shading.world.finishes.carries)
        return {splat<S>(Vec3<Element<S>>(1)), S(static_cast<Element<S>>(shading.depth)), S(0)};
    return {{pick(rays.tint[0]), pick(rays.tint[1]), pick(rays.tint[2])}, pick(rays.level), pick(rays.mirrored)};
}

/// Data of a pack of hits that only some worlds, batches and policies need.
template <class S, class P>
struct HitNotes {
    std::uint32_t words[width<S>];  // hashes of these hits for their samples' signatures; 0 if too faint
    Vec3<S> flat;                   // normals before they were bent
    Differentials<S> beside;        // on the surface; only set where patterns are filtered, as the next
    Vec3<S> turn[2];                // changes of the normal from there to those places
    RayCone<S> cone;                // set only where patterns are filtered roughly, like `bend`
    S bend;                         // by how much the normal turns over the cone's width
    Carried<S> carried;             // for the rays that go on; only set where rays carry something
    [[no_unique_address]] typename P::template OfHit<S> own;
};

/// The direction to a light, its distance, and the cosine of the direction with the normal.
template <class S>
struct WayToLight {
    Vec3<S> l;
    S distance, cosine;
};
/// A light as hits see it.
template <class S>
struct LightAt {
    WayToLight<S> way;               // the cosine without its sign
    Mask<S> faces, behind, inwards;  // the hits that it shines on; it is behind the bent normal, or behind the surface
    S strength;                      // the share of its light that arrives where nothing is in its way
};

/// Returns the normals of hits before they were bent.
template <class S, class P>
STRAHL_INLINE const Vec3<S>& flat_normal(const Shading<S, P>& shading, const Hit<S>& hit, const HitNotes<S, P>& notes) {
    return shading.world.patterns.bends ? notes.flat : hit.normal;
}

/// Calls visit(stack, body, lanes) once for all lanes with the same medium stack whose surfaces are of the same body.
template <class S, class Visit>
STRAHL_INLINE void each_stack_and_body(const World<Element<S>>& world, const S& stacks, const S& bodies, Mask<S> lanes,
                                       const Visit& visit) {
    while (any(lanes)) {
        const int k = first(lanes);
        const Element<S> stack = lane(stacks, k), body = lane(bodies, k);
        const Mask<S> same = lanes & (stacks == S(stack)) & (bodies == S(body));
        visit(static_cast<int>(stack), world.media.bodies[static_cast<int>(body)], same);
        lanes = lanes & !same;
    }
}

template <class S>
STRAHL_INLINE Vec3<S> reflect(const Hit<S>& hit) {
    return fma(S(-2) * dot(hit.direction, hit.normal), hit.normal, hit.direction);
}

/// Returns the largest channels of colours, whatever their signs.
template <class S>
STRAHL_INLINE S most_of(const Vec3<S>& color) {
    return max(abs(color.x), max(abs(color.y), abs(color.z)));
}

/// Adds light to the pixels of a pack's first lanes.
template <class S>
STRAHL_INLINE void add_light(const PixelBatch<Element<S>>& batch, const S& pixel, int lanes, const Vec3<S>& light) {
    add_lanes(batch.sums[0].rgb, pixel, lanes, light);
}

}  // namespace strahl::inline STRAHL_LEVEL
