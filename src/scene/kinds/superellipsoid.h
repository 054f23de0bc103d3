// The superellipsoid: a ball, a cylinder, a box with rounded edges, a double cone, and what lies between these.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>

#include "num/lane_math.h"
#include "scene/kinds/affine.h"
#include "scene/kinds/field.h"

namespace strahl {

/// A number with its derivatives by x, y and z, or by u and v.
template <class V>
struct SizeOfPoint {
    V size;
    Vec3<V> slopes;
};
template <class V>
struct SizeOfPair {
    V size, by_u, by_v;
};
/// Returns (u^p + v^p)^(1/p) for u, v >= 0 and p >= 1, and its derivatives. Only powers of the ratio of the smaller to
/// the larger are taken, so that nothing overflows.
template <class V>
STRAHL_INLINE SizeOfPair<V> size_of_pair(const V& u, const V& v, const V& p) {
    using R = Element<V>;
    const V one(1), large = max(u, v), small = min(u, v);
    // A smaller ratio changes nothing; it may be 0 to the power 0.
    const V ratio = max(small / max(large, V(std::numeric_limits<R>::min())), V(R(0x1p-70)));
    const V more = power_of_double(ratio, p), growth = power_of_double(V(one + more), V(one / p));
    const V by_large = growth / (one + more), by_small = by_large * (more / ratio);
    return {large * growth, select(u < v, by_small, by_large), select(u < v, by_large, by_small)};
}
/// Returns ((|x|^p + |y|^p)^(q/p) + |z|^q)^(1/q). For p, q >= 1 it is a norm: along a line it is convex, and its
/// derivatives are neither infinite nor all 0.
template <class V>
STRAHL_INLINE SizeOfPoint<V> superellipsoid_size(const Vec3<V>& at, const V& p, const V& q) {
    const auto signed_as = [](const V& c, const V& slope) { return select(c < V(0), -slope, slope); };
    const SizeOfPair<V> level = size_of_pair<V>(abs(at.x), abs(at.y), p);
    const SizeOfPair<V> whole = size_of_pair<V>(level.size, abs(at.z), q);
    return {whole.size,
            {signed_as(at.x, whole.by_u * level.by_u), signed_as(at.y, whole.by_u * level.by_v),
             signed_as(at.z, whole.by_v)}};
}

/// Returns the span of rays within the superellipsoid. From either side, Newton's steps towards where a convex function
/// is 0 never pass that, and a slope that does not fall before tells that the line misses it. Of rays that `start` on
/// the surface the function is counted from its value at the start, which is rounded.
template <class V>
STRAHL_INLINE Span<V> superellipsoid_span(const Ray<V>& ray, const V& p, const V& q, Mask<V> starts) {
    using R = Element<V>;
    const V zero(0), one(1), reach(R(1.75)), least(std::sqrt(std::numeric_limits<R>::epsilon()) / 16);
    const Vec3<V>& d = ray.direction;
    // Counted from where the ray is nearest to the centre, nothing cancels for far origins.
    const V shift = select(starts, zero, -dot(ray.origin, d));
    const Vec3<V> middle = fma(shift, d, ray.origin);
    Mask<V> hit = starts | (dot(middle, middle) < reach * reach), leaves = starts;
    V level = one;
    const auto at = [&](const V& t) __attribute__((always_inline)) {
        return superellipsoid_size<V>(fma(t, d, middle), p, q);
    };
    if (any(starts)) {
        const SizeOfPoint<V> here = at(zero);
        level = select(starts, here.size, one), leaves = starts & (dot(here.slopes, d) >= zero);
    }
    const auto approach = [&](V t, const V& way, Mask<V> lanes) __attribute__((always_inline)) {
        for (int i = 0; i < 100 && any(lanes); ++i) {
            const SizeOfPoint<V> here = at(t);
            const V off = here.size - level, slope = way * dot(here.slopes, d);
            const Mask<V> outside = lanes & (off > zero), misses = outside & !(slope < zero);
            hit = hit & !misses;
            const V step = select(outside & !misses, -off / slope, zero);
            t = fma(way, step, t);
            lanes = step > least;
        }
        return t;
    };
    const V near = approach(-reach, one, hit & !starts);
    const V far = approach(select(starts, reach + reach, reach), -one, hit & !leaves);
    leaves = leaves | (starts & !hit);
    return {select(starts, zero, near + shift), select(leaves, zero, max(near, far) + shift), Mask<V>(hit | starts)};
}
template <class V>
[[gnu::noinline]] Span<V> call_superellipsoid_span(const Ray<V>& ray, const V& p, const V& q, Mask<V> starts) {
    return superellipsoid_span<V>(ray, p, q, starts);
}

/// All points of size 1 and less, by the powers p and q. Floats are converted to doubles: rounded edges bend much.
template <class T>
struct SuperellipsoidKernel {
    static constexpr int faces = 1;
    T p, q;

    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start) const {
        using V = Doubles<S>;
        S near(0), far(0);
        unsigned hit = 0;
        for (int part = 0; part < width<S> / width<V>; ++part) {
            const Ray<V> own{doubles_of(ray.origin, part), doubles_of(ray.direction, part), V(0)};
            const V own_p = doubles_of(S(p), part), own_q = doubles_of(S(q), part);
            const Span<V> found = span_of(own, own_p, own_q, doubles_of(start, part) == V(0));
            near = near + lanes_of<S>(found.near, part), far = far + lanes_of<S>(found.far, part);
            hit |= bits(found.hit) << part * width<V>;
        }
        return {near, far, mask_of<S>(hit)};
    }
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S) const {
        using V = Doubles<S>;
        SurfacePoint<S> point{fma(t, ray.direction, ray.origin), {S(0), S(0), S(0)}};
        for (int part = 0; part < width<S> / width<V>; ++part) {
            const V own_p = doubles_of(S(p), part), own_q = doubles_of(S(q), part);
            const Vec3<V> slopes = superellipsoid_size<V>(doubles_of(point.position, part), own_p, own_q).slopes;
            const V length = sqrt(dot(slopes, slopes));
            for (int c = 0; c < 3; ++c) point.normal[c] = point.normal[c] + lanes_of<S>(slopes[c] / length, part);
        }
        return point;
    }

  private:
    /// Finds it by a call for packs: the code is long, and the call costs little.
    template <class V>
    STRAHL_INLINE static Span<V> span_of(const Ray<V>& ray, const V& p, const V& q, Mask<V> starts) {
        if constexpr (std::is_same_v<V, Element<V>>)
            return superellipsoid_span<V>(ray, p, q, starts);
        else
            return call_superellipsoid_span<V>(ray, p, q, starts);
    }
};

