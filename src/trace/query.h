// The two questions asked of geometry: which surface is nearest, and what light comes through.
#pragma once
#include "trace/traverse.h"

namespace strahl::inline STRAHL_LEVEL {

/// The nearest hit so far: t is infinite and the surface -1 at first.
template <class S>
struct Nearest {
    S t{std::numeric_limits<Element<S>>::infinity()}, surface{-1};
};

/// The ray of one lane in all lanes.
template <class S>
STRAHL_INLINE Ray<S> lane_of(const Ray<S>& ray, int k) {
    const auto pick = [k](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, k)), S(lane(v.y, k)), S(lane(v.z, k))); };
    return {pick(ray.origin), pick(ray.direction), S(lane(ray.source, k))};
}

/// Where a surface is met, and whether it is nearer than what was met before; of equally near ones the first declared.
template <class S>
STRAHL_INLINE Mask<S> closer(const Span<S>& span, const S& surface, const Nearest<S>& best, S& t) {
    t = select(span.near > S(0), span.near, span.far);
    return span.hit & (t > S(0)) & ((t < best.t) | ((t == best.t) & (surface < best.surface)));
}

/// One ray and items [first, first + count), which are looked at side by side.
template <class S, class Group>
STRAHL_INLINE void nearest_alone(const Group& group, int first, int count, const Ray<S>& ray, Nearest<S>& best) {
    using Item = typename Group::template ItemOf<S>;
    for (int i = first; i < first + count; i += width<S>) {
        const Item item = load_items<Item, S>(group.columns, group.stride, i);
        S t;
        const Span<S> span = item.shape.span(ray, ray.source - item.surface);
        Mask<S> better = closer(span, item.surface, best, t) & first_lanes<S>(first + count - i);
        while (any(better)) {
            const int k = strahl::first(better);
            best = {S(lane(t, k)), S(lane(item.surface, k))};
            better = better & ((t < best.t) | ((t == best.t) & (item.surface < best.surface)));
        }
    }
}

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
                S t;
                const Mask<S> better = mask & closer(span, surface, best, t);
                best.t = select(better, t, best.t);
                best.surface = select(better, surface, best.surface);
            }
            return false;
        };
        if (!group.nodes) {
            look(0, group.count, active);
            return;
        }
        const Line<S> line = line_of(ray);
        traverse<true>(group.nodes, line, active, best.t, look, [&](int k, int first, int count) {
            const Ray<S> one = lane_of(ray, k);
            Nearest<S> own{S(lane(best.t, k)), S(lane(best.surface, k))};
            Element<S> limit = lane(best.t, k);
            const auto meet = [&](int item, int items) {
                nearest_alone(group, item, items, one, own);
                limit = lane(own.t, 0);
                return false;
            };
            if (count > 0)
                meet(first, count);
            else
                traverse_alone<true>(group.nodes, first, lane_of(line, k), limit, meet);
            best.t = with_lane(best.t, k, limit);
            best.surface = with_lane(best.surface, k, lane(own.surface, 0));
        });
    });
    return best;
}

/// The share of light, per channel, that comes from `distance` away along the ray: opaque bodies between take all of
/// it, transparent ones Kt Of at each surface crossed, in the order of the items.
template <class S>
STRAHL_INLINE Vec3<S> visibility(const World<Element<S>>& world, const Ray<S>& ray, const S& distance, Mask<S> active) {
    using T = Element<S>;
    const S one(1);
    Vec3<S> share(one, one, one);
    S limit = select(active, distance, S(-1));  // of dark rays -1
    world.groups.each([&](const auto& group) {
        const auto clear = [&](int item) {
            return world.transparent && world.materials[static_cast<int>(group.items[item].material)].refraction > 0;
        };
        const auto filter = [&](int item) {
            return world.materials[static_cast<int>(group.items[item].material)].filter;
        };
        const auto look = [&](int first, int count, Mask<S> mask) {
            for (int i = first; i < first + count; ++i) {
                const auto& item = group.items[i];
                const Span<S> span = item.shape.span(ray, ray.source - S(item.surface));
                if (none(span.hit & mask)) continue;
                const Mask<S> hit = span.hit & mask;
                const Mask<S> enters = hit & (span.near > S(0)) & (span.near < distance);
                const Mask<S> leaves = hit & (span.far > S(0)) & (span.far < distance);
                if (clear(i)) {
                    const Vec3<T> f = filter(i);
                    for (int c = 0; c < 3; ++c)
                        share[c] = min(share[c] * (select(enters, S(f[c]), one) * select(leaves, S(f[c]), one)),
                                       S(largest_gain));
                } else {
                    limit = select(enters | leaves, S(-1), limit);
                    if (all(limit < S(0))) return true;
                }
            }
            return false;
        };
        if (all(limit < S(0))) return;
        if (!group.nodes) {
            look(0, group.count, active);
            return;
        }
        const auto alone = [&](int k, int first, int count, const Line<S>& lines) {
            using Item = typename std::remove_cvref_t<decltype(group)>::template ItemOf<S>;
            const Ray<S> lone = lane_of(ray, k);
            const S end(lane(distance, k));
            T own_limit = lane(limit, k);
            const auto blocks = [&](int first, int count) {
                for (int i = first; i < first + count; i += width<S>) {
                    const Item item = load_items<Item, S>(group.columns, group.stride, i);
                    const Span<S> span = item.shape.span(lone, lone.source - item.surface);
                    const Mask<S> hit = span.hit & first_lanes<S>(first + count - i);
                    const unsigned enters = bits(hit & (span.near > S(0)) & (span.near < end));
                    const unsigned leaves = bits(hit & (span.far > S(0)) & (span.far < end));
                    for (unsigned hits = enters | leaves; hits; hits &= hits - 1) {
                        const int n = std::countr_zero(hits);
                        if (!clear(i + n)) {
                            own_limit = T(-1);
                            return true;
                        }
                        const Vec3<T> f = filter(i + n);
                        for (int c = 0; c < 3; ++c)
                            share[c] = with_lane(share[c], k,
                                                 min(lane(share[c], k) * ((enters >> n & 1 ? f[c] : T(1)) *
                                                                          (leaves >> n & 1 ? f[c] : T(1))),
                                                     T(largest_gain)));
                    }
                }
                return false;
            };
            if (count > 0)
                blocks(first, count);
            else if (world.transparent)
                traverse_alone<false>(group.nodes, first, lane_of(lines, k), own_limit, blocks);
            else
                traverse_alone<true>(group.nodes, first, lane_of(lines, k), own_limit, blocks);
            limit = with_lane(limit, k, own_limit);
        };
        const Line<S> line = line_of(ray);
        const auto go_alone = [&](int k, int first, int count) { alone(k, first, count, line); };
        if (world.transparent)  // products must not depend on the order in which neighbours want to go
            traverse<false>(group.nodes, line, active & (limit > S(0)), limit, look, go_alone);
        else
            traverse<true>(group.nodes, line, active & (limit > S(0)), limit, look, go_alone);
    });
    return select(limit < S(0), Vec3<S>(S(0), S(0), S(0)), share);
}

}  // namespace strahl::inline STRAHL_LEVEL
