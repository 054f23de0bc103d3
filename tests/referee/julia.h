// The referee's formulas for Julia sets: products by a table of the units, and crossings by small steps and halving.
#pragma once
#include <algorithm>
#include <array>
#include <complex>

#include "scene/kinds/julia/julia.h"
#include "tests/referee/line.h"

namespace strahl::referee {

/// A number of the units 1, i, j and k, with the rule by which these are multiplied.
template <class R>
struct Units {
    std::array<R, 4> part{};
    bool quaternion = true;

    friend Units operator*(const Units& a, const Units& b) {
        // The product of two units is plus or minus the unit whose number is the exclusive or of theirs.
        constexpr int turn[4][4]{{1, 1, 1, 1}, {1, -1, 1, -1}, {1, -1, -1, 1}, {1, 1, -1, -1}};
        constexpr int commuting[4][4]{{1, 1, 1, 1}, {1, -1, 1, -1}, {1, 1, -1, -1}, {1, -1, -1, 1}};
        Units all{{}, a.quaternion};
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = 0; k < 4; ++k)
                all.part[i ^ k] += R((a.quaternion ? turn : commuting)[i][k]) * a.part[i] * b.part[k];
        return all;
    }
};
/// Returns a function of a hypercomplex number, for which j is another i, and k = i j. There are functions of long
/// doubles alone.
template <class R, class Function>
Units<R> of_both(const Units<R>& z, const Function& function) {
    using C = std::complex<long double>;
    const auto& [x, y, u, v] = z.part;
    const auto of = [&](R a, R b) { return function(C(static_cast<long double>(a), static_cast<long double>(b))); };
    const C first = of(x - v, y + u), second = of(x + v, y - u);
    const auto half = [](long double a, long double b) { return static_cast<R>((a + b) / 2); };
    return {{half(first.real(), second.real()), half(first.imag(), second.imag()), half(first.imag(), -second.imag()),
             half(second.real(), -first.real())},
            false};
}
template <class R>
Units<R> step_of(const JuliaFractal& julia, const Units<R>& z) {
    using C = std::complex<long double>;
    switch (julia.step) {
        case JuliaStep::cube:
            return julia.hypercomplex ? z * z : z * z * z;
        case JuliaStep::square:
            return z * z;
        case JuliaStep::reciprocal:
            return of_both(z, [](const C& a) { return 1.L / a; });
        case JuliaStep::exp:
            return of_both(z, [](const C& a) { return std::exp(a); });
        case JuliaStep::sin:
            return of_both(z, [](const C& a) { return std::sin(a); });
        case JuliaStep::cosh:
            return of_both(z, [](const C& a) { return std::cosh(a); });
        case JuliaStep::atan:
            return of_both(z, [](const C& a) { return std::atan(a); });
        case JuliaStep::acos:
            return of_both(z, [](const C& a) { return std::acos(a); });
        default:
            return of_both(z, [&](const C& a) { return std::pow(a, C(julia.exponent, julia.imaginary)); });
    }
}
/// Returns the square of how far from the origin a number is after so many steps from a point.
template <class R>
R size_after(const JuliaFractal& julia, const Vector<R>& p, int steps) {
    const bool by_function = julia.step > JuliaStep::reciprocal;
    const DVec3& slice = julia.slice;
    const R z = by_function ? p.y : p.z, last(julia.slice_fourth);
    const R length = root(dot(Vector<R>(slice), Vector<R>(slice)) + last * last);
    const R rest = R(julia.distance) * length - dot(Vector<R>(slice), Vector<R>(p.x, p.y, z));
    Units<R> own{{p.x, p.y, z, rest / last}, !julia.hypercomplex};
    for (; steps > 0; --steps) {
        own = step_of(julia, own);
        const R constant[4]{R(julia.constant.x), R(julia.constant.y), R(julia.constant.z), R(julia.fourth)};
        for (std::size_t k = 0; k < 4; ++k) own.part[k] += constant[k];
    }
    R size = 0;
    for (const R part : own.part) size += part * part;
    return size;
}
template <class R>
bool contains(const JuliaFractal& julia, const Vector<R>& p) {
    const R far = R(julia.radius());
    for (int i = 0; i < static_cast<int>(julia.iterations); ++i)
        if (size_after(julia, p, i) > far * far) return false;
    return true;
}
/// Tells no normals. Of the crossings of a line that starts on the surface those near to the start are the start.
template <class R>
LineCrossings<R> crossings(const JuliaFractal& julia, const Line<R>& line, int source) {
    const R length = root(dot(line.direction, line.direction)), far = R(julia.radius());
    const Vector<R> d = R(1) / length * line.direction;
    const R towards = -dot(line.origin, d), steps = far * R(8 * julia.precision);
    const R square = far * far - dot(line.origin, line.origin) + towards * towards;
    LineCrossings<R> found;
    if (!(square > 0)) return found;
    bool inside = false;
    R before = 0;
    for (R i = -steps; i <= steps; ++i) {
        R a = before, b = towards + i / steps * root(square);
        const bool here = contains(julia, line.origin + b * d);
        before = b;
        if (here == inside) continue;
        while (b - a > R(1e-12)) (contains(julia, line.origin + (a + b) / 2 * d) == inside ? a : b) = (a + b) / 2;
        inside = here;
        if (source != 0 || b > R(1e-4) || b < R(-1e-4)) found.add(b / length, 0, {});
    }
    return found;
}

}  // namespace strahl::referee
