// The box, given by two opposite corners.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "scene/kinds/field.h"
#include "scene/kinds/hit_box.h"

namespace strahl {

/// A box under any transformation, a parallelepiped: local = rows * (world - centre), inside where all three are
/// between -1 and 1. Faces: 0 where x is -1, 1 where it is 1, then those of y and z.
template <class T>
struct BoxKernel {
    static constexpr int faces = 6;
    Vec3<T> centre, row_x, row_y, row_z;
    HitBox<T> box;

    Ball ball() const {
        const DVec3 x(row_x), y(row_y), z(row_z);
        const double volume = dot(x, cross(y, z));
        const DVec3 u = cross(y, z) / volume, v = cross(z, x) / volume, w = cross(x, y) / volume;  // halves of edges
        double square = 0;
        for (const DVec3& diagonal : {u + v + w, u + v - w, u - v + w, u - v - w})
            square = std::max(square, dot(diagonal, diagonal));
        return {DVec3(centre), std::sqrt(square)};
    }

    /// Clips the ray p + t d by a pair of faces. In a face's own plane the division by 0 gives NaN, and max and min
    /// choose so that the face does not clip. So rays in the plane between two boxes that touch meet both of them.
    template <class S>
    STRAHL_INLINE void clip(Span<S>& span, const Vec3<S>& row, int low_face, const Vec3<S>& p, const Vec3<S>& d,
                            S start) const {
        using E = Element<S>;
        const S low(static_cast<E>(low_face)), high(static_cast<E>(low_face + 1)), one(1), minus(-1);
        S place = dot(row, p);
        place = select(start == low, minus, select(start == high, one, place));  // known exactly there
        const S inverse = one / dot(row, d);
        const S to_low = (minus - place) * inverse, to_high = (one - place) * inverse;
        const Mask<S> rises = inverse > S(0);
        const S near = select(rises, to_low, to_high), far = select(rises, to_high, to_low);
        span.near_face = select(span.near < near, select(rises, low, high), span.near_face);
        span.far_face = select(far < span.far, select(rises, high, low), span.far_face);
        span.near = max(span.near, near);
        span.far = min(span.far, far);
    }
    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
        const S zero(0);
        const Mask<S> starts_here = (start >= zero) & (start < S(faces));
        const Vec3<S> d = ray.direction, f = ray.origin - splat<S>(centre);
        // Counted from where the ray is nearest to the centre, nothing cancels for far origins.
        const S shift = select(starts_here, zero, -dot(f, d));
        const Vec3<S> p = fma(shift, d, f);
        Span<S> span{S(-inf), S(inf), zero < zero};
        clip(span, splat<S>(row_x), 0, p, d, start);
        clip(span, splat<S>(row_y), 2, p, d, start);
        clip(span, splat<S>(row_z), 4, p, d, start);
        span.hit = span.near <= span.far;
        span.near = span.near + shift;
        span.far = span.far + shift;
        const S first = first_crossing(span);
        span.hit = span.hit & box.holds(ray, first, abs(first) + abs(shift));
        if (any(starts_here)) {
            // A convex body is never entered again from its own surface. The normal that at() returned tells whether
            // the ray leaves.
            span.hit = span.hit | starts_here;
            span.near = select(starts_here, zero, span.near);
            span.far = select(starts_here & (dot(normal(start), d) >= zero), zero, span.far);
        }
        return span;
    }
    template <class S>
    STRAHL_INLINE Vec3<S> row(S face) const {
        return select(face < S(2), splat<S>(row_x), select(face < S(4), splat<S>(row_y), splat<S>(row_z)));
    }
    /// Is it the face where the coordinate is 1?
    template <class S>
    STRAHL_INLINE Mask<S> high(S face) const {
        return (face == S(1)) | (face == S(3)) | (face == S(5));
    }
    template <class S>
    STRAHL_INLINE Vec3<S> normal(S face) const {
        const Vec3<S> r = row(face);
        return scale(select(high(face), S(1), S(-1)) / sqrt(dot(r, r)), r);
    }
    /// The point at `t`, put back onto the face that was hit.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S face) const {
        const Vec3<S> c = splat<S>(centre), r = row(face), f = fma(t, ray.direction, ray.origin - c);
        const S missing = (select(high(face), S(1), S(-1)) - dot(r, f)) / dot(r, r);
        return {c + fma(missing, r, f), normal(face)};
    }
};

/// Its edges are parallel to the axes of its own space. (`Box` is the type of bounding boxes.)
struct Cuboid {
    DVec3 corner{-1, -1, -1}, opposite{1, 1, 1};

    bool operator==(const Cuboid&) const = default;

    static constexpr const char* name = "box";
    static constexpr int faces = 6, max_crossings = 2;
    static constexpr bool bounded = true, convex = true, closed = true, hot = false, plane_faces = true;
    static constexpr bool arguments_move = false;  // two rotated corners do not describe a rotated box
    static constexpr auto fields = std::make_tuple(Field{"corner", &Cuboid::corner, "a corner"},
                                                   Field{"opposite corner", &Cuboid::opposite, "the opposite corner"});
    const char* fault() const {
        const DVec3 size = bounds().size();
        // Half of the shortest edge must have a reciprocal.
        return std::min({size.x, size.y, size.z}) >= 2 * std::numeric_limits<double>::min() ? nullptr : "it is flat";
    }
    Box bounds() const {
        Box box;
        box.add(corner), box.add(opposite);
        return box;
    }
    bool contains(const DVec3& p) const {
        const Box box = bounds();
        return p.x > box.low.x && p.y > box.low.y && p.z > box.low.z &&  //
               p.x < box.high.x && p.y < box.high.y && p.z < box.high.z;
    }
    /// POV-Ray wants the lower corner first.
    auto pov() const {
        const Box box = bounds();
        return std::tuple("box", box.low, box.high);
    }

    template <class T>
    using Kernels = std::tuple<BoxKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const Box box = bounds();
        const DVec3 size = box.size();
        const glm::dmat3 inverse = glm::inverse(glm::dmat3(to_world.matrix));
        // Squares of rows times coordinates must not overflow. So a box that is thinner becomes a little thicker.
        const double most = std::ldexp(1., std::numeric_limits<T>::max_exponent / 2 - 4);
        const auto row = [&](int i) {
            const DVec3 r(inverse[0][i], inverse[1][i], inverse[2][i]);
            const double largest = std::max({std::fabs(r.x), std::fabs(r.y), std::fabs(r.z)});
            return cast<T>(r * std::min(2 / (size[i] * to_world.scale), most / largest));
        };
        emit(BoxKernel<T>{cast<T>(to_world.point(box.centre())), row(0), row(1), row(2),
                          HitBox<T>::of(transformed(box, to_world.matrix), box, to_world)});
    }
};

}  // namespace strahl
