// How rays go along through a Julia set, and where they cross its surface, in the way of POV-Ray's julia_fractal.
#pragma once
#include <bit>
#include <type_traits>

#include "scene/kinds/contours.h"
#include "scene/kinds/julia/julia_orbit.h"
#include "scene/kinds/julia/shared_lanes.h"

namespace strahl {

/// Rays that go through a Julia set, by places along lines from points `from`. They go until `last`, or outside of it
/// until it is behind them: until `leaves`. Between `sure_from` and `sure_to` it matters that they cross the surface,
/// but not where. Places are counted as a number of least steps from `base`, so that they are the same whether they are
/// looked at one after the other or side by side.
template <class V>
struct JuliaMarch {
    using R = Element<V>;
    Vec3<V> from, way;
    V last, leaves, sure_from, sure_to;
    V place;
    Mask<V> lanes;
    V base{place}, steps{0}, free{0};  // free: how far they may go from where they are
    V at{0};                           // where those that turned crossed the surface
    Mask<V> inside{}, turned{};

    static constexpr R near = std::is_same_v<R, float> ? R(4e-7) : R(1e-7);  // how exactly a crossing is found
    static constexpr R itself = R(1e-4);  // crossings nearer than this to a start on the surface are that start

    /// Looks at the places where rays begin, or somewhat further in if these are inside.
    template <JuliaRule rule>
    STRAHL_INLINE void start(const JuliaNumbers<R>& own) {
        inside = julia_look<rule>(own, fma(place, way, from), way, lanes, free);
        if (none(inside)) return;
        place = place + select(inside, V(near + near), V(0)), base = place;
        lanes = lanes & !(inside & !(place <= last));
        inside = julia_look<rule>(own, fma(place, way, from), way, lanes, free);
    }
    /// Goes on until all rays have crossed the surface or passed the last place, and finds where they crossed it. Those
    /// that did wait for the others.
    template <JuliaRule rule>
    STRAHL_INLINE void advance(const JuliaNumbers<R>& own) {
        const V zero(0), one(1), least(own.precision);
        Mask<V> going = lanes;
        V part = zero;  // the length of the step that crosses the surface
        turned = lanes & !lanes;
        while (any(going)) {
            if constexpr (few > 0)
                if (count(going) <= few) {
                    advance_few<rule>(own, bits(going), part);
                    break;
                }
            const V before = place, step = max(free, least);
            const V more = steps + one, next = select(going, fma(more, least, base), place), far = place + free;
            const Mask<V> longer = going & (free > least);
            place = select(longer, far, next), base = select(longer, far, base);
            steps = select(longer, zero, select(going, more, steps));
            const Mask<V> ended = going & !(place <= select(inside, last, leaves));  // or it is no number
            lanes = lanes & !ended, going = going & !ended;
            if (none(going)) break;
            V free_next;
            const Mask<V> turns =
                going & either(julia_look<rule>(own, fma(place, way, from), way, going, free_next), inside);
            free = select(going, free_next, free);
            if (none(turns)) continue;
            part = select(turns, step, part), at = select(turns, before, at);
            turned = turned | turns, going = going & !turns;
        }
        const Mask<V> sure = turned & (at >= sure_from) & (at + part <= sure_to);
        at = select(sure & !inside, at + part, at), part = select(sure, zero, part);
        halve<rule>(own, part);
        inside = either(inside, turned);
        turned = turned & !(at > last);
    }

  private:
    static constexpr int few = width<V> / 4;  // so few rays have several lanes each