/// All points with (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1, as in POV-Ray: A. Barr, "Superquadrics and
/// Angle-Preserving Transformations", 1981. It is convex, as neither e nor n is above 2.
struct Superellipsoid {
    double e = .25, n = .25;

    bool operator==(const Superellipsoid&) const = default;

    static constexpr const char* name = "superellipsoid";
    static constexpr int faces = 1, max_crossings = 2;
    static constexpr bool bounded = true, convex = true, closed = true, hot = false, arguments_move = false;
    static constexpr auto fields = std::make_tuple(
        Field{"roundness across", &Superellipsoid::e,
              "of its outline seen along the z axis: near 0 it is a square, 1 a circle, 2 a square on its corner",
              Range::positive},
        Field{"roundness along", &Superellipsoid::n,
              "of its outline seen across the z axis, likewise; both are from .000001 to 2", Range::positive});
    static constexpr double least = 1e-6, most = 2;
    const char* fault() const {
        return std::min(e, n) >= least && std::max(e, n) <= most ? nullptr : "its roundness is not from .000001 to 2";
    }
    Box bounds() const { return {DVec3(-1), DVec3(1)}; }
    bool contains(const DVec3& p) const { return superellipsoid_size<double>(p, 2 / e, 2 / n).size < 1; }
    auto pov() const { return std::tuple(name, std::array{e, n}); }

    template <class T>
    using Kernels = std::tuple<AffineKernel<SuperellipsoidKernel<T>, T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        emit(affine<T>(SuperellipsoidKernel<T>{static_cast<T>(2 / e), static_cast<T>(2 / n)}, DVec3(0), 1,
                       transformed(bounds(), to_world.matrix), bounds(), to_world));
    }
};

}  // namespace strahl
