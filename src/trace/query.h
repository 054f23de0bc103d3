// The two questions asked of geometry: which surface is nearest, and what light comes through.
#pragma once
#include "trace/traverse.h"

namespace strahl::inline STRAHL_LEVEL {

/// The nearest hit so far: t is infinite and the surface -1 at first. The key is that of the surface's place.
template <class S>
struct Nearest {
    S t{std::numeric_limits<Element<S>>::infinity()}, surface{-1}, key;
};

/// The ray of one lane in all lanes.
template <class S>
STRAHL_INLINE Ray<S> lane_of(const Ray<S>& ray, int k) {
    const auto pick = [k](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, k)), S(lane(v.y, k)), S(lane(v.z, k))); };
    return {pick(ray.origin), pick(ray.direction), S(lane(ray.source, k))};
}

/// Calls look(item) for the items of a group without a hierarchy, those of the set if there is a key for each, until
/// that returns true.
template <class Group, class Look>
STRAHL_INLINE void each_item(const Group& group, bool key_per_item, BodySet set, const Look& look) {
    if (!key_per_item) {
        for (int i = 0; i < group.count; ++i)
            if (look(i)) return;
    } else if (group.count > 0) {
        const BodySet own = ~BodySet(0) >> (most_item_keys - group.count);
        for (BodySet left = set >> group.first_key & own; left; left &= left - 1)
            if (look(std::countr_zero(left))) return;
    }
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
            best.t = S(lane(t, k)), best.surface = S(lane(item.surface, k));
            better = better & ((t < best.t) | ((t == best.t) & (item.surface < best.surface)));
        }
    }
}

/// Looks whether item i is nearer than what was met before.
template <class S, class Group>
STRAHL_INLINE void meet(const World<Element<S>>& world, const Group& group, int i, const Ray<S>& ray, Mask<S> mask,
                        Nearest<S>& best) {
    const auto& item = group.items[i];
    const S surface(item.surface);
    const Span<S> span = item.shape.span(ray, ray.source - surface);
    if (none(span.hit & mask)) return;
    S t;
    const Mask<S> better = mask & closer(span, surface, best, t);
    best.t = select(better, t, best.t);
    best.surface = select(better, surface, best.surface);
    best.key = select(better, S(static_cast<Element<S>>(group.key(i, world.key_per_item))), best.key);
}

/// The same for a group with a hierarchy. Not inline: of small worlds it would be a burden.
template <class S, class Group>
[[gnu::noinline]] Nearest<S> nearest_below(const World<Element<S>>& world, const Group& group, const Ray<S>& ray,
                                           Mask<S> active, Nearest<S> best) {
    using T = Element<S>;
    const Line<S> line = line_of(ray);
    const S before = best.surface;
    const auto look = [&](int first, int count, Mask<S> mask) {
        for (int i = first; i < first + count; ++i) meet(world, group, i, ray, mask, best);
        return false;
    };
    traverse<true>(group.nodes, line, active, best.t, look, [&](int k, int first, int count) {
        const Ray<S> one = lane_of(ray, k);
        Nearest<S> own{S(lane(best.t, k)), S(lane(best.surface, k)), S(0)};
        T limit = lane(best.t, k);
        const auto meet_items = [&](int item, int items) {
            nearest_alone(group, item, items, one, own);
            limit = lane(own.t, 0);
            return false;
        };
        if (count > 0)
            meet_items(first, count);
        else
            traverse_alone<true>(group.nodes, first, lane_of(line, k), limit, meet_items);
        best.t = with_lane(best.t, k, limit);
        best.surface = with_lane(best.surface, k, lane(own.surface, 0));
    });
    best.key = select(best.surface == before, best.key, S(static_cast<T>(group.first_key)));
    return best;
}

/// The nearest surfaces; where there is a key for each item, among the bodies of the set.
template <class S>
STRAHL_INLINE Nearest<S> nearest(const World<Element<S>>& world, const Ray<S>& ray, Mask<S> active, BodySet set) {
    Nearest<S> best;
    best.key = S(static_cast<Element<S>>(world.keys));
    world.groups.each([&](const auto& group) __attribute__((always_inline)) {
        if constexpr (std::remove_cvref_t<decltype(group)>::bounded)
            if (group.nodes) {
                best = nearest_below(world, group, ray, active, best);
                return;
            }
        each_item(
            group, world.key_per_item, set, [&](int i) __attribute__((always_inline)) {
                meet(world, group, i, ray, active, best);
                return false;
            });
    });
    return best;
}

/// Where shadow rays to a light start: on which body, by its key, and whether on its outside. Only where there is a
/// key for each item.
template <class S>
struct Start {
    int light, key;
    Mask<S> outside;
};

/// What is left of light, per channel, behind what has been looked at, and how far away it comes from: -1 if it is all
/// gone.
template <class S>
struct Passing {
    Vec3<S> share;
    S limit;
};

/// Does the item let light through?
template <class T, class Group>
STRAHL_INLINE bool clear(const World<T>& world, const Group& group, int i) {
    return world.transparent && world.materials[static_cast<int>(group.items[i].material)].refraction > 0;
}
template <class T, class Group>
STRAHL_INLINE const Vec3<T>& filter(const World<T>& world, const Group& group, int i) {
    return world.materials[static_cast<int>(group.items[i].material)].filter;
}

