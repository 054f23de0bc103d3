// The distance between a torus and the points of a line, and where the line crosses the surface.
#pragma once
#include <limits>

#include "num/ray.h"

namespace strahl {

/// A ray p + t d about the torus' centre. Its squared distance from the circle is F(t) = |p + t d|^2 + R^2 - 2 R rho,
/// where rho^2 = (x + k t)^2 + y^2 is that from the axis: a parabola less a hyperbola's branch, so that F is convex but
/// between two points left and right of where rho is least, and has a minimum, or two and a maximum. Turned so that
/// the deeper minimum is on the right.
template <class S>
struct TorusProfile {
    using E = Element<S>;
    S x, y2, k, along, along_d, middle, major, minor;  // F' = 2 (t - middle) for R = 0
    S known_rho;                                       // rho at t = 0
    S width, shift;               // half the chord in the ball around the torus; the ray's own t less t
    Mask<S> turned;               // the ray goes to the left
    Mask<S> starts_here, leaves;  // on the torus at t = 0, and from there outwards

    struct Value {
        S gap, slope, curvature, side, inverse;  // F - minor^2; F' / 2; F'' / 2; x + k t; 1 / rho
    };
    STRAHL_INLINE static Value select(Mask<S> mask, const Value& yes, const Value& no) {
        using strahl::select;
        return {select(mask, yes.gap, no.gap), select(mask, yes.slope, no.slope),
                select(mask, yes.curvature, no.curvature), select(mask, yes.side, no.side),
                select(mask, yes.inverse, no.inverse)};
    }
    STRAHL_INLINE static S select(Mask<S> mask, S yes, S no) {
        using strahl::select;
        return select(mask, yes, no);
    }
    STRAHL_INLINE Value operator()(S t) const {
        const S side = fma(k, t, x), square = fma(side, side, y2);
        const S rho = sqrt(square), inverse2 = S(1) / square, inverse = rho * inverse2;  // root beside quotient
        const S pull = major * k * inverse, z = fma(t, along_d, along), q = rho - major, since = t - middle;
        S gap = fma(q, q, fma(z, z, -(minor * minor)));
        if (any(starts_here)) {  // what F grows since the start: F(t) - F(0) with t divided out
            const S grown = t * (since - middle - S(E(2)) * major * k * (side + x) / (rho + known_rho));
            gap = select(starts_here, grown, gap);
        }
        return {gap, fma(-pull, side, since), fma(-pull * k, y2 * inverse2, S(1)), side, inverse};
    }

    /// Finds the crossings of the ray with the torus, ascending. `nearest2` is its line's least squared
    /// distance from the centre, and `square` y^2 without a least value. What lies behind the ray is not looked for.
    STRAHL_INLINE Crossings<S, 4> crossings(S nearest2, S square, Mask<S> hit) const {
        constexpr E inf = std::numeric_limits<E>::infinity();
        const S one(1), zero(0), none_such(-inf);
        // Less rounding may have made: where minimum and maximum all but meet, F can hardly tell them.
        const S least = select(starts_here, zero, S(4 * std::numeric_limits<E>::epsilon()) * minor * minor);
        const Mask<S> spindle = hit & !(minor < major);
        Extremes at = extremes_of_quartic(nearest2, hit);
        if (any(spindle)) [[unlikely]]
            at = select(spindle, extremes_of_spindle(square, spindle), at);
        const Value low = (*this)(at.deepest);
        hit = (hit & (low.gap < zero)) | starts_here;
        if (none(hit)) return {{none_such, none_such, none_such, none_such}, hit};
        Value left_low = low;
        Mask<S> first = hit & at.hump, four = first;  // is there a minimum inside on the left, and a maximum outside?
        if (any(first)) {
            left_low = (*this)(at.other);
            first = first & (left_low.gap < zero);
            four = first & ((*this)(at.top).gap > least);
        }
        at.other = select(at.hump, at.other, at.deepest), at.top = select(at.hump, at.top, at.deepest);
        const Starts known = starts(at, first, four);
        const S left = select(first, at.other, at.deepest);
        Bracket brackets[4];
        brackets[0] = bracket(left, middle - width, select(first, left_low, low), -one, hit & !known.at[0]);
        brackets[3] = bracket(at.deepest, middle + width, low, one, hit & !known.at[3]);
        brackets[1].t = at.other, brackets[2].t = at.top;
        if (any(four)) {
            brackets[1] = bracket(at.other, at.top, left_low, one, four & !known.at[1]);
            brackets[2] = bracket(at.deepest, at.top, low, -one, four & !known.at[2]);
        }
        const int pairs = any(four) ? 2 : 1;
#pragma GCC unroll 1
        for (int i = 0; i < pairs; ++i)  // one loop, so that its code is there once
            for (int k = 0; k < 200 && any(brackets[i].going | brackets[3 - i].going); ++k)
                approach(brackets[i]), approach(brackets[3 - i]);
        S t[4]{brackets[0].t, select(four, brackets[1].t, at.other), select(four, brackets[2].t, at.top),
               brackets[3].t};
        if (any(starts_here)) place(known, t);
        const S outer[2]{select(turned, -t[3], t[0]) + shift, select(turned, -t[0], t[3]) + shift};
        const S inner[2]{select(turned, -t[2], t[1]) + shift, select(turned, -t[1], t[2]) + shift};
        return {{select(four, outer[0], none_such), select(four, inner[0], none_such), select(four, inner[1], outer[0]),
                 outer[1]},
                hit};
    }

