// Ray queries on items of one form: nearest hit and transmitted light.
#pragma once
#include <array>
#include <utility>

#include "num/memory.h"
#include "num/uninitialized.h"
#include "trace/finish/finish_calls.h"

namespace strahl::inline STRAHL_LEVEL {

/// The nearest hit so far: at first t is infinite and the surface -1. The bin is that of the surface's item.
template <class S>
struct Nearest {
    S t{std::numeric_limits<Element<S>>::infinity()}, surface{-1}, bin;
};

/// Notes what a pack of shadow rays meets. Clear are surfaces that let light through.
template <class S>
struct ShadowNotes {
    using T = Element<S>;
    static constexpr int most = 24;
    static constexpr T inf = std::numeric_limits<T>::infinity();
    const T near;
    Mask<S> dark = first_lanes<S>(0);  // lanes that an opaque surface further away than `near` darkens for sure
    Mask<S> opened = dark;             // lanes that bodies which are open, or composites, darken
    Mask<S> closed = dark;             // lanes that only others darken; known when all bodies have been looked at
    int count = 0;
    bool incomplete = false;  // clear surfaces are crossed at other places, too
    Room<S, most> t;          // where clear surfaces are crossed, in any order; infinite in lanes without a crossing

    explicit ShadowNotes(T near) : near(near) {}
    void add_clear(Mask<S> lanes, const S& place) {
        if (none(lanes)) return;
        if (count > 0 && none(lanes & (t[count - 1] < S(inf))))
            t[count - 1] = select(lanes, place, t[count - 1]);
        else if (count < most)
            t[count++] = select(lanes, place, S(inf));
        else
            incomplete = true;
    }
    void add_opaque(Mask<S> lanes, const S& place) { dark = dark | (lanes & (place > S(near))); }
    /// Returns the lanes in which clear surfaces may be near to where the ray starts.
    Mask<S> close_to_start() const {
        Mask<S> found = first_lanes<S>(incomplete ? width<S> : 0);
        for (int i = 0; i < count; ++i) found = found | (t[i] < S(near));
        return found;
    }
    /// Returns the lanes in which clear surfaces may be near to each other or to where the ray starts.
    [[gnu::noinline]] Mask<S> close() const {
        Mask<S> found = close_to_start();
        for (int i = 0; i < count; ++i)
            for (int k = 0; k < i; ++k) found = found | (abs(t[i] - t[k]) < S(near));
        return found;
    }
};

/// Transmitted light: the share per channel that the items looked at let through, and the distance that it comes from,
/// -1 if none is left. Its rays are noted in `notes`, if there are any.
template <class S>
struct Transmission {
    Vec3<S> share;
    S limit;
    ShadowNotes<S>* notes = nullptr;
};

/// Takes all light from these lanes, for a body that is open or a composite, which rays meet at `t`.
template <class S>
STRAHL_INLINE void darken(Transmission<S>& light, Mask<S> lanes, const S& t) {
    light.limit = select(lanes, S(-1), light.limit);
    if (!light.notes) return;
    light.notes->opened = light.notes->opened | lanes;
    light.notes->add_opaque(lanes, t);
}

/// Returns the lanes in which a surface is nearer than the best so far; of equally near ones the first declared counts
/// as nearer.
template <class S>
STRAHL_INLINE Mask<S> closer(const S& t, const S& surface, const S& best_t, const S& best_surface) {
    return (t < best_t) | ((t == best_t) & (surface < best_surface));
}

/// Returns where rays cross an item, the same for all or one in each lane; see crossings_in().
template <class S, class Item>
STRAHL_INLINE auto crossings_of(const Item& item, const Ray<S>& ray, Mask<S> lanes) {
    return crossings_in(item.shape, ray, ray.source - S(item.surface), lanes);
}
/// The type of an item's crossings: Span or Crossings.
template <class S, class Item>
using CrossingsOf = decltype(crossings_of(std::declval<const Item&>(), std::declval<const Ray<S>&>(), all_lanes<S>()));

/// Returns the lanes in which rays cross between the start and `distance`, one mask for each crossing.
template <class S>
STRAHL_INLINE std::array<Mask<S>, 2> crossed(const Span<S>& span, Mask<S> hit, const S& distance) {
    return {Mask<S>(hit & (span.near > S(0)) & (span.near < distance)),
            Mask<S>(hit & (span.far > S(0)) & (span.far < distance))};
}
template <class S, int N>
STRAHL_INLINE std::array<Mask<S>, N> crossed(const Crossings<S, N>& crossings, Mask<S> hit, const S& distance) {
    std::array<Mask<S>, N> masks;
    for (int i = 0; i < N; ++i) masks[i] = hit & (crossings.t[i] > S(0)) & (crossings.t[i] < distance);
    return masks;
}

/// Returns the distance of crossing i, numbered as the masks of `crossed`.
template <class S>
STRAHL_INLINE S crossing(const Span<S>& span, int i) {
    return i == 0 ? span.near : span.far;
}
template <class S, int N>
STRAHL_INLINE S crossing(const Crossings<S, N>& crossings, int i) {
    return crossings.t[i];
}

/// Returns true if the item lets light of lights through.
template <class T, class Item>
STRAHL_INLINE bool transparent(const World<T>& world, const Item& item) {
    return passes_light(world, static_cast<int>(item.material));
}
template <class T, class Item>
STRAHL_INLINE const Vec3<T>& filter(const World<T>& world, const Item& item) {
    return world.materials[static_cast<int>(item.material)].filter;
}

/// Returns the lanes in which an item is the nearest so far, and updates `best` but for the bin, which is left to the
/// caller. Exits of an opaque convex body are passed to `outside(span, lanes)`, which returns those that do not count.
template <class S, class Item, class Outside>
STRAHL_INLINE Mask<S> intersect_item(const World<Element<S>>& world, const Item& item, const CrossingsOf<S, Item>& span,
                                     Mask<S> mask, Nearest<S>& best, const Outside& outside) {
    const Mask<S> hit = span.hit & mask;
    if (none(hit)) return hit;
    const S surface(item.surface), t = first_crossing(span);
    Mask<S> better = hit & (t > S(0)) & closer(t, surface, best.t, best.surface);
    if constexpr (Item::has_exits)
        if (!transparent(world, item)) better = better & !outside(span, Mask<S>(better & !(span.near > S(0))));
    best.t = select(better, t, best.t);
    best.surface = select(better, surface, best.surface);
    return better;
}

/// A point of a surface, the number of the surface, and the number of its item's first surface.
template <class S>
struct SurfaceHit {
    SurfacePoint<S> point;
    S surface, body;
};

/// Returns where rays first meet items, one in each lane, at `t`. Which face that is follows from the crossings,
/// computed once more, unless it is known: 0 or above in `faces`.
template <class S, class Item, class Cross>
STRAHL_INLINE SurfaceHit<S> surface_hit(const Item& items, const Ray<S>& ray, S t, const Cross& cross,
                                        const S* faces = nullptr) {
    if constexpr (Item::faces == 1) {
        return {items.shape.at(ray, t, S(0)), items.surface, items.surface};
    } else {
        S face = first_face(cross(items, ray, all_lanes<S>()));
        if (faces) face = select(*faces < S(0), face, *faces);
        return {items.shape.at(ray, t, face), items.surface + face, items.surface};
    }
}

/// Attenuates light by an item whose colours a pattern determines.
template <class S, class Cross, std::size_t count>
[[gnu::noinline]] void occlude_by_pattern(const World<Element<S>>& world, int material, int surface, const Ray<S>& ray,
                                          const Cross& span, const std::array<Mask<S>, count>& crossed_by,
                                          Vec3<S>& share) {
    for (std::size_t i = 0; i < count; ++i)
        FinishCalls<S>::filter(world, material, S(static_cast<Element<S>>(surface)), ray,
                               crossing(span, static_cast<int>(i)), crossed_by[i], share);
}

/// Returns how many of the crossings with an opaque item take light for sure: an exit may be one of a body beside which
/// the ray starts.
template <class Item>
constexpr std::size_t surely(std::size_t crossings) {
    return Item::has_exits ? 1 : crossings;
}

/// Attenuates light by an item; `outside` as above. Returns true if none is left in any lane.
template <class S, class Item, class Outside>
STRAHL_INLINE bool occlude_item(const World<Element<S>>& world, const Item& item, const Ray<S>& ray,
                                const CrossingsOf<S, Item>& span, const S& distance, Mask<S> mask,
                                Transmission<S>& light, const Outside& outside) {
    const S one(1);
    const Mask<S> hit = span.hit & mask;
    if (none(hit)) return false;
    auto crossed_by = crossed(span, hit, distance);
    if (transparent(world, item)) {
        if (light.notes)
            for (std::size_t i = 0; i < crossed_by.size(); ++i)
                light.notes->add_clear(crossed_by[i], crossing(span, static_cast<int>(i)));
        if (patterned(world, static_cast<int>(item.material))) [[unlikely]] {
            Vec3<S> share = light.share;
            occlude_by_pattern(world, static_cast<int>(item.material), static_cast<int>(item.surface), Ray<S>(ray),
                               CrossingsOf<S, Item>(span), crossed_by, share);
            light.share = share;
            return false;
        }
        const Vec3<S> f = splat<S>(filter(world, item));
        for (int c = 0; c < 3; ++c) {
            S kept = one;
            for (const Mask<S> crossing : crossed_by) kept = kept * select(crossing, f[c], one);
            light.share[c] = min(light.share[c] * kept, S(largest_gain));
        }
        return false;
    }
    if constexpr (Item::has_exits)
        crossed_by[1] = crossed_by[1] & !outside(span, Mask<S>(crossed_by[1] & !crossed_by[0]));
    Mask<S> dark = crossed_by[0];
    for (std::size_t i = 1; i < crossed_by.size(); ++i) dark = dark | crossed_by[i];
    light.limit = select(dark, S(-1), light.limit);
    if (light.notes) [[unlikely]] {
        if constexpr (!Item::Kind::closed) light.notes->opened = light.notes->opened | dark;
        for (std::size_t i = 0; i < surely<Item>(crossed_by.size()); ++i)
            light.notes->add_opaque(crossed_by[i], crossing(span, static_cast<int>(i)));
    }
    return all(light.limit < S(0));
}

}  // namespace strahl::inline STRAHL_LEVEL
