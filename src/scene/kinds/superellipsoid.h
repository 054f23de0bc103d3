// The superellipsoid: a ball, a cylinder, a box with rounded edges, a double cone, and what lies between these.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>

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
/// How precise powers are: as those of floats, as some digits more than these, or as those of doubles.
enum class Digits { of_floats, some, all };
template <Digits digits, class V>
STRAHL_INLINE V power_with(const V& x, const V& p) {
    if constexpr (digits == Digits::all)
        return power_by_series(x, p);
    else
        return digits == Digits::some ? power_by_series<6, 9>(x, p) : power_by_series<4, 7>(x, p);
}
/// Returns (u^p + v^p)^(1/p) for u, v >= 0 and p >= 1, and its derivatives. Only powers of the ratio of the smaller to
/// the larger are taken, so that nothing overflows.
template <Digits digits, class V>
STRAHL_INLINE SizeOfPair<V> size_of_pair(const V& u, const V& v, const V& p) {
    using R = Element<V>;
    const V one(1), large = max(u, v), small = min(u, v);
    // A smaller ratio changes nothing; it may be 0 to the power 0.
    const V ratio = max(small / max(large, V(std::numeric_limits<R>::min())), V(R(0x1p-70)));
    const V more = power_with<digits>(ratio, p), growth = power_with<digits>(V(one + more), V(one / p));
    const V by_large = growth / (one + more), by_small = by_large * (more / ratio);
    return {large * growth, select(u < v, by_small, by_large), select(u < v, by_large, by_small)};
}
/// Returns ((|x|^p + |y|^p)^(q/p) + |z|^q)^(1/q). For p, q >= 1 it is a norm: along a line it is convex, and its
/// derivatives are neither infinite nor all 0.
template <class V, Digits digits = Digits::all>
STRAHL_INLINE SizeOfPoint<V> superellipsoid_size(const Vec3<V>& at, const V& p, const V& q) {
    const auto signed_as = [](const V& c, const V& slope) { return select(c < V(0), -slope, slope); };
    const SizeOfPair<V> level = size_of_pair<digits>(V(abs(at.x)), V(abs(at.y)), p);
    const SizeOfPair<V> whole = size_of_pair<digits>(level.size, V(abs(at.z)), q);
    return {whole.size,
            {signed_as(at.x, whole.by_u * level.by_u), signed_as(at.y, whole.by_u * level.by_v),
             signed_as(at.z, whole.by_v)}};
}

/// Lines along which the function falls to `level`: they come from `end`, in the direction in which they are followed,
/// and have got to `t`, which is infinite where they miss.
template <class V>
struct SoughtLine {
    Vec3<V> from, d;
    V p, q, level, end, t;

