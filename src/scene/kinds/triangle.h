// The triangle: a flat surface without thickness or inside; many of them make a mesh.
#pragma once
#include <cmath>
#include <initializer_list>
#include <limits>
#include <tuple>

#include "num/ray.h"
#include "num/vec_math.h"
#include "scene/kinds/field.h"
#include "scene/kinds/world_transform.h"

namespace strahl {

/// Says how a line goes: along the coordinate in which it gets furthest, and sideways in the other two (after Woop et
/// al., as below).
template <class S>
struct LineFrame {
    Mask<S> most_x, most_y;  // the lanes in which that is x, or y
    int axis;                // its number if it is the same in all lanes, else 3
    S along, shear_x, shear_y;

    STRAHL_INLINE explicit LineFrame(const Vec3<S>& d) {
        const S x = abs(d.x), y = abs(d.y), z = abs(d.z);
        most_x = (x >= y) & (x >= z), most_y = (y >= z) & !most_x;
        axis = all(most_x) ? 0 : all(most_y) ? 1 : none(most_x | most_y) ? 2 : 3;
        Vec3<S> way = d;
        roll(way);
        along = way.z;
        const S per = S(1) / along;
        shear_x = way.x * per, shear_y = way.y * per;
    }
    /// Changes vectors from the line's start: x and y become how far they are beside the line, measured across the
    /// coordinate along which it goes, and z that coordinate.
    template <class... Vectors>
    STRAHL_INLINE void see(Vectors&... v) const {
        roll(v...);
        ((v.x = fma(-shear_x, v.z, v.x), v.y = fma(-shear_y, v.z, v.y)), ...);
    }

  private:
    /// Changes the order of coordinates so that the one along which the line goes is the last.
    template <class... Vectors>
    STRAHL_INLINE void roll(Vectors&... v) const {
        if (axis == 0) {
            ((v = {v.y, v.z, v.x}), ...);
        } else if (axis == 1) {
            ((v = {v.z, v.x, v.y}), ...);
        } else if (axis == 3) {
            const auto pick = [&](const S& x, const S& y, const S& z) __attribute__((always_inline)) {
                return select(most_x, x, select(most_y, y, z));
            };
            ((v = {pick(v.y, v.z, v.x), pick(v.z, v.x, v.y), pick(v.x, v.y, v.z)}), ...);
        }
    }
};

/// A triangle seen along a line: the areas of the three triangles that the line makes with its sides, each belonging to
/// the opposite corner. All have the same sign if the line passes through the triangle.
///
/// Watertight: a corner looks the same in all triangles that share it, and whether the line passes a side on the left
/// or on the right is decided exactly for corners as they look, the opposite for the triangle beyond that side. A line
/// through a side or a corner is taken to pass a little to the right of it and still less above, so that of the
/// triangles around it each surface is crossed once. (After S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
/// Intersection", 2013, and H. Edelsbrunner, E. Mücke, "Simulation of Simplicity", 1990)
template <class S>
struct SeenTriangle {
    Vec3<S> a, b, c;  // from the ray's origin, in the line's frame
    S along, of_a, of_b, of_c;
    Mask<S> crossed;

    /// Takes corners from the ray's origin.
    STRAHL_INLINE SeenTriangle(const LineFrame<S>& line, const Vec3<S>& from_a, const Vec3<S>& from_b,
                               const Vec3<S>& from_c)
        : a(from_a), b(from_b), c(from_c), along(line.along) {
        line.see(a, b, c);
        const S zero(0);
        of_a = area(b, c), of_b = area(c, a), of_c = area(a, b);
        crossed = one_sign(of_a, of_b, of_c);
        if (none((of_a == zero) | (of_b == zero) | (of_c == zero))) [[likely]]
            return;
        crossed = one_sign(side(of_a, b, c), side(of_b, c, a), side(of_c, a, b));
        of_a = select(of_a + of_b + of_c == zero, S(1), of_a);  // where areas underflow any point of it will do
    }
    STRAHL_INLINE S depth() const {
        return fma(of_a, a.z, fma(of_b, b.z, of_c * c.z)) / ((of_a + of_b + of_c) * along);
    }

