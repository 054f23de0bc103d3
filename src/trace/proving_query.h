// The two questions asked of geometry, as exact arithmetic would answer them: certainly so, or it can't be told.
#pragma once
#include "trace/known_forms.h"
#include "trace/pattern_bounds.h"
#include "trace/query.h"

namespace strahl::inline STRAHL_LEVEL {

/// What a ray may meet first. No crossing is before `low`, none but one before `second`, and some is certain to be
/// before `high`.
template <class S>
struct Candidates {
    static constexpr Element<S> inf = std::numeric_limits<Element<S>>::infinity();
    S t{inf}, surface{-1}, bin, low{inf}, second{inf}, high{inf};

    STRAHL_INLINE void add(Mask<S> lanes, const S& from, const S& to, const S& own_t, const S& own_surface,
                           const S& own_bin) {
        const S least = select(lanes, max(S(0), from), S(inf));
        const Mask<S> first = least < low;
        second = min(second, max(low, least));
        low = min(low, least), high = select(lanes, min(high, to), high);
        t = select(first, own_t, t), surface = select(first, own_surface, surface), bin = select(first, own_bin, bin);
    }
    /// A body of which nothing is known but that it may be in the way, from `from` on.
    STRAHL_INLINE void add_unknown(Mask<S> lanes, const S& from) { add(lanes, from, S(inf), S(inf), S(-1), S(-1)); }
    STRAHL_INLINE Mask<S> hits() const { return second > high; }
    STRAHL_INLINE Mask<S> misses() const { return low == S(inf); }
};

/// A ray as the proving queries see it.
template <class S>
struct DoubtfulRay {
    Ray<S> ray;
    Doubt<S> doubt;
};
template <class S>
STRAHL_INLINE DoubtfulRay<S> lane_of(const DoubtfulRay<S>& own, int k) {
    return {lane_of(own.ray, k), {S(lane(own.doubt.away, k)), S(lane(own.doubt.turn, k))}};
}

/// Boxes are as far off as bodies, and as the exact ray is from the computed one anywhere in the hierarchy.
template <class S>
STRAHL_INLINE RoundedTraversalRay<S> traversal_ray(const DoubtfulRay<S>& own, const Slack<Element<S>>& slack) {
    const S way = norm1(own.ray.origin) + S(2 * slack.reach);
    const S off = own.doubt.away + (own.doubt.turn + S(8 * unit_error<S>)) * way + S(4 * slack.culled * slack.reach);
    const Vec3<S> offs(off, off, off);
    return {own.ray.origin - offs, own.ray.origin + offs, traversal_ray(own.ray).inverse};
}

template <class S, class Item, class Bin>
[[gnu::noinline]] void add_item(const Item& item, const DoubtfulRay<S>& own, Mask<S> mask,
                                const Slack<Element<S>>& slack, const Bin& bin, Candidates<S>& found) {
    const S surface(item.surface);
    const SpanBounds<S> span = span_bounds(item.shape, own.ray, own.doubt, S(own.ray.source - surface), slack);
    mask = mask & span.maybe;
    if (none(mask)) return;
    constexpr auto inf = Candidates<S>::inf;
    const auto crossed = crossings_of(item, own.ray);
    const Mask<S> enters = span.sure & (span.near_low > S(0)), leaves = span.sure & (span.far_low > S(0));
    found.add(mask & !(span.near_high <= S(0)), span.near_low, select(enters, span.near_high, S(inf)), crossed.near,
              surface, S(bin));
    found.add(mask & !(span.far_high <= S(0)) & !enters, span.far_low, select(leaves, span.far_high, S(inf)),
              crossed.far, surface, S(bin));
}

/// What may be met in the hierarchy. Not inline: of small worlds its stack would be a burden.
template <class S>
[[gnu::noinline]] void candidates_in_hierarchy(const World<Element<S>>& world, const DoubtfulRay<S>& own, Mask<S> active,
                                           const Slack<Element<S>>& slack, Candidates<S>& found) {
    using T = Element<S>;
    const auto line = traversal_ray(own, slack);
    const auto look = [&](const Leaf& leaf, Mask<S> mask) {
        const bool known = if_known(world, leaf.form(), [&](const auto& group) {
            for (int i = leaf.first; i < leaf.first + leaf.count(); ++i)
                add_item(group.items[i], own, mask, slack, T(-1), found);
        });
        if (!known) found.add_unknown(mask, S(0));
        return false;
    };
    traverse<true>(world.nodes, line, active, found.high, look, [&](int k, const Leaf& from) {
        const DoubtfulRay<S> single = lane_of(own, k);
        T limit = lane(found.high, k);
        Candidates<S> all;  // of this ray alone: one in each lane
        const auto look_single = [&](const Leaf& leaf) {
            const bool known = if_known(world, leaf.form(), [&](const auto& group) {
                for (int i = leaf.first; i < leaf.first + leaf.count(); i += width<S>)
                    add_item(load_of_leaf<S>(group, leaf.first, leaf.count(), i), single,
                             first_lanes<S>(leaf.first + leaf.count() - i), slack, T(-1), all);
            });
            if (!known) all.add_unknown(first_lanes<S>(1), S(0));
            limit = min(limit, least(all.high));
            return false;
        };
        if (from.code != 0)
            look_single(from);
        else
            traverse_single<true>(world.nodes, from.first, lane_of(line, k), limit, look_single);
        const Mask<S> own_lane = first_lanes<S>(k + 1) & !first_lanes<S>(k);
        for (int i = 0; i < width<S>; ++i) {
            if (!(lane(all.low, i) < Candidates<S>::inf)) continue;
            const T second = lane(all.second, i);
            found.add(own_lane, S(lane(all.low, i)), S(lane(all.high, i)), S(lane(all.t, i)), S(lane(all.surface, i)),
                      S(-1));
            found.second = select(own_lane, min(found.second, S(second)), found.second);
        }
    });
}

/// Where rays are in the ball around a body of which nothing else is known, of those that have a bin each.
template <class S>
[[gnu::noinline]] SpanBounds<S> span_around(const World<Element<S>>& world, int bin, const DoubtfulRay<S>& own,
                                            const Slack<Element<S>>& slack) {
    using T = Element<S>;
    const SphereKernel<T> ball{{world.centres.x[bin], world.centres.y[bin], world.centres.z[bin]}, world.radii[bin]};
    return span_bounds(ball, own.ray, own.doubt, S(-1), slack);
}

/// What rays may meet first, of the bodies of the set if there is a bin for each.
template <class S>
[[gnu::noinline]] Candidates<S> candidates(const World<Element<S>>& world, const DoubtfulRay<S>& own, Mask<S> active,
                                           BodySet set, const Slack<Element<S>>& slack) {
    using T = Element<S>;
    Candidates<S> found;
    found.bin = S(static_cast<T>(world.bins));
    each_hot_item(
        world, set, [&](const auto& group, int i) __attribute__((always_inline)) {
            const int bin = world.bin_per_item ? group.first_bin + i : group.first_bin;
            add_item(group.items[i], own, active, slack, static_cast<T>(bin), found);
            return false;
        });
    each_cold_range(world, set, [&](const ItemRange& items, int bin) {
        const bool known = if_known(world, items.form, [&](const auto& group) {
            for (int i = items.first; i < items.first + items.count; ++i)
                add_item(group.items[i], own, active, slack, static_cast<T>(world.bin_per_item ? bin : group.first_bin),
                         found);
        });
        if (known) return false;
        if (!world.bin_per_item) return found.add_unknown(active, S(0)), false;
        const SpanBounds<S> span = span_around(world, bin, own, slack);
        found.add_unknown(active & span.maybe & !(span.far_high <= S(0)), span.near_low);
        return false;
    });
    if (world.nodes) {
        candidates_in_hierarchy(world, own, active, slack, found);
        const Mask<S> beyond = (found.bin < S(0)) & (found.surface >= S(0));
        if (any(beyond)) found.bin = select(beyond, bins_of(world, select(beyond, found.surface, S(-1))), found.bin);
    }
    return found;
}

/// What certainly becomes of light: `dark` where none comes through; else what is left of it, if that is not in doubt.
template <class S>
struct LightBounds {
    Vec3<S> share{S(1), S(1), S(1)};
    S crossings{0}, off{0};  // how often it was rounded, and what colours of patterns may be off beside that
    Mask<S> dark, doubt;
};
/// The lanes in which a crossing certainly is between the start and a distance that is off by at most `off`, and those
/// in which it may be.
template <class S>
STRAHL_INLINE void pass_crossing(const S& low, const S& high, const SpanBounds<S>& span, Mask<S> mask,
                                 const S& distance, const S& off, Mask<S>& certain, Mask<S>& possible) {
    const Mask<S> maybe = mask & span.maybe & !(high <= S(0)) & !(low >= distance + off);
    certain = maybe & span.sure & (low > S(0)) & (high < distance - off);
    possible = maybe & !certain;
}
/// What is left of light by patterned glass, at the middle of where it may be crossed. Products of two factors are off
/// by the error of each times the most that the other may be.
template <class S>
[[gnu::noinline]] void pass_pattern(const World<Element<S>>& world, int material, const S& surface,
                                    const DoubtfulRay<S>& own, const S& low, const S& high, Mask<S> crossed,
                                    LightBounds<S>& light) {
    using T = Element<S>;
    if (none(crossed)) return;
    const PatternKernel<T>& pattern = world.patterns[material - world.first_pattern];
    const S t = S(T(.5)) * (low + high), most(pattern.refraction * pattern.slack.largest);
    const Vec3<S> place = fma(t, own.ray.direction, own.ray.origin);
    const S away = S(T(1.01)) * (own.doubt.away + (high - low) + t * (own.doubt.turn + S(4 * unit_error<S>))) +
                   S(unit_error<S>) * norm1(place);
    const S error = PatternBounds<S>::of_filter(world, material, place, surface, away);
    const S before = max(light.share.x, max(light.share.y, light.share.z));
    light.off = select(crossed, fma(light.off, most, before * error), light.off);
    light.doubt = light.doubt | (crossed & !(error < S(T(1e-5))));  // in these the plain kernel decides
    light.crossings = light.crossings + select(crossed, S(2), S(0));
    PatternCalls<S>::filter(world, material, surface, own.ray, t, crossed, light.share);
}

template <class S, class Item>
[[gnu::noinline]] void pass_item(const World<Element<S>>& world, const Item& item, const DoubtfulRay<S>& own,
                                 Mask<S> mask, const S& distance, const S& off, const Slack<Element<S>>& slack,
                                 LightBounds<S>& light) {
    const SpanBounds<S> span = span_bounds(item.shape, own.ray, own.doubt, S(own.ray.source - S(item.surface)), slack);
    mask = mask & span.maybe & !light.dark;
    if (none(mask)) return;
    Mask<S> certain[2], possible[2];
    pass_crossing(span.near_low, span.near_high, span, mask, distance, off, certain[0], possible[0]);
    pass_crossing(span.far_low, span.far_high, span, mask, distance, off, certain[1], possible[1]);
    if (!transparent(world, item)) {
        light.dark = light.dark | certain[0] | certain[1];
        light.doubt = light.doubt | possible[0] | possible[1];
        return;
    }
    light.doubt = light.doubt | possible[0] | possible[1];
    if (const int material = static_cast<int>(item.material); patterned(world, material)) [[unlikely]] {
        pass_pattern(world, material, S(item.surface), own, span.near_low, span.near_high, certain[0], light);
        pass_pattern(world, material, S(item.surface), own, span.far_low, span.far_high, certain[1], light);
        return;
    }
    const Vec3<S> f = splat<S>(filter(world, item));
    const S most = max(f.x, max(f.y, f.z));
    for (const Mask<S>& crossed : certain) {
        light.crossings = light.crossings + select(crossed, S(1), S(0));
        light.off = select(crossed, light.off * most, light.off);
        for (int c = 0; c < 3; ++c) light.share[c] = min(light.share[c] * select(crossed, f[c], S(1)), S(largest_gain));
    }
}

/// What the hierarchy takes from the light. Not inline: of small worlds its stack would be a burden.
template <class S>
[[gnu::noinline]] void light_bounds_in_hierarchy(const World<Element<S>>& world, const DoubtfulRay<S>& own,
                                                 const S& distance, const S& off, Mask<S> active,
                                                 const Slack<Element<S>>& slack, LightBounds<S>& light) {
    S limit = select(active & !light.dark, distance + off, S(-1));
    const auto line = traversal_ray(own, slack);
    const auto look = [&](const Leaf& leaf, Mask<S> mask) {
        const bool known = if_known(world, leaf.form(), [&](const auto& group) {
            for (int i = leaf.first; i < leaf.first + leaf.count(); ++i)
                pass_item(world, group.items[i], own, mask, distance, off, slack, light);
        });
        if (!known) light.doubt = light.doubt | mask;
        limit = select(light.dark, S(-1), limit);
        return all(limit < S(0));
    };
    traverse<false>(world.nodes, line, active & !light.dark, limit, look, [&](int k, const Leaf& from) {
        const Mask<S> own_lane = first_lanes<S>(k + 1) & !first_lanes<S>(k);
        if (from.code != 0)
            look(from, own_lane);
        else
            traverse_single<false>(world.nodes, from.first, lane_of(line, k), lane(limit, k), [&](const Leaf& leaf) {
                look(leaf, own_lane);
                return lane(limit, k) < 0;
            });
    });
}

/// What light of a light certainly reaches hits.
template <class S>
[[gnu::noinline]] LightBounds<S> light_bounds(const World<Element<S>>& world, const DoubtfulRay<S>& own,
                                              const S& distance, const S& off, Mask<S> active, const Start<S>& start,
                                              const Slack<Element<S>>& slack) {
    LightBounds<S> light;
    light.dark = light.doubt = first_lanes<S>(0);
    const BodySet set = !world.bin_per_item ? 0
                        : slack.fits()      ? world.occluders[start.light * world.bins + start.bin]
                                            : ~BodySet(0);
    const auto reached_by = [&](int bin) __attribute__((always_inline)) {
        if (!world.bin_per_item || !slack.fits()) return active;
        const LightCone<Element<S>>& cone = world.cones[start.light * world.bins + bin];
        Mask<S> mask = active & !(dot(splat<S>(cone.axis), own.ray.direction) > S(-cone.cosine) + own.doubt.turn) &
                       (distance + off > S(cone.distance));
        if (bin == start.bin && (world.convex >> bin & 1)) mask = mask & !start.outside;
        return mask;
    };
    each_hot_item(
        world, set, [&](const auto& group, int i) __attribute__((always_inline)) {
            const Mask<S> mask = reached_by(group.first_bin + i) & !light.dark;
            if (none(mask)) return false;
            pass_item(world, group.items[i], own, mask, distance, off, slack, light);
            return none(active & !light.dark);
        });
    if (none(active & !light.dark)) return light;
    each_cold_range(world, set, [&](const ItemRange& items, int bin) {
        const Mask<S> mask = reached_by(bin) & !light.dark;
        const bool known = if_known(world, items.form, [&](const auto& group) {
            for (int i = items.first; any(mask) && i < items.first + items.count; ++i)
                pass_item(world, group.items[i], own, mask, distance, off, slack, light);
        });
        if (known) return false;
        if (!world.bin_per_item) return light.doubt = light.doubt | mask, false;
        const SpanBounds<S> span = span_around(world, bin, own, slack);
        light.doubt = light.doubt | (mask & span.maybe & !(span.far_high <= S(0)) & !(span.near_low >= distance + off));
        return false;
    });
    if (world.nodes) light_bounds_in_hierarchy(world, own, distance, off, active, slack, light);
    return light;
}

}  // namespace strahl::inline STRAHL_LEVEL