    STRAHL_INLINE Mask<V> sought() const { return t < V(std::numeric_limits<Element<V>>::infinity()); }
    STRAHL_INLINE void miss(Mask<V> lanes) { t = select(lanes, V(std::numeric_limits<Element<V>>::infinity()), t); }
    /// Returns how far the function is above the level, and its slope.
    template <Digits digits>
    STRAHL_INLINE std::pair<V, V> here() const {
        const SizeOfPoint<V> at = superellipsoid_size<V, digits>(fma(t, d, from), p, q);
        return {at.size - level, dot(at.slopes, d)};
    }
    /// Takes Newton's steps from outside until they are short, or might lead too far.
    STRAHL_INLINE void approach_roughly() {
        using R = Element<V>;
        constexpr bool floats = std::is_same_v<R, float>;
        const V margin(floats ? R(0x1p-18) : R(0x1p-26)), flat(R(0x1p-14)), least(floats ? R(0x1p-10) : R(0x1p-16));
        Mask<V> lanes = sought();
        for (int i = 0; i < 50 && any(lanes); ++i) {
            const auto [off, slope] = here < floats ? Digits::of_floats : Digits::some > ();
            const Mask<V> outside = lanes & (off > margin), goes_on = outside & (slope < -flat);
            const V step = select(goes_on, -off / slope, V(0));
            t = t + step;
            miss(outside & (slope > flat));
            lanes = goes_on & (step > least);
        }
    }
    /// Takes them until they are no longer than `least`. Towards where a convex function is 0 they never pass that from
    /// outside, and a slope that does not fall before tells that the line misses it; the first may come back from
    /// inside. Lines that began at a wrong place begin anew at the end.
    template <Digits digits>
    STRAHL_INLINE void approach(const V& least) {
        const V zero(0);
        Mask<V> lanes = sought();
        for (int i = 0; i < 100 && any(lanes); ++i) {
            const auto [off, slope] = here<digits>();
            const Mask<V> falls = lanes & (slope < zero), stays = lanes & !falls;
            const V step = select(falls, -off / slope, zero);
            t = t + step;
            if (i == 0) {
                t = select(stays, end, t);
                lanes = stays | (falls & (abs(step) > least));
            } else {
                miss(stays & (off > zero));
                lanes = falls & (step > least);
            }
        }
    }
};
/// Keeps such lines without gaps, for packs S of rays from both sides.
template <class S>
struct SoughtLines {
    using V = Doubles<S>;
    using R = Element<V>;
    /// Spares rays of floats the digits of doubles, which they would round away.
    static constexpr Digits digits = std::is_same_v<S, V> ? Digits::all : Digits::some;
    static constexpr int fields = sizeof(SoughtLine<V>) / sizeof(V), room = 3 * width<S>;
    alignas(64) R columns[fields][room];
    int count = 0;

    STRAHL_INLINE void add(const SoughtLine<V>& line, Mask<V> lanes) {
        const V* const own = reinterpret_cast<const V*>(&line);
        for (int f = 0; f < fields; ++f) compress(columns[f] + count, own[f], lanes);
        count += std::popcount(bits(lanes));
    }
    /// Takes steps along all lines that were added, the first of them in floats.
    STRAHL_INLINE void approach(const V& least) {
        R* const t = columns[fields - 1];
        for (int k = count; k % width<S> != 0; ++k) t[k] = std::numeric_limits<R>::infinity();
        for (int first = 0; first < count; first += width<S>) {
            auto rough = of_fields<SoughtLine<S>, S>([&](std::size_t f) __attribute__((always_inline)) {
                return load_converted<S>(columns[f] + first);
            });
            rough.approach_roughly();
            for (int k = 0; k < width<S> / width<V>; ++k) store_lanes(t + first + k * width<V>, doubles_of(rough.t, k));
        }
        for (int first = 0; first < count; first += width<V>) {
            auto line = load_items<SoughtLine<V>, V>(columns[0], room, first);
            line.template approach<digits>(least);
            store_lanes(t + first, line.t);
        }
    }
};

/// Returns where lines enter and leave a box around the superellipsoid; behind each other if they miss it.
template <class V>
STRAHL_INLINE std::pair<V, V> ends_in_box(const Vec3<V>& from, const Vec3<V>& d, const V& half) {
    using R = Element<V>;
    V enter(R(-4)), leave(R(4));
    for (int c = 0; c < 3; ++c) {
        const V small(R(1e-30)), per = V(1) / select(abs(d[c]) < small, small, d[c]);
        const V middle = -from[c] * per, width = half * abs(per);
        enter = max(enter, middle - width), leave = min(leave, middle + width);
    }
    return {enter, leave};
}