    /// The same as a function that is called: its code is long, and the call costs nothing measurable.
    [[gnu::noinline]] Crossings<S, 4> call_crossings(S nearest2, S square, Mask<S> hit) const {
        return crossings(nearest2, square, hit);
    }

  private:
    /// F's extremes: the deeper minimum, and where `hump` says that there are any, the other and the maximum between.
    struct Extremes {
        S deepest, other, top;
        Mask<S> hump;
    };
    STRAHL_INLINE static Extremes select(Mask<S> mask, const Extremes& yes, const Extremes& no) {
        using strahl::select;
        return {select(mask, yes.deepest, no.deepest), select(mask, yes.other, no.other), select(mask, yes.top, no.top),
                Mask<S>((yes.hump & mask) | (no.hump & !mask))};
    }
    /// Finds the extremes, for a torus that is no spindle, as those of the quartic (F - minor^2) (F - minor^2 + 4 R
    /// rho), which has F's signs. They are found more quickly: its derivative is a cubic without a square term, s^3 + p
    /// s + q for s = (t - middle) / R, with q <= 0. The largest root is found by Halley's steps, and leaves a
    /// quadratic. `nearest2` is the line's least squared distance from the centre.
    STRAHL_INLINE Extremes extremes_of_quartic(S nearest2, Mask<S> going) const {
        constexpr E close = sizeof(E) == 4 ? E(0x1p-7) : E(0x1p-12);  // the error of a step is the cube of its length
        const S unit = S(1) / major, three(E(3)), half(E(.5)), zero(0);
        const S p = fma(fma(-minor, minor, nearest2), unit * unit, S(1)) - S(E(2)) * k * k;
        const S q = S(E(-2)) * k * fma(k, middle, x) * unit;
        S s = k;
        for (int i = 0; i < 20 && any(going); ++i) {
            const S value = fma(fma(s, s, p), s, q), slope = fma(three * s, s, p);
            const S step = value * slope / fma(slope, slope, -(three * s * value));
            s = select(going, s - step, s);
            going = going & (abs(step) > S(close));
        }
        const S left = fma(S(E(-.75)) * s, s, -p), root = sqrt(max(left, zero));
        return {fma(major, s, middle), fma(major, -half * s - root, middle), fma(major, root - half * s, middle),
                left > zero};
    }
    /// Finds the extremes for a spindle torus, whose quartic has roots inside. `square` is y^2 without a least value.
    STRAHL_INLINE Extremes extremes_of_spindle(S square, Mask<S> wanted) const {
        const S pull = major * k;
        S found[3]{middle + pull, middle - pull, -x / k};
        Mask<S> hump = wanted & (square < pull * k * pull * k);
#pragma GCC unroll 1
        for (int i = 0; i < 3; ++i)  // one loop, so that its code is there once
            found[i] = extreme(found[i], i == 0 ? wanted : hump, i == 1, i == 2);
        return {found[0], found[1], found[2], hump};
    }