/// Takes from the light what item i takes. Is none left in any lane?
template <class S, class Group>
STRAHL_INLINE bool pass(const World<Element<S>>& world, const Group& group, int i, const Ray<S>& ray, const S& distance,
                        Mask<S> mask, Passing<S>& light) {
    const auto& item = group.items[i];
    const S one(1);
    const Span<S> span = item.shape.span(ray, ray.source - S(item.surface));
    const Mask<S> hit = span.hit & mask;
    if (none(hit)) return false;
    const Mask<S> enters = hit & (span.near > S(0)) & (span.near < distance);
    const Mask<S> leaves = hit & (span.far > S(0)) & (span.far < distance);
    if (clear(world, group, i)) {
        const Vec3<S> f = splat<S>(filter(world, group, i));
        for (int c = 0; c < 3; ++c)
            light.share[c] =
                min(light.share[c] * (select(enters, f[c], one) * select(leaves, f[c], one)), S(largest_gain));
        return false;
    }
    light.limit = select(enters | leaves, S(-1), light.limit);
    return all(light.limit < S(0));
}

/// The same for a group with a hierarchy.
template <class S, class Group>
[[gnu::noinline]] Passing<S> pass_below(const World<Element<S>>& world, const Group& group, const Ray<S>& ray,
                                        const S& distance, Passing<S> light) {
    using T = Element<S>;
    const Line<S> line = line_of(ray);
    const auto look = [&](int first, int count, Mask<S> mask) {
        for (int i = first; i < first + count; ++i)
            if (pass(world, group, i, ray, distance, mask, light)) return true;
        return false;
    };
    const auto alone = [&](int k, int first, int count) {
        using Item = typename Group::template ItemOf<S>;
        const Ray<S> lone = lane_of(ray, k);
        const S end(lane(distance, k));
        T limit = lane(light.limit, k);
        const auto blocks = [&](int first, int count) {
            for (int i = first; i < first + count; i += width<S>) {
                const Item item = load_items<Item, S>(group.columns, group.stride, i);
                const Span<S> span = item.shape.span(lone, lone.source - item.surface);
                const Mask<S> hit = span.hit & first_lanes<S>(first + count - i);
                const unsigned enters = bits(hit & (span.near > S(0)) & (span.near < end));
                const unsigned leaves = bits(hit & (span.far > S(0)) & (span.far < end));
                for (unsigned hits = enters | leaves; hits; hits &= hits - 1) {
                    const int n = std::countr_zero(hits);
                    if (!clear(world, group, i + n)) {
                        limit = T(-1);
                        return true;
                    }
                    const Vec3<T> f = filter(world, group, i + n);
                    for (int c = 0; c < 3; ++c) {
                        const T kept = (enters >> n & 1 ? f[c] : T(1)) * (leaves >> n & 1 ? f[c] : T(1));
                        light.share[c] =
                            with_lane(light.share[c], k, min(lane(light.share[c], k) * kept, T(largest_gain)));
                    }
                }
            }
            return false;
        };
        if (count > 0)
            blocks(first, count);
        else if (world.transparent)
            traverse_alone<false>(group.nodes, first, lane_of(line, k), limit, blocks);
        else
            traverse_alone<true>(group.nodes, first, lane_of(line, k), limit, blocks);
        light.limit = with_lane(light.limit, k, limit);
    };
    if (world.transparent)  // products must not depend on the order in which neighbours want to go
        traverse<false>(group.nodes, line, light.limit > S(0), light.limit, look, alone);
    else
        traverse<true>(group.nodes, line, light.limit > S(0), light.limit, look, alone);
    return light;
}

/// The share of light, per channel, that comes from `distance` away along the ray: opaque bodies between take all of
/// it, transparent ones Kt Of at each surface crossed, in the order of the items.
template <class S>
[[gnu::noinline]] Vec3<S> visibility(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                     Mask<S> active, const Start<S>& start) {
    const S one(1);
    Passing<S> light{{one, one, one}, select(active, distance, S(-1))};
    const int row = start.light * world.keys;
    bool dark = false;
    world.groups.each([&](const auto& group) __attribute__((always_inline)) {
        if (dark) return;
        if constexpr (std::remove_cvref_t<decltype(group)>::bounded)
            if (group.nodes) {
                light = pass_below(world, group, ray, distance, light);
                dark = all(light.limit < S(0));
                return;
            }
        const BodySet set = world.key_per_item ? world.occluders[row + start.key] : 0;
        each_item(
            group, world.key_per_item, set, [&](int i) __attribute__((always_inline)) {
                Mask<S> mask = active;
                if (world.key_per_item) {
                    const int key = group.first_key + i;
                    const Cone<Element<S>>& cone = world.cones[row + key];
                    mask = mask & (dot(splat<S>(cone.axis), ray.direction) <= S(-cone.cosine)) &
                           (distance > S(cone.distance));
                    if (key == start.key) mask = mask & !start.outside;
                    if (none(mask)) return false;
                }
                return dark = pass(world, group, i, ray, distance, mask, light);
            });
    });
    return select(light.limit < S(0), Vec3<S>(S(0), S(0), S(0)), light.share);
}

}  // namespace strahl::inline STRAHL_LEVEL
