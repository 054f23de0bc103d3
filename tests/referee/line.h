// The referee's vectors, lines and their crossings with surfaces, for long double and
// __float128.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "num/vec.h"
#include "tests/referee/quadruple.h"

namespace strahl::referee {

template <class R>
struct Vector {
    R x = 0, y = 0, z = 0;
    Vector() = default;
    Vector(R x, R y, R z) : x(x), y(y), z(z) {}
    Vector(const DVec3& v) : x(v.x), y(v.y), z(v.z) {}
    friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(const Vector& a, const Vector& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend Vector operator*(R s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }
};
template <class R>
R dot(const Vector<R>& a, const Vector<R>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
Vector<R> cross(const Vector<R>& a, const Vector<R>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R>
Vector<R> unit(const Vector<R>& v) {
    return R(1) / root(dot(v, v)) * v;
}

template <class R>
struct Line {
    Vector<R> origin, direction;
    int body = -1, face = -1;  // the surface that the line starts on
};

/// A point where a line passes through a face, with the face's normal out of the body (of any length).
template <class R>
struct Crossing {
    R t;
    int face;
    Vector<R> normal;
};
template <class R>
struct LineCrossings {
    std::vector<Crossing<R>> list;
    void add(R t, int face, const Vector<R>& normal) { list.push_back({t, face, normal}); }
    /// Removes the one that is nearest to the start, which lies on the surface.
    void remove_start() {
        const auto size = [](const Crossing<R>& own) { return own.t < 0 ? -own.t : own.t; };
        if (!list.empty()) list.erase(std::ranges::min_element(list, {}, size));
    }
    auto begin() const { return list.begin(); }
    auto end() const { return list.end(); }
};

/// How a crossing differs from the one wanted: how far it is off along the line, the cosine of the normals, and that of
/// the line and the normal, by which errors along the line are larger than from the surface.
struct CrossingError {
    double off, cosine, slant;
};
/// Compares a crossing at `t` with this normal.
template <class R, class T>
CrossingError error_of(T t, const DVec3& normal, const Crossing<R>& wanted, const DVec3& direction) {
    const Vector<R> own = unit(wanted.normal);
    return {std::fabs(static_cast<double>(t - wanted.t)), static_cast<double>(dot(own, Vector<R>(normal))),
            std::fabs(static_cast<double>(dot(own, Vector<R>(direction))))};
}

/// The roots of a t^2 + 2 b t + c; of a line that starts on the surface one is 0, and only the other is given.
template <class R, class Use>
void roots(R a, R b, R c, bool starts_here, const Use& use) {
    if (!(a > 0)) return;
    if (starts_here) return use(-2 * b / a);
    const R d = b * b - a * c;
    if (!(d > 0)) return;
    const R q = b > 0 ? -(b + root(d)) : root(d) - b;
    use(q / a), use(c / q);
}

}  // namespace strahl::referee