    /// A crossing between a point inside and one outside.
    struct Bracket {
        S inside, outside, t;
        Mask<S> going;
    };
    /// Looks first where the parabola that touches F inside leaves the torus, to the right if `way` is 1, to the left
    /// if -1.
    STRAHL_INLINE Bracket bracket(S inside, S outside, const Value& at, S way, Mask<S> going) const {
        const S bend = max(at.curvature, S(E(.25)));
        const S guess = inside + (way * sqrt(fma(at.slope, at.slope, -(at.gap * bend))) - at.slope) / bend;
        const S low = min(inside, outside), high = max(inside, outside);
        const Mask<S> ahead = select(turned, -low, high) + shift > S(0);
        return {inside, outside, max(low, min(high, guess)), Mask<S>(going & ahead)};
    }

    /// Says on which of the four crossings rays start.
    struct Starts {
        Mask<S> at[4];
    };
    STRAHL_INLINE Starts starts(const Extremes& at, Mask<S>& first, Mask<S>& four) const {
        const Mask<S> here = starts_here;
        if (none(here)) return {{here, here, here, here}};
        const S zero(0), half(E(.5));
        // From inside to outside, seen to the right.
        const Mask<S> rising = here & ((leaves & !turned) | (turned & !leaves));
        const Mask<S> left = here & at.hump & (zero < half * (at.top + select(rising, at.deepest, at.other)));
        first = first | left;
        four = four | (left & rising);
        const Mask<S> at0 = here & (!rising) & (left | !four);
        return {{at0, Mask<S>(rising & left), Mask<S>(here & !(rising | at0)), Mask<S>(rising & !left)}};
    }
    /// The known one is 0, and the others are where they can be.
    STRAHL_INLINE void place(const Starts& known, S (&t)[4]) const {
        const S zero(0);
        const Mask<S>(&at)[4] = known.at;
        t[0] = select(at[0], zero, select(starts_here, min(t[0], zero), t[0]));
        t[1] = select(at[1], zero, select(at[0], max(t[1], zero), select(starts_here, min(t[1], zero), t[1])));
        t[2] = select(at[2], zero, select(at[0] | at[1], max(t[2], zero), select(at[3], min(t[2], zero), t[2])));
        t[3] = select(at[3], zero, select(starts_here, max(t[3], zero), t[3]));
    }
    /// Newton's way along F' to its zero, from where it cannot be overshot. `open` are the lanes that want it and,
    /// after it, that found one; `left`: what lies right of the axis is none.
    STRAHL_INLINE S extreme(S t, Mask<S>& open, bool left, bool maximum) const {
        const S enough = S(std::numeric_limits<E>::epsilon() / 4) * minor * (major + minor), zero(0);
        Mask<S> going = open;
        for (int i = 0; i < 64 && any(going); ++i) {
            const Value at = (*this)(t);
            const S step = at.slope / at.curvature;
            Mask<S> good = maximum ? Mask<S>(at.curvature < zero) : Mask<S>(at.curvature > zero);
            if (left && !maximum) good = good & (at.side <= zero);
            open = open & (good | !going);
            going = going & good & (abs(at.slope * step) > enough);
            t = select(going, t - step, t);
        }
        return t;
    }
    /// Takes Halley's step, or halves the bracket where that step would leave it.
    STRAHL_INLINE void approach(Bracket& b) const {
        if (none(b.going)) return;
        const S bits(std::numeric_limits<E>::epsilon()), zero(0), half(E(.5)), two(E(2)), four(E(4));
        const Value at = (*this)(b.t);
        const Mask<S> in = at.gap < zero;
        b.inside = select(b.going & in, b.t, b.inside);
        b.outside = select(b.going & !in, b.t, b.outside);
        const S low = min(b.inside, b.outside), high = max(b.inside, b.outside), size = abs(b.t);
        const S step = two * at.gap * at.slope / fma(four * at.slope, at.slope, -(at.gap * at.curvature));
        const S halley = b.t - step, noise = select(starts_here, size * (major + minor), minor * minor);
        const Mask<S> here = abs(at.gap) <= four * bits * noise;
        // A step leaves an error of step^3 ((F'' / 2 F')^2 - F''' / 6 F'), where |F'''| / 6 <= (1 - F'' / 2) / rho.
        const S bound = fma(at.curvature, at.curvature, (S(1) - at.curvature) * at.inverse * abs(at.slope));
        const Mask<S> there = abs(step) * (step * step) * bound <= bits * size * (at.slope * at.slope);
        const S next = select(there | ((halley > low) & (halley < high)), halley, half * (low + high));
        b.t = select(b.going & !here, next, b.t);
        b.going = b.going & !(here | there | (high - low <= bits * max(abs(low), abs(high))));
    }
};

}  // namespace strahl
