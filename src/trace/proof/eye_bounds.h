// Error bounds of the directions of camera rays: their exact errors, where other bounds allow for each rounding.
#pragma once
#include <limits>

#include "num/lanes.h"
#include "trace/proof/proving_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns a * b - product, the rounding error of a product: by one instruction, or by halves of a and b, whose
/// products are exact (T. J. Dekker, A floating-point technique for extending the available precision, 1971).
template <class S>
STRAHL_INLINE S product_lacks(const S& a, const S& b, const S& product) {
    if constexpr (fuses<S>) return fma(a, b, -product);
    constexpr int digits = std::numeric_limits<Element<S>>::digits;
    const auto high = [](const S& x) {
        const S t = S(static_cast<Element<S>>((1LL << (digits + 1) / 2) + 1)) * x;
        return S(t - (t - x));
    };
    const S p = high(a), q = high(b), p_rest = a - p, q_rest = b - q;
    return ((p * q - product) + p * q_rest + p_rest * q) + p_rest * q_rest;
}
/// Returns a * b + c - sum, the error of a sum that was rounded once, by a fused multiply-add, or twice.
template <class S>
STRAHL_INLINE S sum_lacks(const S& a, const S& b, const S& c, const S& sum) {
    const S product = a * b, twice = product + c, part = twice - product;
    return ((twice - sum) + ((product - (twice - part)) + (c - part))) + product_lacks(a, b, product);
}

/// Bounds the angle between the camera ray through pixel (x, y) that the kernel computes and the exact one.
///
/// The exact ray goes along the sum of the computed direction and what that lacks: by rounding, and by errors of the
/// eye's numbers. The part of that across the ray is the angle but for its cube. Products of two such errors, below
/// 1e-9 of it where rays are shifted by 1e-7 pixels on purpose, are in the factor of 1.001.
template <class S>
STRAHL_INLINE S camera_turn(const Eye<Element<S>>& eye, const Slack<Element<S>>& slack, const S& x, const S& y) {
    const Eye<Element<S>>& rest = slack.eye_lacks;
    const S u = fma(x, S(eye.scale_x), S(eye.bias_x)), v = fma(y, S(eye.scale_y), S(eye.bias_y));
    const S u_lacks = sum_lacks(x, S(eye.scale_x), S(eye.bias_x), u) + fma(x, S(rest.scale_x), S(rest.bias_x));
    const S v_lacks = sum_lacks(y, S(eye.scale_y), S(eye.bias_y), v) + fma(y, S(rest.scale_y), S(rest.bias_y));
    Vec3<S> d, lacks;
    for (int c = 0; c < 3; ++c) {
        const S row = fma(v, S(eye.down[c]), S(eye.forward[c]));
        d[c] = fma(u, S(eye.right[c]), row);
        lacks[c] = sum_lacks(v, S(eye.down[c]), S(eye.forward[c]), row) + sum_lacks(u, S(eye.right[c]), row, S(d[c])) +
                   fma(u_lacks, S(eye.right[c]), v_lacks * S(eye.down[c])) +
                   fma(u, S(rest.right[c]), fma(v, S(rest.down[c]), S(rest.forward[c])));
    }
    const S inverse = S(1) / sqrt(dot(d, d));
    const Vec3<S> direction = scale(inverse, d);
    for (int c = 0; c < 3; ++c) lacks[c] = fma(inverse, lacks[c], product_lacks(inverse, S(d[c]), S(direction[c])));
    const Vec3<S> across = cross(direction, lacks);
    return fma(S(1.001), sqrt(dot(across, across)), S(slack.eye_turn));
}

}  // namespace strahl::inline STRAHL_LEVEL
