// Angles and waves in lanes, with the same bits in all packs and at all levels that have fma.
#pragma once
#include "num/lane_math.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the angle with this cosine, between -1 and 1, in quarter turns. Beyond |c| = 1/2 it follows from half the
/// angle: 1 - cos a = 2 sin^2(a / 2). The series is asin x = sum (2k)! / (4^k (k!)^2 (2k + 1)) x^(2k + 1), whose terms
/// are too small to count from the last one on.
template <class S>
STRAHL_INLINE S quarter_turns(const S& c) {
    using R = Element<S>;
    if constexpr (std::is_same_v<R, long double>) {
        return std::acos(c) * (2 / std::numbers::pi_v<R>);
    } else {
        constexpr int terms = std::is_same_v<R, float> ? 10 : 24;
        constexpr auto arcsine = [] {  // in quarter turns
            std::array<R, terms> all{};
            double factor = 2 / std::numbers::pi;
            for (int k = 0; k < terms; ++k) all[k] = R(factor / (2 * k + 1)), factor *= (2 * k + 1.) / (2 * k + 2.);
            return all;
        }();
        const S size = abs(c), half_square = fma(size, S(R(-.5)), S(R(.5)));  // sin^2(a / 2) of the angle of |c|
        const Mask<S> far = size > S(R(.5));
        const S sine = select(far, sqrt(max(half_square, S(0))), size), square = select(far, half_square, size * size);
        const S angle = sine * polynomial<terms>(arcsine, square);
        const S own = select(far, angle + angle, S(1) - angle);
        return select(c < S(0), S(2) - own, own);
    }
}

/// Returns the cosine of an angle in whole turns, as the sine of what it lacks to a quarter turn.
template <class S>
STRAHL_INLINE S cosine_of_turns(const S& turns) {
    using R = Element<S>;
    if constexpr (std::is_same_v<R, long double>) {
        return std::cos(turns * (2 * std::numbers::pi_v<R>));
    } else {
        constexpr int terms = std::is_same_v<R, float> ? 7 : 11;
        constexpr auto sine = [] {  // of turns
            std::array<R, terms> all{};
            const double turn = 2 * std::numbers::pi;
            double term = turn;
            for (int k = 0; k < terms; ++k) all[k] = R(term), term *= -turn * turn / ((2 * k + 2.) * (2 * k + 3.));
            return all;
        }();
        const S r = turns - floor(turns + S(R(.5))), left = S(R(.25)) - abs(r);
        return left * polynomial<terms>(sine, left * left);
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
