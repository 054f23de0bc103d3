// Approximate means of patterns over footprints, a pack at a time: for pictures in motion, which have little time for a
// sample. Edges that are straight and apart from others are averaged exactly (see pattern_means.h for what stills do).
#pragma once
#include "trace/patterns/pattern_value_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// A number that is x in the middle of a parallelogram and changes by a and by b along its sides. What it is in between
/// is spread over a trapezoid: two boxes, one after the other.
template <class S>
class SpreadNumber {
    using T = Element<S>;

  public:
    SpreadNumber(const S& own, const S& a, const S& b)
        : x(own), wide(max(abs(a), abs(b))), narrow(min(abs(a), abs(b))) {}

    SpreadNumber moved(T by) const { return {x + S(by), wide, narrow}; }
    SpreadNumber halved() const { return {S(T(.5)) * x, S(T(.5)) * wide, S(T(.5)) * narrow}; }
    /// Returns the mean of x - floor(x) - 1/2.
    S mean_of_saw() const {
        const S zero(0), half(T(.5)), one(1), outer = half * (wide + narrow), inner = half * (wide - narrow);
        const S from = x - floor(x + half), away = abs(from);  // from the only jump, if the number is spread little
        const S over = max(outer - away, zero);
        const S share = select(away < inner, S(2) * away / wide, one - over * over / (wide * narrow));
        const S jump = select(outer <= away, half, half * share);
        const S single = from - select(from < zero, -jump, jump);
        const Mask<S> more = outer > half;
        if (none(more)) return single;
        // Differences of integrals need a side of some length, or rounding would be left.
        const S side = max(narrow, S(T(1. / 64))), far = half * (wide + side), near = half * (wide - side);
        const S sum = second(x + far) - second(x + near) - second(x - near) + second(x - far);
        return select(more, sum / (wide * side), single);
    }
    /// Returns the mean of a wave that is 1 from 0 to 1, -1 from 1 to 2, and so on.
    S mean_of_square() const { return fma(S(2), mean_of_saw(), S(-4) * halved().mean_of_saw()); }
    /// Returns the share of what lies beyond the first part of each unit.
    S mean_of_course(T part) const { return S(1 - part) + mean_of_saw() - moved(-part).mean_of_saw(); }

  private:
    /// The second integral of x - floor(x) - 1/2, which is periodic as well.
    static S second(const S& x) {
        const S t = fraction(x);
        return t * fma(t, fma(t, S(T(1. / 6)), S(T(-1. / 4))), S(T(1. / 12)));
    }
    S x, wide, narrow;
};

/// Returns the approximate mean value of checks or bricks, whose coordinates are taken for independent.
template <class S>
S mean_of_steps(const PatternKernel<Element<S>>& pattern, const Vec3<S>& p, const Vec3<S>& across,
                const Vec3<S>& down) {
    using T = Element<S>;
    const S one(1), half(T(.5));
    const auto along = [&](int axis) { return SpreadNumber<S>(p[axis], across[axis], down[axis]); };
    if (pattern.form == PatternForm::checker) {
        S product(1);
        for (int c = 0; c < 3; ++c) product = product * along(c).mean_of_square();
        return half * (one - product);
    }
    // Courses of even numbers are moved along one axis, those of odd numbers along the other.
    const S even = half * (one + along(1).mean_of_square());
    const auto row = [&](T x, T z) {
        return along(0).moved(x).mean_of_course(pattern.mortar.x) * along(2).moved(z).mean_of_course(pattern.mortar.z);
    };
    return along(1).mean_of_course(pattern.mortar.y) * mix(row(T(.5), T(0)), row(T(0), T(.5)), even);
}

/// Returns the integral of a pattern's colours from value 0 to `value`, which is from 0 to 1.
template <class S>
Vec3<S> integral_of_colors(const PatternKernel<Element<S>>& pattern, const ColorStopKernel<Element<S>>* stops,
                           const S& value) {
    using T = Element<S>;
    Vec3<S> sum = splat<S>(Vec3<T>(0));
    const auto add = [&](T from, T to, const Vec3<T>& first, const Vec3<T>& last) {
        if (!(to > from)) return;
        const S way = min(max(value - S(from), S(0)), S(to - from)), half = S(T(.5) / (to - from)) * way * way;
        for (int c = 0; c < 3; ++c) sum[c] = fma(way, S(first[c]), fma(half, S(last[c] - first[c]), sum[c]));
    };
    add(0, stops[0].at, stops[0].color, stops[0].color);
    for (int i = 1; i < pattern.stops; ++i) add(stops[i - 1].at, stops[i].at, stops[i - 1].color, stops[i].color);
    const auto& last = stops[pattern.stops - 1];
    add(last.at, 1, last.color, last.color);
    return sum;
}

