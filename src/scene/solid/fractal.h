// POV-Ray's patterns of fractals, for a double or a pack of doubles: each lane has the bits that its point has alone.
#pragma once
#include <cmath>

#include "num/memory.h"

namespace strahl {

/// How `mandel`, `julia` and `magnet` iterate, and how points are coloured that stay or escape.
struct FractalForm {
    int magnet = 0;  // its type, 1 or 2; 0 for z^exponent + c
    bool julia = false;
    double re = 0, im = 0;  // c of a Julia set
    int iterations = 1, exponent = 2, inside = 0, outside = 1;
    double inside_factor = 1, outside_factor = 1;
};

}  // namespace strahl

namespace strahl::inline STRAHL_LEVEL {

/// A complex number, without the tests for infinities that std::complex has.
template <class S>
struct Complex {
    S re{0}, im{0};
    friend Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
    friend Complex operator*(const Complex& a, const Complex& b) {
        return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
    }
    friend Complex operator*(double a, const Complex& b) { return {S(a) * b.re, S(a) * b.im}; }
    friend Complex operator/(const Complex& a, const Complex& b) {
        const S d = b.re * b.re + b.im * b.im;
        return {(a.re * b.re + a.im * b.im) / d, (a.im * b.re - a.re * b.im) / d};
    }
    S squared() const { return re * re + im * im; }
};

/// Returns the next point of a fractal's sequence.
template <class S>
STRAHL_INLINE Complex<S> next_of(const FractalForm& own, const Complex<S>& z, const Complex<S>& c) {
    const Complex<S> one{S(-1)}, two{S(-2)};
    if (own.magnet == 1) {
        const Complex<S> q = (z * z + c + one) / (2. * z + c + two);
        return q * q;
    }
    if (own.magnet == 2) {
        const Complex<S> product = (c + one) * (c + two);
        const Complex<S> q = (z * z * z + 3. * ((c + one) * z) + product) /
                             (3. * (z * z) + 3. * ((c + two) * z) + product + Complex<S>{S(1)});
        return q * q;
    }
    Complex<S> power = z;
    for (int i = 1; i < own.exponent; ++i) power = power * z;
    return power + c;
}

/// Returns the value of a fractal at <x, y>. Lanes whose points have escaped wait for the others.
template <class S>
[[gnu::noinline]] S fractal_value(const FractalForm& own, const S& x, const S& y) {
    const bool from_zero = own.magnet > 0 && !own.julia;
    const Complex<S> at{x, y}, c = own.julia ? Complex<S>{S(own.re), S(own.im)} : at;
    Complex<S> z = from_zero ? Complex<S>{} : at;
    S least = from_zero ? S(10000) : z.squared(), value(0);
    const auto part = [&](int type, double factor) {
        switch (type) {
            case 2:
                return z.re * S(factor);
            case 3:
                return z.im * S(factor);
            case 4:
                return z.re * z.re * S(factor);
            case 5:
                return z.im * z.im * S(factor);
            default:
                return S(factor);
        }
    };
    Mask<S> stays = first_lanes<S>(width<S>);
    for (int i = 0; i < own.iterations && any(stays); ++i) {
        z = next_of(own, z, c);
        const S squared = z.squared();
        least = min(least, squared);
        Mask<S> escapes = stays & (squared > S(own.magnet > 0 ? 10000 : 4));
        if (own.magnet > 0) escapes = escapes | (stays & ((z + Complex<S>{S(-1)}).squared() < S(1e-4)));
        if (none(escapes)) continue;
        S shown = part(own.outside, own.outside_factor);
        if (own.outside == 1) shown = S(double(i) / own.iterations);
        if (own.outside == 6) shown = sqrt(squared) * S(own.outside_factor);
        if (own.outside == 7 || own.outside == 8) {  // the steps repeat
            const double after = std::floor(own.outside_factor) + (own.outside == 8 ? 1 : 0);
            shown = S(after >= 1 ? std::fmod(i, after) / own.outside_factor : 0);
        }
        value = select(escapes, shown, value), stays = stays & !escapes;
    }
    if (none(stays)) return value;
    S shown = part(own.inside, own.inside_factor);
    if (own.inside == 1) shown = sqrt(least) * S(own.inside_factor);
    if (own.inside == 6) shown = z.re * z.re + z.im * z.im * S(own.inside_factor);
    return select(stays, shown, value);
}

}  // namespace strahl::inline STRAHL_LEVEL