/// Returns the span of rays within the superellipsoid. Of rays that start on the surface the function is counted from
/// its value at the start, which is rounded.
template <class S>
STRAHL_INLINE Span<S> superellipsoid_span(const Ray<S>& ray, const S& p, const S& q, Mask<S> starts, Mask<S> all) {
    using V = Doubles<S>;
    using R = Element<V>;
    constexpr int parts = width<S> / width<V>;
    if (none(all)) return {S(0), S(0), all};
    SoughtLines<S> lines;
    std::array<SoughtLine<V>, parts> behind;
    alignas(64) R shifts[width<S>], found[2][width<S>] = {};
    unsigned sought[2] = {};
    for (int k = 0; k < parts; ++k) {
        const Mask<V> here = mask_of<V>(bits(starts) >> (k * width<V>));
        const Vec3<V> origin = doubles_of(ray.origin, k), d = doubles_of(ray.direction, k);
        const V own_p = doubles_of(p, k), own_q = doubles_of(q, k);
        // Counted from where the ray is nearest to the centre, nothing cancels for far origins.
        const V shift = select(here, V(0), -dot(origin, d));
        store_lanes(shifts + k * width<V>, shift);
        const Vec3<V> from = fma(shift, d, origin);
        V level(1);
        Mask<V> leaves = here;
        if (any(here)) {
            const SizeOfPoint<V> start = superellipsoid_size<V, SoughtLines<S>::digits>(origin, own_p, own_q);
            level = select(here, start.size, level);
            leaves = here & (dot(start.slopes, d) >= V(0));
        }
        const auto [enter, leave] = ends_in_box(from, d, V(R(1 + 0x1p-14) * max(V(1), level)));
        const Mask<V> ahead = mask_of<V>(bits(all) >> (k * width<V>)) & (here | (enter < leave)) & !leaves;
        behind[k] = {from, -d, own_p, own_q, level, -leave, -leave};
        lines.add({from, d, own_p, own_q, level, enter, enter}, ahead & !here);
        sought[0] |= bits(ahead & !here) << (k * width<V>), sought[1] |= bits(ahead) << (k * width<V>);
    }
    unsigned hit = bits(starts) | sought[0];
    if (sought[1]) {
        for (int k = 0; k < parts; ++k) lines.add(behind[k], mask_of<V>(sought[1] >> (k * width<V>)));
        lines.approach(V(std::is_same_v<S, V> ? std::sqrt(std::numeric_limits<R>::epsilon()) / 16 : R(0x1p-15)));
        const R* t = lines.columns[lines.fields - 1];
        unsigned missed = 0;
        for (int side = 0; side < 2; ++side)
            for (unsigned left = sought[side]; left; left &= left - 1) {
                const int k = std::countr_zero(left);
                if (!(*t < std::numeric_limits<R>::infinity())) missed |= 1U << k;
                found[side][k] = (side == 0 ? *t : -*t) + shifts[k], ++t;
            }
        for (; missed; missed &= missed - 1) {
            const int k = std::countr_zero(missed);
            found[0][k] = found[1][k] = 0;
            if (sought[0] >> k & 1) hit &= ~(1U << k);
        }
    }
    return {load_converted<S>(found[0]), load_converted<S>(found[1]), mask_of<S>(hit)};
}
template <class S>
[[gnu::noinline]] Span<S> call_superellipsoid_span(const Ray<S>& ray, const S& p, const S& q, Mask<S> starts,
                                                   Mask<S> all) {
    return superellipsoid_span<S>(ray, p, q, starts, all);
}

/// All points of size 1 and less, by the powers p and q. Floats are converted to doubles: rounded edges bend much.
template <class T>
struct SuperellipsoidKernel {
    static constexpr int faces = 1;
    T p, q;

    /// Finds it by a call for packs: the code is long, and the call costs little.
    template <class S>
    STRAHL_INLINE Span<S> span(const Ray<S>& ray, S start, Mask<S> lanes = all_lanes<S>()) const {
        if constexpr (width<S> == 1)
            return superellipsoid_span<S>(ray, S(p), S(q), lanes & (start == S(0)), lanes);
        else
            return call_superellipsoid_span<S>(ray, S(p), S(q), lanes & (start == S(0)), lanes);
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
              "roundness of its outline seen along the z axis: near 0 it is a square, 1 a circle, 2 a square on its "
              "corner",
              Range::positive},
        Field{"roundness along", &Superellipsoid::n,
              "roundness of its outline seen across the z axis; both are from .000001 to 2", Range::positive});
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
