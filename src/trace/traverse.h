// The two questions asked of geometry: which surface is nearest, and what light comes through.
#pragma once
#include "num/memory.h"
#include "trace/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Visits the leaves whose boxes the lanes' rays cross before `limit`, a lane's mask saying if its own ray does.
/// leaf(first, count, mask) returns true to stop. Boxes are grown when built and the far ends here (T. Ize, "Robust BVH
/// Ray Traversal", JCGT 2013), and reciprocals are kept finite, so that rounding never hides a hit and what a lane
/// finds does not depend on its neighbours. Front to back by the first lane if `sorted`, else always in the same order.
template <bool sorted, class S, class Leaf>
STRAHL_INLINE void traverse(const Node<Element<S>>* nodes, const Ray<S>& ray, Mask<S> active, const S& limit,
                            const Leaf& leaf) {
    using T = Element<S>;
    constexpr T tiny = T(1) / (T(1) * (std::uint64_t(1) << 60));
    const auto reciprocal = [](S d) { return S(1) / select(abs(d) < S(tiny), select(d < S(0), S(-tiny), S(tiny)), d); };
    const Vec3<S> inverse{reciprocal(ray.direction.x), reciprocal(ray.direction.y), reciprocal(ray.direction.z)};
    const S grow(1 + 4 * std::numeric_limits<T>::epsilon());
    bool negative[3] = {};
    if constexpr (sorted) {
        const int lead = first(active);
        for (int i = 0; i < 3; ++i) negative[i] = lane(inverse[i], lead) < 0;
    }
    int stack[64], depth = 0, index = 0;
    while (true) {
        const Node<T>& node = nodes[index];
        S near(0), far = limit;
        for (int i = 0; i < 3; ++i) {
            const S a = (S(node.low[i]) - ray.origin[i]) * inverse[i];
            const S b = (S(node.high[i]) - ray.origin[i]) * inverse[i];
            near = max(near, min(a, b));
            far = min(far, max(a, b) * grow);
        }
        const Mask<S> mask = active & (near <= far);
        if (any(mask)) {
            if (node.count == 0) {
                const int swap = sorted && negative[node.axis];
                stack[depth++] = node.first + 1 - swap;
                index = node.first + swap;
                continue;
            }
            if (leaf(node.first, node.count, mask)) return;
        }
        if (depth == 0) return;
        index = stack[--depth];
    }
}

/// The nearest hit so far: t is infinite and the surface -1 at first.
template <class S>
struct Nearest {
    S t{std::numeric_limits<Element<S>>::infinity()}, surface{-1};
};

/// Of equally near surfaces the one declared first is taken.
template <class S>
STRAHL_INLINE Nearest<S> nearest(const World<Element<S>>& world, const Ray<S>& ray, Mask<S> active) {
    Nearest<S> best;
    world.groups.each([&](const auto& group) {
        const auto look = [&](int first, int count, Mask<S> mask) {
            for (int i = first; i < first + count; ++i) {
                const auto& item = group.items[i];
                const S surface(item.surface);
                const Span<S> span = item.shape.span(ray, ray.source - surface);
                if (none(span.hit & mask)) continue;
                const S t = select(span.near > S(0), span.near, span.far);
                const Mask<S> closer =
                    span.hit & mask & (t > S(0)) & ((t < best.t) | ((t == best.t) & (surface < best.surface)));
                best.t = select(closer, t, best.t);
                best.surface = select(closer, surface, best.surface);
            }
            return false;
        };
        if (group.nodes)
            traverse<true>(group.nodes, ray, active, best.t, look);
        else
            look(0, group.count, active);
    });
    return best;
}

/// The share of light, per channel, that comes from `distance` away along the ray: opaque bodies between take all of
/// it, transparent ones Kt Of at each surface crossed.
template <class S>
STRAHL_INLINE Vec3<S> visibility(const World<Element<S>>& world, const Ray<S>& ray, S distance, Mask<S> active) {
    Vec3<S> share(S(1), S(1), S(1));
    Mask<S> dark = !active;
    bool done = false;
    world.groups.each([&](const auto& group) {
        const auto look = [&](int first, int count, Mask<S> mask) {
            for (int i = first; i < first + count; ++i) {
                const auto& item = group.items[i];
                const Span<S> span = item.shape.span(ray, ray.source - S(item.surface));
                if (none(span.hit & mask)) continue;
                const Mask<S> hit = span.hit & mask;
                const Mask<S> enters = hit & (span.near > S(0)) & (span.near < distance);
                const Mask<S> leaves = hit & (span.far > S(0)) & (span.far < distance);
                if (world.transparent && world.materials[static_cast<int>(item.material)].refraction > 0) {
                    const Vec3<S> filter = splat<S>(world.materials[static_cast<int>(item.material)].filter);
                    const S one(1);
                    for (int c = 0; c < 3; ++c)
                        share[c] *= select(enters, filter[c], one) * select(leaves, filter[c], one);
                } else {
                    dark = dark | enters | leaves;
                    if (all(dark)) return done = true;
                }
            }
            return false;
        };
        if (done) return;
        if (!group.nodes)
            look(0, group.count, active);
        else if (world.transparent)  // products must not depend on the order in which neighbours want to go
            traverse<false>(group.nodes, ray, active, distance, look);
        else
            traverse<true>(group.nodes, ray, active, distance, look);
    });
    return select(dark, Vec3<S>(S(0), S(0), S(0)), share);
}

}  // namespace strahl::inline STRAHL_LEVEL
