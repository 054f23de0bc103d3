#include "scene/motion/curve.h"

#include "num/vec_math.h"

namespace strahl {
namespace {

/// The slope of a curve at a key, times `interval`: from the differences to both neighbours and the seconds between,
/// the weighted harmonic mean of the secants, which never overshoots (F. N. Fritsch, J. Butland, "A Method for
/// Constructing Local Monotone Piecewise Cubic Interpolants", 1984). Written so that times neither overflow nor
/// underflow.
double slope_between(double left, double right, double seconds_left, double seconds_right, double interval) {
    if (!(left > 0 && right > 0) && !(left < 0 && right < 0)) return 0;
    const double unit = std::max(seconds_left, seconds_right), l = seconds_left / unit, r = seconds_right / unit;
    const double a = 2 * r + l, b = r + 2 * l;
    return (a + b) * (interval / unit) / (a * l / left + b * r / right);
}

/// How far the knots of a chord lie apart. hypot takes a third of the time that a moving body needs.
double knots_of(const DVec3& chord) {
    const double squared = dot_product(chord, chord);
    return std::sqrt(squared > 1e-200 ? std::sqrt(squared) : length(chord));
}

}  // namespace

Monotone monotone(const Interval& i, double before, double here, double after) {
    const auto [left, own, right] = i.seconds;
    return {here, i.key_before ? slope_between(before, here, left, own, own) : here,
            i.key_after ? slope_between(here, after, own, right, own) : here};
}

Spline spline(const Interval& interval, const std::array<DVec3, 3>& chords) {
    const auto& [left, here, right] = chords;
    const double knots = knots_of(here);
    if (knots == 0) return {};
    // Without a neighbour the curve starts straight; beside a chord of length 0 its velocity is 0.
    Spline result{here, here, knots};
    double before = 0, after = 0;
    const auto velocity = [](const DVec3& a, double ka, const DVec3& b, double kb) {
        return ka > 0 ? a / ka - (a + b) / (ka + kb) + b / kb : DVec3(0);
    };
    if (interval.key_before) {
        before = knots_of(left);
        result.m = velocity(left, before, here, knots) * knots;
    }
    if (interval.key_after) {
        after = knots_of(right);
        result.n = velocity(right, after, here, knots) * knots;
    }
    result.way = monotone(interval, before, knots, after);
    return result;
}

}  // namespace strahl
