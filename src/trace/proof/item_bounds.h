// Queries with error bounds on single items: candidates for the nearest hit, and transmitted light.
#pragma once
#include "trace/kernel/query.h"
#include "trace/proof/known_forms.h"
#include "trace/proof/pattern_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// The crossings that may be a ray's first one in exact arithmetic. None is before `low`, at most one is before
/// `second`, and some crossing is certainly before `high`: so the hit is certain if `second` is beyond `high`.
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
    /// Adds a body of which nothing is known but that it may be in the way, from `from` on.
    STRAHL_INLINE void add_unknown(Mask<S> lanes, const S& from) { add(lanes, from, S(inf), S(inf), S(-1), S(-1)); }
    STRAHL_INLINE Mask<S> hits() const { return second > high; }
    STRAHL_INLINE Mask<S> misses() const { return low == S(inf); }
};

/// A ray with its error bounds, as proving queries take it.
template <class S>
struct DoubtfulRay {
    Ray<S> ray;
    Doubt<S> doubt;
};
template <class S>
STRAHL_INLINE DoubtfulRay<S> lane_of(const DoubtfulRay<S>& own, int k) {
    return {lane_of(own.ray, k), {S(lane(own.doubt.away, k)), S(lane(own.doubt.turn, k))}};
}

/// Returns the computed crossings that the bounds are for.
template <class S>
STRAHL_INLINE std::array<S, 2> ends_of(const Span<S>& span) {
    return {span.near, span.far};
}
template <class S>
STRAHL_INLINE std::array<S, 2> ends_of(const Crossings<S, 4>& crossings) {
    const S first = first_crossing(crossings);
    return {first, first};
}

template <class S, class Item, class Bin>
[[gnu::noinline]] void add_item(const Item& item, const DoubtfulRay<S>& own, Mask<S> mask,
                                const Slack<Element<S>>& slack, const Bin& bin, Candidates<S>& found) {
    const S surface(item.surface);
    const SpanBounds<S> span = span_bounds(item.shape, own.ray, own.doubt, S(own.ray.source - surface), slack);
    mask = mask & span.maybe;
    if (none(mask)) return;
    constexpr auto inf = Candidates<S>::inf;
    const auto [near, far] = ends_of<S>(crossings_of(item, own.ray, mask));
    const Mask<S> enters = span.sure & (span.near_low > S(0)), leaves = span.sure & (span.far_low > S(0));
    found.add(mask & !(span.near_high <= S(0)), span.near_low, select(enters, span.near_high, S(inf)), near, surface,
              S(bin));
    mask = mask & !(span.far_high <= S(0)) & !enters;
    if (none(mask)) return;
    found.add(mask, span.far_low, select(leaves, span.far_high, S(inf)), far, surface, S(bin));
}

