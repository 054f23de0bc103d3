// Finds the bodies that a light buffer has between points and its light.
#pragma once
#include "num/memory.h"
#include "trace/lights/light_buffer.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the numbers of the cells of points, which are relative to the light; 0 where no body can be in the way.
template <class S>
STRAHL_INLINE S cells_of(const LightBuffer<Element<S>>& buffer, bool parallel, const Vec3<S>& points, Mask<S> left) {
    S cells(0);
    for (int i = 0; i < buffer.face_count && any(left); ++i) {
        const BufferFace<Element<S>>& face = buffer.faces[i];
        S u = dot(splat<S>(face.right), points), v = dot(splat<S>(face.up), points);
        Mask<S> own = left;
        if (!parallel) {
            const S z = dot(splat<S>(face.axis), points), inverse = S(1) / z;
            u = u * inverse, v = v * inverse;
            own = own & (z > S(0)) & (abs(u) <= S(face.limit)) & (abs(v) <= S(face.limit));
        }
        left = left & !own;
        const S column = floor((u - S(face.low_u)) * S(face.per_u));
        const S row = floor((v - S(face.low_v)) * S(face.per_v));
        own = own & (column >= S(0)) & (column < S(face.columns)) & (row >= S(0)) & (row < S(face.rows));
        cells = select(own, fma(row, S(face.columns), column) + S(face.first), cells);
    }
    return cells;
}

/// Walks through the candidates between points and a light that has a buffer, each lane those of its own cell, the
/// nearest to the light first. Calls test(form, lanes, items) for candidates of one form, an item in each of these
/// lanes; it returns the lanes that are dark, which need no more. `distance` is that from the points to the light.
template <class S, class Test>
STRAHL_INLINE void walk_candidates(const World<Element<S>>& world, int light, const Vec3<S>& points, const S& distance,
                                   Mask<S> lanes, const Test& test) {
    const LightBuffer<Element<S>>& buffer = world.light_buffers[light];
    const LightKernel<Element<S>>& from = world.lights[light];
    const bool parallel = from.finite == 0;
    const Vec3<S> position = splat<S>(from.position);
    const S depth = parallel ? -dot(position, points) : distance;
    S at = cells_of(buffer, parallel, parallel ? points : points - position, lanes);
    Mask<S> left = lanes & (at > S(0));
    while (any(left)) {
        int places[width<S>], items[width<S>];
        store_whole(places, at);
        const auto candidate = gather_floats<Candidate, S>(buffer.candidates, places);
        left = left & (candidate.near < depth);
        if (none(left)) break;
        const S form(lane(candidate.form, first(left)));
        const Mask<S> now = left & (candidate.form == form);
        store_whole(items, select(now, candidate.item, S(0)));
        left = left & !test(static_cast<int>(lane(form, 0)), now, items);
        at = select(now, candidate.next, at);
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