  private:
    STRAHL_INLINE static Mask<S> one_sign(const S& u, const S& v, const S& w) {
        const S zero(0);
        return ((u > zero) & (v > zero) & (w > zero)) | ((u < zero) & (v < zero) & (w < zero));
    }
    /// The difference of two products and of what rounding took from the second: off by two units in the last place,
    /// however much cancels. So the sign is right, and where the line passes a narrow triangle is known as well as its
    /// corners are. (W. Kahan; C.-P. Jeannerod, N. Louvet, J.-M. Muller, "Further Analysis of Kahan's Algorithm for the
    /// Accurate Computation of 2x2 Determinants", 2013)
    STRAHL_INLINE static S area(const Vec3<S>& p, const Vec3<S>& q) {
        const S second = p.y * q.x;
        return fma(p.x, q.y, -second) - fma(p.y, q.x, -second);
    }
    /// The sign of the area if the line were moved by next to nothing, and across by next to nothing of that.
    STRAHL_INLINE static S side(const S& area, const Vec3<S>& p, const Vec3<S>& q) {
        const S moved = select(area == S(0), p.y - q.y, area);
        return select(moved == S(0), q.x - p.x, moved);
    }
};

template <class T>
struct TriangleKernel {
    Vec3<T> a, b, c;

    Box bounds() const {
        Box box;
        for (const Vec3<T>& corner : {a, b, c}) box.add(DVec3(corner));
        return box;
    }
    template <class S>
    STRAHL_INLINE SeenTriangle<S> seen(const LineFrame<S>& line, const Ray<S>& ray) const {
        return {line, splat<S>(a) - ray.origin, splat<S>(b) - ray.origin, splat<S>(c) - ray.origin};
    }
    template <class S>
    STRAHL_INLINE SeenTriangle<S> seen(const Ray<S>& ray) const {
        return seen(LineFrame<S>(ray.direction), ray);
    }
    /// A ray crosses once and comes from outside on both sides: `near` is at -infinity.
    template <class S>
    STRAHL_INLINE Span<S> span(const LineFrame<S>& line, const Ray<S>& ray, S start) const {
        constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
        const SeenTriangle<S> triangle = seen(line, ray);
        const Mask<S> hit = triangle.crossed & !(start == S(0));
        if (none(hit)) return {S(-inf), S(inf), hit};
        return {S(-inf), triangle.depth(), hit};
    }
    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        return span(LineFrame<S>(ray.direction), ray, start);
    }
    /// Returns the point where the line passes through the triangle.
    template <class S>
    STRAHL_INLINE Vec3<S> position(const SeenTriangle<S>& triangle) const {
        const Vec3<S> p = splat<S>(a);
        const S whole = triangle.of_a + triangle.of_b + triangle.of_c;
        return fma(triangle.of_b / whole, splat<S>(b) - p, fma(triangle.of_c / whole, splat<S>(c) - p, p));
    }
    /// The normal (b - a) x (c - a) of length 1; towards the ray if the corners are nearly on a line.
    template <class S>
    STRAHL_INLINE Vec3<S> normal(const Ray<S>& ray) const {
        const Vec3<S> p = splat<S>(a), n = cross(splat<S>(b) - p, splat<S>(c) - p);
        const S longest = max(abs(n.x), max(abs(n.y), abs(n.z)));
        const Mask<S> known = longest > S(0);
        const Vec3<S> m = select(known, scale(S(1) / longest, n), -ray.direction);
        return scale(S(1) / sqrt(dot(m, m)), m);
    }
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S, S) const {
        return {position(seen(ray)), normal(ray)};
    }
    /// Does a ray that crosses at `t` start nearer than `distance` to the triangle's plane?
    template <class S>
    STRAHL_INLINE Mask<S> starts_near(const Ray<S>& ray, const S& t, const S& distance) const {
        const Vec3<S> p = splat<S>(a), n = cross(splat<S>(b) - p, splat<S>(c) - p);
        const S height = t * dot(n, ray.direction);
        return height * height <= distance * distance * dot(n, n);
    }
};