    /// Does what advance() does for few rays: looks at several places of each at once, as far as the steps between are
    /// the least. `part` becomes the steps in which they cross the surface.
    template <JuliaRule rule>
    STRAHL_INLINE void advance_few(const JuliaNumbers<R>& own, unsigned going, V& part) {
        const R least = own.precision;
        alignas(64) R bases[width<V>], counts[width<V>], places[width<V>], frees[width<V>], ats[width<V>],
            parts[width<V>];
        store_lanes(bases, base), store_lanes(counts, steps), store_lanes(places, place), store_lanes(frees, free);
        store_lanes(ats, at), store_lanes(parts, part);
        unsigned ends = 0, turns = 0;
        const unsigned in = bits(inside);
        while (going) {
            const SharedLanes<V> shared(going);
            const Vec3<V> origin = shared.of(from), direction = shared.of(way);
            const V limit = shared.of(select(inside, last, leaves));
            const Mask<V> within = shared.lanes_of(in);
            do {
                for (unsigned left = going; left; left &= left - 1) {
                    const int k = std::countr_zero(left);
                    const bool longer = frees[k] > least;
                    bases[k] = longer ? places[k] + frees[k] : bases[k], counts[k] = longer ? 0 : counts[k] + 1;
                }
                const V t = fma(shared.of(counts) + shared.number, V(least), shared.of(bases));
                const Mask<V> used = shared.lanes_of(going), here = used & (t <= limit);
                V next;
                const Mask<V> turn =
                    here & either(julia_look<rule>(own, fma(t, direction, origin), direction, here, next), within);
                const unsigned out = bits(used & !here), turned_there = bits(turn);
                const unsigned stops = out | turned_there | bits(used & (next > V(least)));
                for (int i = 0; i < shared.count; ++i) {
                    const int k = shared.rays[i];
                    if (!(going >> k & 1)) continue;
                    const unsigned own_stops = shared.bits_of(stops, i);
                    const int ahead = own_stops ? std::countr_zero(own_stops) : shared.each - 1;
                    const int j = i * shared.each + ahead;
                    if (out >> j & 1) {
                        ends |= 1u << k, going &= ~(1u << k);
                        continue;
                    }
                    if (turned_there >> j & 1) {
                        turns |= 1u << k, going &= ~(1u << k);
                        ats[k] = ahead ? lane(t, j - 1) : places[k];
                        parts[k] = ahead || !(frees[k] > least) ? least : frees[k];
                    }
                    counts[k] += static_cast<R>(ahead), places[k] = lane(t, j), frees[k] = lane(next, j);
                }
            } while (2 * std::popcount(going) > shared.count);
        }
        base = load_lanes<V>(bases), steps = load_lanes<V>(counts), place = load_lanes<V>(places);
        free = load_lanes<V>(frees), at = load_lanes<V>(ats), part = load_lanes<V>(parts);
        lanes = lanes & !mask_of<V>(ends), turned = turned | mask_of<V>(turns);
    }
    /// Halves the steps `part` from `at` on in which rays cross the surface, until the rest is short.
    template <JuliaRule rule>
    STRAHL_INLINE void halve(const JuliaNumbers<R>& own, const V& part) {
        const V half(R(.5)), close(near);
        V share(0), size(1);  // of the step: what is passed, and the rest that is left
        Mask<V> left = turned & (part > close);
        if constexpr (few > 0)
            if (any(left) && count(left) <= few) {
                halve_few<rule>(own, bits(left), part, share, size);
                left = left & !left;
            }
        for (; any(left); left = left & (size * part > close)) {
            size = select(left, half * size, size);
            const V middle = share + size;
            const Vec3<V> p = fma(fma(middle, part, at), way, from);
            share = select(left & !either(julia_holds<rule>(own, p, left), inside), middle, share);
        }
        at = select(turned, fma(select(inside, share, share + size), part, at), at);
    }
    /// Halves the steps of few rays: looks at once at all places where several halvings may look.
    template <JuliaRule rule>
    STRAHL_INLINE void halve_few(const JuliaNumbers<R>& own, unsigned left, const V& part, V& share, V& size) {
        alignas(64) R shares[width<V>], sizes[width<V>], parts[width<V>];
        store_lanes(shares, share), store_lanes(sizes, size), store_lanes(parts, part);
        const SharedLanes<V> shared(left);
        const unsigned whole = std::bit_floor(static_cast<unsigned>(shared.each) + 1);
        const Vec3<V> origin = shared.of(from), direction = shared.of(way);
        const V begin = shared.of(at), length = shared.of(part);
        const V number = V(R(1) / static_cast<R>(whole)) * (shared.number + V(1));
        const unsigned in = bits(inside);
        while (left) {
            const V t = fma(fma(number, shared.of(sizes), shared.of(shares)), length, begin);
            const Mask<V> used = shared.lanes_of(left);
            const unsigned held = bits(julia_holds<rule>(own, fma(t, direction, origin), used));
            for (int i = 0; i < shared.count; ++i) {
                const int k = shared.rays[i];
                if (!(left >> k & 1)) continue;
                const unsigned crossed = shared.bits_of(held, i) ^ (in >> k & 1 ? ~0u : 0u);
                unsigned passed = 0;
                for (unsigned step = whole / 2; step && left >> k & 1; step /= 2) {
                    sizes[k] *= R(.5);
                    if (!(crossed >> (passed + step - 1) & 1)) passed += step, shares[k] += sizes[k];
                    if (!(sizes[k] * parts[k] > near)) left &= ~(1u << k);
                }
            }
        }
        share = load_lanes<V>(shares), size = load_lanes<V>(sizes);
    }
};

}  // namespace strahl