/// Values of a gradient, noise, layers or rings, before they repeat or end: a range around `middle`.
template <class S>
struct SpreadValue {
    S middle, width;
};

/// Returns what values such a pattern has around p. Octaves finer than the sides only widen the range.
template <class S>
SpreadValue<S> spread_value(const PatternKernel<Element<S>>& pattern, const Vec3<S>& p, const Vec3<S>& across,
                            const Vec3<S>& down) {
    using T = Element<S>;
    const S lengths[2] = {sqrt(dot(across, across)), sqrt(dot(down, down))};
    const S step = max(lengths[0], lengths[1]);
    S middle = p.x, a = across.x, b = down.x, spread(0);
    if (pattern.form != PatternForm::ramp) {
        const S steps[2] = {step, step};
        middle = smoothed_value(pattern, p, step);
        spread = lost_octaves(pattern, p, across, down, steps, lengths).spread;
        if (pattern.form == PatternForm::noise) a = b = S(0);
    }
    if (pattern.form == PatternForm::rings) {
        const S per = S(1) / max(sqrt(fma(p.x, p.x, p.y * p.y)), S(std::numeric_limits<T>::min()));
        a = per * fma(p.x, across.x, p.y * across.y), b = per * fma(p.x, down.x, p.y * down.y);
    }
    // A box as wide as its variance, which is a 12th of its square, wants it.
    return {middle, sqrt(fma(a, a, fma(b, b, S(12) * spread * spread)))};
}

/// Returns such a pattern's value, from 0 to 1, where it is x before it repeats or ends.
template <class S>
STRAHL_INLINE S folded(const PatternKernel<Element<S>>& pattern, const S& x) {
    if (pattern.form == PatternForm::noise) return min(max(x, S(0)), S(1));
    return pattern.form == PatternForm::ramp ? fraction(x) : wave(x);
}

/// Returns where colours do not change linearly over such a range around `value`.
template <class S>
Mask<S> crosses_stops(const PatternKernel<Element<S>>& pattern, const ColorStopKernel<Element<S>>* stops,
                      const S& value, const S& width) {
    using T = Element<S>;
    const bool waves = pattern.form == PatternForm::layers || pattern.form == PatternForm::rings;
    const S reach = waves ? width : S(T(.5)) * width, nearer = min(value, S(1) - value);
    Mask<S> crossing = nearer < reach;
    for (int i = 0; i < pattern.stops; ++i) crossing = crossing | (abs(value - S(stops[i].at)) < reach);
    return crossing;
}

/// Returns the mean colour of a gradient, noise, layers or rings, whose values before they repeat or end fill a range
/// of this width around `middle`.
template <class S>
Vec3<S> mean_of_range(const PatternKernel<Element<S>>& pattern, const ColorStopKernel<Element<S>>* stops,
                      const S& middle, const S& width) {
    using T = Element<S>;
    const S zero(0), one(1), half(T(.5)), way = max(width, S(T(1. / 256)));
    const bool ends_here = pattern.form == PatternForm::noise;
    const S x = ends_here ? middle : fraction(middle);
    const Vec3<S> all = integral_of_colors(pattern, stops, one);
    Vec3<S> ends[2];
    for (int i = 0; i < 2; ++i) {
        const S end = fma(i ? half : -half, way, x), whole = floor(end), t = end - whole;
        if (ends_here) {
            const S within = min(max(end, zero), one), below = min(end, zero), above = max(end - one, zero);
            ends[i] = integral_of_colors(pattern, stops, within);
            for (int c = 0; c < 3; ++c)
                ends[i][c] =
                    fma(below, S(stops[0].color[c]), fma(above, S(stops[pattern.stops - 1].color[c]), ends[i][c]));
        } else if (pattern.form == PatternForm::ramp) {
            ends[i] = fma(whole, all, integral_of_colors(pattern, stops, t));
        } else {
            const Mask<S> down = t > half;
            const Vec3<S> part = integral_of_colors(pattern, stops, S(2) * select(down, one - t, t));
            for (int c = 0; c < 3; ++c)
                ends[i][c] = fma(whole, all[c], select(down, fma(-half, part[c], all[c]), half * part[c]));
        }
    }
    return scale(one / way, ends[1] - ends[0]);
}

}  // namespace strahl::inline STRAHL_LEVEL