/// Bounds transmitted light. Lanes are certainly `dark` if none comes through, else undecided if in `doubt`; else
/// `share` comes through.
template <class S>
struct LightBounds {
    Vec3<S> share{S(1), S(1), S(1)};
    S crossings{0}, off{0};  // number of its roundings, and its error by colours of patterns
    Mask<S> dark, doubt;
};
/// Finds the lanes in which a crossing certainly is between the start and a distance that is off by at most `off`, and
/// those in which it may be.
template <class S>
STRAHL_INLINE void pass_crossing(const S& low, const S& high, const SpanBounds<S>& span, Mask<S> mask,
                                 const S& distance, const S& off, Mask<S>& certain, Mask<S>& possible) {
    const Mask<S> maybe = mask & span.maybe & !(high <= S(0)) & !(low >= distance + off);
    certain = maybe & span.sure & (low > S(0)) & (high < distance - off);
    possible = maybe & !certain;
}
/// Attenuates light by a surface that it certainly crosses in some lanes, and possibly in others.
template <class S>
STRAHL_INLINE void lose_light(const World<Element<S>>& world, int material, Mask<S> certain, Mask<S> possible,
                              LightBounds<S>& light) {
    light.doubt = light.doubt | possible;
    const MaterialKernel<Element<S>>& own = world.materials[material];
    if (!passes_light(world, material)) {
        light.dark = light.dark | certain;
        return;
    }
    if (patterned(world, material) && has_shadow(world, material)) {
        light.doubt = light.doubt | certain;
        return;
    }
    light.crossings = light.crossings + select(certain, S(world.finishes.list ? 4 : 1), S(0));
    light.off = select(certain, light.off * S(max(own.filter.x, max(own.filter.y, own.filter.z))), light.off);
    for (int c = 0; c < 3; ++c)
        light.share[c] = min(light.share[c] * select(certain, S(own.filter[c]), S(1)), S(largest_gain));
}
/// Attenuates light by patterned glass, with the colour in the middle of where it may be crossed. A product of two
/// factors is off by the error of each times the most that the other may be.
template <class S>
[[gnu::noinline]] void pass_pattern(const World<Element<S>>& world, int material, const S& surface,
                                    const DoubtfulRay<S>& own, const S& low, const S& high, Mask<S> crossed,
                                    const Slack<Element<S>>& slack, LightBounds<S>& light) {
    using T = Element<S>;
    if (none(crossed)) return;
    const PatternKernel<T>& pattern = world.patterns.list[material - world.patterns.first];
    const S t = S(T(.5)) * (low + high), most(pattern.refraction * pattern.slack.largest);
    const Vec3<S> place = fma(t, own.ray.direction, own.ray.origin);
    const S away = S(T(1.01)) * (own.doubt.away + (high - low) + t * (own.doubt.turn + S(4 * unit_error<S>))) +
                   S(unit_error<S>) * norm1(place);
    const S error = PatternBounds<S>::of_filter(world, material, place, surface, away, slack);
    const S before = max(light.share.x, max(light.share.y, light.share.z));
    light.off = select(crossed, fma(light.off, most, before * error), light.off);
    light.doubt = light.doubt | (crossed & !(error < S(T(1e-5))));  // here the plain kernel decides
    light.crossings = light.crossings + select(crossed, S(2), S(0));
    FinishCalls<S>::filter(world, material, surface, own.ray, t, crossed, light.share);
}

template <class S, class Item>
[[gnu::noinline]] void pass_item(const World<Element<S>>& world, const Item& item, const DoubtfulRay<S>& own,
                                 Mask<S> mask, const S& distance, const S& off, const Slack<Element<S>>& slack,
                                 LightBounds<S>& light) {
    const auto span = span_bounds(item.shape, own.ray, own.doubt, S(own.ray.source - S(item.surface)), slack);
    mask = mask & span.maybe & !light.dark;
    if (none(mask)) return;
    Mask<S> certain[2], possible[2];
    pass_crossing(span.near_low, span.near_high, span, mask, distance, off, certain[0], possible[0]);
    pass_crossing(span.far_low, span.far_high, span, mask, distance, off, certain[1], possible[1]);
    if constexpr (requires { span.later; })
        if (transparent(world, item)) light.doubt = light.doubt | (mask & (span.later < distance + off));
    if (const int material = static_cast<int>(item.material);
        transparent(world, item) && patterned(world, material) && plain(world, material)) [[unlikely]] {
        light.doubt = light.doubt | possible[0] | possible[1];
        pass_pattern(world, material, S(item.surface), own, span.near_low, span.near_high, certain[0], slack, light);
        pass_pattern(world, material, S(item.surface), own, span.far_low, span.far_high, certain[1], slack, light);
        return;
    }
    for (int k = 0; k < 2; ++k) lose_light(world, static_cast<int>(item.material), certain[k], possible[k], light);
}

/// Attenuates light by opaque items, a different one in each lane.
template <class S, class Item>
STRAHL_INLINE void pass_opaque_items(const Item& items, const DoubtfulRay<S>& own, Mask<S> mask, const S& distance,
                                     const S& off, const Slack<Element<S>>& slack, LightBounds<S>& light) {
    const auto span = span_bounds(items.shape, own.ray, own.doubt, S(own.ray.source - items.surface), slack);
    mask = mask & span.maybe;
    if (none(mask)) return;
    Mask<S> certain[2], possible[2];
    pass_crossing(span.near_low, span.near_high, span, mask, distance, off, certain[0], possible[0]);
    pass_crossing(span.far_low, span.far_high, span, mask, distance, off, certain[1], possible[1]);
    light.dark = light.dark | certain[0] | certain[1], light.doubt = light.doubt | possible[0] | possible[1];
}

}  // namespace strahl::inline STRAHL_LEVEL
