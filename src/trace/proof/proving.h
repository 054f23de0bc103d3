// The policy of proving kernels: error bounds travel with rays, and add up in their pixels.
#pragma once
#include <algorithm>
#include <limits>

#include "trace/proof/eye_bounds.h"
#include "trace/proof/special_light_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Plain explains these members.
struct Proving {
    static constexpr bool notes = false, joins = false, passes_touching = false;
    template <class S>
    using OfRay = Doubt<S>;
    template <class S>
    using OfHit = HitBounds<S>;
    template <class S>
    using OfLight = LitBounds<S>;

    /// Widens by the largest doubts of a pack.
    template <class T>
    struct Widening {
        Doubt<T> most;
        STRAHL_INLINE T turned(T cosine) const { return cosine - most.turn; }
        STRAHL_INLINE T moved(T distance) const { return distance + most.away; }
    };
    template <class S, class T>
    STRAHL_INLINE static Widening<T> widening(const RayQueue<T>& rays, int i, Mask<S> active) {
        return {most_doubt<S>(rays, i, active)};
    }
    template <class T>
    STRAHL_INLINE static bool culls(const Limits<T>& limits) {
        return proving(limits).slack.fits();
    }
    template <class T>
    static void start(const World<T>&, const Eye<T>& eye, const Limits<T>& limits, const PixelBatch<T>& batch,
                      RayQueue<T>& rays) {
        using S = Widest<T>;
        const Slack<T>& slack = proving(limits).slack;
        const DoubtArrays<T> doubts(rays);
        std::fill_n(proving(batch).bounds, batch.count, T(0));
        std::fill_n(doubts.away, batch.count, slack.eye_away);
        std::fill_n(doubts.side, batch.count, slack.eye_away);
        for (int i = 0; i < batch.count; i += width<S>) {
            const S x = load_lanes<S>(batch.x + i), y = load_lanes<S>(batch.y + i);
            store_lanes(doubts.turn + i, camera_turn(eye, slack, x, y));
        }
    }

    static constexpr auto nearest = [](auto&&... all) __attribute__((always_inline)) { return nearest_proved(all...); };
    static constexpr auto miss = [](auto&&... all) __attribute__((always_inline)) { return bound_miss(all...); };
    static constexpr auto meet = [](auto&&... all) __attribute__((always_inline)) { return bound_hit(all...); };
    static constexpr auto bend = [](auto&&... all) __attribute__((always_inline)) { return bound_bent(all...); };
    static constexpr auto shade = [](auto&&... all) __attribute__((always_inline)) { return bound_light(all...); };
    static constexpr auto may_face = [](auto&&... all) __attribute__((always_inline)) {
        return strahl::may_face(all...);
    };
    static constexpr auto light = [](auto&&... all) __attribute__((always_inline)) { return bound_lit(all...); };
    static constexpr auto area = [](auto&&... all) __attribute__((always_inline)) { return add_unknown_light(all...); };
    static constexpr auto side = [](auto&&... all) __attribute__((always_inline)) {
        return bound_side_of_light(all...);
    };
    static constexpr auto spot = [](auto&&... all) __attribute__((always_inline)) { return add_spot_error(all...); };
    static constexpr auto light_of = [](auto&&... all) __attribute__((always_inline)) {
        return bound_light_of(all...);
    };
    static constexpr auto special = [](auto&&... all) __attribute__((always_inline)) { return bound_special(all...); };
    static constexpr auto layers = [](auto&&... all) __attribute__((always_inline)) { return bound_layers(all...); };
    static constexpr auto lit_layers = [](auto&&... all) __attribute__((always_inline)) {
        return bound_lit_layers(all...);
    };
    static constexpr auto arriving = [](auto&&... all) __attribute__((always_inline)) { return share_proved(all...); };

    template <class S>
    STRAHL_INLINE static void reflect(const ProvedShading<S>& shading, const Hit<S>& hit,
                                      const HitNotes<S, Proving>& notes, const S& share,
                                      Branch<S, Proving>& reflected) {
        reflected.own = bound_reflection(notes.own);
        if (shading.world.patterns.bends) [[unlikely]]
            bound_bent_reflection(shading, hit, notes, share, reflected);
        if (shading.world.finishes.list) [[unlikely]]
            bound_strength(shading, hit, notes.own, notes.own.reflected, reflected);
    }
    template <class S>
    STRAHL_INLINE static void refract(const ProvedShading<S>& shading, const Hit<S>& hit, const HitBounds<S>& known,
                                      Mask<S> glass, Mask<S> far, const S& b, const S& c, const S& k,
                                      Branch<S, Proving>& refracted) {
        bound_refraction(shading, hit, known, glass, far, b, c, k, refracted);
        if (shading.world.finishes.list) [[unlikely]]
            bound_strength(shading, hit, known, known.refracted, refracted);
    }
    template <class S, class Put>
    STRAHL_INLINE static void put(const Put& put, const World<Element<S>>& world, const RayQueue<Element<S>>& to,
                                  const Doubt<S>& own) {
        const DoubtArrays<Element<S>> doubts(to);
        const int n = to.count;
        put(doubts.away + n, own.away), put(doubts.turn + n, own.turn), put(doubts.side + n, own.side);
        if (world.transparent) put(doubts.spin + n, own.spin);
    }
    template <class S>
    STRAHL_INLINE static Doubt<S> either(Mask<S> first, const Doubt<S>& a, const Doubt<S>& b) {
        return {select(first, a.away, b.away), select(first, a.turn, b.turn), select(first, a.side, b.side),
                select(first, a.spin, b.spin)};
    }
    template <class S>
    STRAHL_INLINE static S diffuse(const HitBounds<S>& known, const S& computed) {
        return computed + known.diffuse;
    }
    template <class S>
    STRAHL_INLINE static Mask<S> lit(Mask<S> faces, const Hit<S>& hit, const LitBounds<S>& lit) {
        return faces | (hit.active & lit.doubt);
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
