// Textbook formulas, which fail in float and double, for any number type. In Quadruple they are exact enough to judge.
#pragma once
#include "num/vec.h"
#include "tests/referee/quadruple.h"

namespace strahl::naive {

template <class T>
T times(const Vec3<T>& a, const Vec3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
T length(const Vec3<T>& a) {
    return root(times(a, a));
}
template <class T>
Vec3<T> unit(const Vec3<T>& v) {
    return v / length(v);
}
template <class R, class T>
Vec3<R> to(const Vec3<T>& v) {
    return {static_cast<R>(v.x), static_cast<R>(v.y), static_cast<R>(v.z)};
}

/// Both crossings of a ray with a sphere, or none.
template <class T>
struct Roots {
    T near = 0, far = 0;
    bool hit = false;
};
/// The formula of 1999: b^2 - 4ac. In Quadruple it is exact enough to judge float and double.
template <class T>
Roots<T> sphere(const Vec3<T>& o, const Vec3<T>& d, const Vec3<T>& centre, T radius) {
    const Vec3<T> f = o - centre;
    const T a = times(d, d), b = 2 * times(f, d), c = times(f, f) - radius * radius, discriminant = b * b - 4 * a * c;
    if (!(discriminant >= 0)) return {};
    const T s = root(discriminant);
    return {(-b - s) / (2 * a), (-b + s) / (2 * a), true};
}
/// Avoids the second cancellation: the larger root first, the other from their product.
template <class T>
Roots<T> stable_sphere(const Vec3<T>& o, const Vec3<T>& d, const Vec3<T>& centre, T radius) {
    const Vec3<T> f = o - centre;
    const T a = times(d, d), b = times(f, d), c = times(f, f) - radius * radius, discriminant = b * b - a * c;
    if (!(discriminant >= 0)) return {};
    const T q = b > 0 ? -b - root(discriminant) : root(discriminant) - b;
    const T x = q / a, y = c / q;
    return x < y ? Roots<T>{x, y, true} : Roots<T>{y, x, true};
}
/// The "geometric" formula of books of the nineties: half the chord from r^2 - (l^2 - d^2).
template <class T>
Roots<T> geometric_sphere(const Vec3<T>& o, const Vec3<T>& d, const Vec3<T>& centre, T radius) {
    const Vec3<T> l = centre - o;
    const T along = times(l, d), half = radius * radius - (times(l, l) - along * along);
    if (!(half >= 0)) return {};
    return {along - root(half), along + root(half), true};
}

/// Reflects d at a surface of normal n.
template <class T>
Vec3<T> mirrored(const Vec3<T>& d, const Vec3<T>& n) {
    return d - n * (2 * times(d, n));
}

}  // namespace strahl::naive
