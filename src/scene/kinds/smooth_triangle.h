// The triangle whose normal bends between its corners, so that many of them look like a curved surface.
#pragma once
#include <algorithm>
#include <array>
#include <tuple>

#include "scene/kinds/triangle.h"

namespace strahl {

/// The normals of the corners are all scaled by the same factor, so that the longest has length 1.
template <class T>
struct SmoothTriangleKernel {
    TriangleKernel<T> flat;
    Vec3<T> normal_a, normal_b, normal_c;

    Box bounds() const { return flat.bounds(); }
    template <class S>
    STRAHL_INLINE Span<S> span(const LineFrame<S>& line, const Ray<S>& ray, S start) const {
        return flat.span(line, ray, start);
    }
    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        return flat.span(ray, start);
    }
    template <class S>
    STRAHL_INLINE Mask<S> starts_near(const Ray<S>& ray, const S& t, const S& distance) const {
        return flat.starts_near(ray, t, distance);
    }
    /// The bent normal faces the ray where the flat triangle's does: where it bends away it is turned round, as in
    /// POV-Ray.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S, S) const {
        const SeenTriangle<S> triangle = flat.seen(ray);
        const Vec3<S> across = flat.normal(ray);
        const Vec3<S> bent = fma(triangle.of_a, splat<S>(normal_a),
                                 fma(triangle.of_b, splat<S>(normal_b), scale(triangle.of_c, splat<S>(normal_c))));
        const S length = sqrt(dot(bent, bent));
        const Vec3<S> n = select(length > S(0), scale(S(1) / length, bent), across);
        const Mask<S> turned = dot(ray.direction, n) * dot(ray.direction, across) < S(0);
        return {flat.position(triangle), select(turned, -n, n)};
    }
};

/// Transforms normals from a shape's own space to the world's: by the transposed inverse, up to a factor of either
/// sign, which does not matter.
class NormalTransform {
  public:
    explicit NormalTransform(const glm::dmat4& matrix) {
        const glm::dmat3 m(matrix);
        double largest = 0;
        for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(m[i].x), std::abs(m[i].y), std::abs(m[i].z)});
        const DVec3 x = m[0] / largest, y = m[1] / largest, z = m[2] / largest;
        columns = {cross_product(y, z), cross_product(z, x), cross_product(x, y)};
    }
    DVec3 operator()(const DVec3& n) const { return n.x * columns[0] + n.y * columns[1] + n.z * columns[2]; }

  private:
    std::array<DVec3, 3> columns;
};
template <class T>
SmoothTriangleKernel<T> smooth_kernel(const TriangleKernel<T>& flat, const DVec3& a, const DVec3& b, const DVec3& c) {
    const double longest = std::max({length(a), length(b), length(c)});
    return {flat, cast<T>(a / longest), cast<T>(b / longest), cast<T>(c / longest)};
}

/// A triangle with normals of any length at its corners.
struct SmoothTriangle {
    DVec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
    DVec3 normal_a{0, 0, 1}, normal_b{0, 0, 1}, normal_c{0, 0, 1};

    bool operator==(const SmoothTriangle&) const = default;

    static constexpr const char* name = "smooth_triangle";
    static constexpr int faces = 1, max_crossings = 1;
    static constexpr bool bounded = true, convex = true, closed = false, hot = false, compact = true;
    static constexpr auto fields = std::make_tuple(
        Field{"first corner", &SmoothTriangle::a, "a corner"},
        Field{"second corner", &SmoothTriangle::b, "another corner"},
        Field{"third corner", &SmoothTriangle::c, "the third, not on their line"},
        Field{"first normal", &SmoothTriangle::normal_a, "the normal at the first corner", Range::direction},
        Field{"second normal", &SmoothTriangle::normal_b, "the normal at the second corner", Range::direction},
        Field{"third normal", &SmoothTriangle::normal_c, "the normal at the third corner", Range::direction});
    const char* fault() const {
        if (Triangle::flat(a, b, c)) return "the three corners lie on one line";
        for (const DVec3& n : {normal_a, normal_b, normal_c})
            if (!(length(n) > 0)) return "one of its normals has no direction";
        return nullptr;
    }
    Box bounds() const { return Triangle{a, b, c}.bounds(); }
    bool contains(const DVec3&) const { return false; }
    auto pov() const { return std::tuple("smooth_triangle", a, normal_a, b, normal_b, c, normal_c); }

    template <class T>
    using Kernels = std::tuple<SmoothTriangleKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const TriangleKernel<T> flat{cast<T>(to_world.point(a)), cast<T>(to_world.point(b)),
                                     cast<T>(to_world.point(c))};
        const NormalTransform turn(to_world.matrix);
        emit(smooth_kernel(flat, turn(normalize(normal_a)), turn(normalize(normal_b)), turn(normalize(normal_c))));
    }
};

}  // namespace strahl