template <class T>
STRAHL_INLINE bool is_corner(const TriangleKernel<T>& triangle, const Vec3<T>& p) {
    for (const Vec3<T>* corner : {&triangle.a, &triangle.b, &triangle.c})
        if (corner->x == p.x && corner->y == p.y && corner->z == p.z) return true;
    return false;
}
template <class T>
STRAHL_INLINE bool share_a_corner(const TriangleKernel<T>& v, const TriangleKernel<T>& w) {
    return is_corner(v, w.a) || is_corner(v, w.b) || is_corner(v, w.c);
}
/// The height of a corner of a second triangle above the plane of the first: 0 for shared corners, and within rounding.
template <class T>
STRAHL_INLINE T height_above(const TriangleKernel<T>& first, const Vec3<T>& corner) {
    const Vec3<T> e = first.b - first.a, f = first.c - first.a, n = cross(e, f), v = corner - first.a;
    const T unsure = 16 * std::numeric_limits<T>::epsilon() * sqrt(dot(e, e)) * sqrt(dot(f, f)) * sqrt(dot(v, v));
    const T height = dot(n, v);
    return is_corner(first, corner) || !(abs(height) > unsure) ? T(0) : height;
}
/// Returns where a ray that starts on the first triangle crosses the other one; 0 if that is not ahead. Rounding may
/// put the start behind or in front of the other triangle; what counts is on which side of the first one's plane the
/// crossing lies.
template <class T>
STRAHL_INLINE T crossing_beside(const TriangleKernel<T>& first, const TriangleKernel<T>& other, const Ray<T>& ray) {
    const SeenTriangle<T> seen = other.seen(ray);
    const T sum = seen.of_a * height_above(first, other.a) + seen.of_b * height_above(first, other.b) +
                  seen.of_c * height_above(first, other.c);
    const Vec3<T> n = cross(first.b - first.a, first.c - first.a);
    const T t = sum / ((seen.of_a + seen.of_b + seen.of_c) * dot(n, ray.direction));
    return t > 0 ? t : T(0);
}

/// A triangle, seen from both sides.
struct Triangle {
    DVec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};

    bool operator==(const Triangle&) const = default;

    static constexpr const char* name = "triangle";
    static constexpr int faces = 1, max_crossings = 1;
    static constexpr bool bounded = true, convex = true, closed = false, hot = false, compact = true;
    static constexpr bool plane_faces = true;
    static constexpr auto fields = std::make_tuple(Field{"first corner", &Triangle::a, "a corner"},
                                                   Field{"second corner", &Triangle::b, "another corner"},
                                                   Field{"third corner", &Triangle::c, "the third, not on their line"});
    /// Do the three points lie on one line, up to rounding?
    static bool flat(const DVec3& a, const DVec3& b, const DVec3& c) {
        const DVec3 u = b - a, v = c - a;
        return !(length(u) > 0) || !(length(v) > 0) || !(length(cross_product(normalize(u), normalize(v))) > 1e-14);
    }
    const char* fault() const { return flat(a, b, c) ? "the three corners lie on one line" : nullptr; }
    Box bounds() const { return TriangleKernel<double>{a, b, c}.bounds(); }
    bool contains(const DVec3&) const { return false; }
    auto pov() const { return std::tuple("triangle", a, b, c); }

    template <class T>
    using Kernels = std::tuple<TriangleKernel<T>>;  // under any transformation a triangle is a triangle
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        emit(TriangleKernel<T>{cast<T>(to_world.point(a)), cast<T>(to_world.point(b)), cast<T>(to_world.point(c))});
    }
};

}  // namespace strahl
