// The torus about an axis.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "num/vec_math.h"
#include "scene/affine.h"
#include "scene/capsule.h"
#include "scene/field.h"

namespace strahl {

/// All points nearer than `minor` to the circle of radius `major`. One face.
template <class T>
struct TorusKernel {
    static constexpr int faces = 1;
    Vec3<T> centre, axis;  // axis is of length 1
    T major, minor;

    Ball ball() const { return {DVec3(centre), static_cast<double>(major) + static_cast<double>(minor)}; }

    /// A ray p + t d about the torus' centre. Its squared distance from the circle is F(t) = |p + t d|^2 + R^2 - 2 R
    /// rho, where rho^2 = (x + k t)^2 + y^2 is that from the axis: a parabola less a hyperbola's branch, so that F is
    /// convex but between two points left and right of where rho is least, and has a minimum, or two and a maximum.
    /// Turned so that the deeper minimum is on the right.
    template <class S>
    struct Profile {
        S x, y2, k, along, along_d, middle, major, minor, known_rho;  // F' = 2 (t - middle) for R = 0
        Mask<S> starts_here;

        struct Value {
            S gap, distance, slope, curvature, side;  // gap: distance - minor; F' / 2; F'' / 2; x + k t
        };
        STRAHL_INLINE Value operator()(S t) const {
            using E = Element<S>;
            const S side = fma(k, t, x), square = fma(side, side, y2);
            const S rho = sqrt(square), pull = major * k / rho, z = fma(t, along_d, along), q = rho - major;
            const S distance = sqrt(fma(q, q, z * z)), since = t - middle;
            // From a start on the torus, what the distance grows: F(t) - F(0) with t divided out.
            const S grown = t * (since - middle - S(E(2)) * major * k * (side + x) / (rho + known_rho));
            const S gap = select(starts_here, grown / (distance + minor), distance - minor);
            return {gap, distance, fma(-pull, side, since), fma(-pull * k, y2 / square, S(1)), side};
        }
        /// Newton's way along F' to its zero, from where it can't be overshot. `open` are the lanes that want it and,
        /// after it, that found one; `left`: what lies right of the axis is none.
        STRAHL_INLINE S extreme(S t, Mask<S>& open, bool left, bool maximum) const {
            using E = Element<S>;
            const S enough = S(std::numeric_limits<E>::epsilon() / 4) * minor * (major + minor), zero(0);
            Mask<S> going = open;
            for (int i = 0; i < 64 && any(going); ++i) {
                const Value at = (*this)(t);
                const S step = at.slope / at.curvature;
                Mask<S> good = maximum ? Mask<S>(at.curvature < zero) : Mask<S>(at.curvature > zero);
                if (left && !maximum) good = good & (at.side <= zero);
                open = open & (good | !going);
                going = going & good & (abs(at.slope * step) > enough);
                t = select(going, t - step, t);
            }
            return t;
        }
        /// The crossing between a point inside and one outside, by Newton's steps on the distance, and halves where
        /// these leave what is known.
        STRAHL_INLINE S crossing(S inside, S outside, S t, Mask<S> going) const {
            using E = Element<S>;
            const S bits(std::numeric_limits<E>::epsilon()), zero(0), half(E(.5));
            for (int i = 0; i < 200 && any(going); ++i) {
                const Value at = (*this)(t);
                const Mask<S> in = at.gap < zero;
                inside = select(going & in, t, inside);
                outside = select(going & !in, t, outside);
                const S low = min(inside, outside), high = max(inside, outside);
                const S newton = t - at.gap * at.distance / at.slope;
                const Mask<S> there = abs(newton - t) <= bits * abs(t);
                const S next = select(there | ((newton > low) & (newton < high)), newton, half * (low + high));
                const Mask<S> done = there | (high - low <= bits * max(abs(low), abs(high)));
                t = select(going, next, t);
                going = going & !done;
            }
            return t;
        }
    };

    template <class S>
    STRAHL_INLINE Crossings<S, 4> crossings(const Ray<S>& ray, S start) const {
        using E = Element<S>;
        constexpr E inf = std::numeric_limits<E>::infinity();
        constexpr E noise = 4 * std::numeric_limits<E>::epsilon();  // of the direction's part across the axis
        const S zero(0), one(1), major(this->major), minor(this->minor), reach = major + minor, half(E(.5));
        const Vec3<S> a = splat<S>(axis), d = ray.direction, f = ray.origin - splat<S>(centre);
        const Mask<S> starts_here = start == zero;
        const S towards = dot(f, d), shift = select(starts_here, zero, -towards);
        const Vec3<S> p = fma(shift, d, f);
        S middle = select(starts_here, -towards, -dot(p, d));
        const Vec3<S> nearest = fma(middle, d, p);
        const S beyond = fma(reach, reach, -dot(nearest, nearest));
        Mask<S> hit = (beyond > zero) | starts_here;
        Crossings<S, 4> none_at_all{{S(-inf), S(-inf), S(-inf), S(-inf)}, hit};
        if (none(hit)) return none_at_all;

        const S along = dot(p, a);
        S along_d = dot(d, a);
        const Vec3<S> u = across(fma(-along, a, p)), v = across(fma(-along_d, a, d));
        const S vv = dot(v, v);
        const Mask<S> parallel = vv < S(noise * noise);
        S k = select(parallel, zero, sqrt(vv));
        const Vec3<S> e = scale(one / k, v);
        S x = select(parallel, zero, dot(u, e));
        const S y = select(parallel, sqrt(dot(u, u)), dot(a, strahl::cross(u, e)));
        const Mask<S> turned = fma(k, middle, x) < zero;
        x = select(turned, -x, x), along_d = select(turned, -along_d, along_d);
        middle = select(turned, -middle, middle);
        // On the axis F has a kink. Rays that close to it pass it at a distance of some bits.
        const S closest = S(noise) * reach, y2 = max(y * y, closest * closest);
        const Profile<S> profile{x, y2, k, along, along_d, middle, major, minor, sqrt(fma(x, x, y2)), starts_here};

        const S pull = major * k;
        Mask<S> found = hit;
        // The deeper minimum; where there is a second one, on the other side of the axis, and the maximum between them.
        // One loop, so that its code is there once.
        S extremes[3]{middle + pull, middle - pull, -x / k};
        Mask<S> hump = hit & (abs(y) < pull * k);
#pragma GCC unroll 1
        for (int i = 0; i < 3; ++i) {
            extremes[i] = profile.extreme(extremes[i], i == 0 ? found : hump, i == 1, i == 2);
            if (i > 0) continue;
            hit = (hit & (profile(extremes[0]).gap < zero)) | starts_here;
            none_at_all.hit = hit;
            if (none(hit)) return none_at_all;
            hump = hump & hit;
            if (none(hump)) break;
        }
        const S deepest = extremes[0], other = select(hump, extremes[1], deepest),
                top = select(hump, extremes[2], deepest);
        Mask<S> four = hump & (profile(other).gap < zero), first = four;
        four = four & (profile(top).gap > zero);

        Mask<S> rising = starts_here, left = starts_here;
        if (any(starts_here)) {
            const Mask<S> leaves = dot(outwards(f), d) > zero;
            rising = starts_here & ((leaves & !turned) | (turned & !leaves));
            left = starts_here & hump & (zero < half * (top + select(rising, deepest, other)));
            first = first | left;
            four = four | (left & rising);
        }
        const S width = sqrt(max(beyond, zero)) * S(1 + E(8) * std::numeric_limits<E>::epsilon()) +
                        reach * S(E(8) * std::numeric_limits<E>::epsilon());
        // Between a point inside and one outside. One loop, so that its code is there once.
        const S inside[4]{select(first, other, deepest), other, deepest, deepest};
        const S outside[4]{middle - width, top, top, middle + width};
        S t[4]{outside[0], half * (other + top), half * (deepest + top), outside[3]};
#pragma GCC unroll 1
        for (int i = 0; i < 4; ++i) {
            const Mask<S> wanted = i == 0 || i == 3 ? hit : four;
            if (any(wanted)) t[i] = profile.crossing(inside[i], outside[i], t[i], wanted);
        }
        S t0 = t[0], t1 = select(four, t[1], other), t2 = select(four, t[2], top), t3 = t[3];
        if (any(starts_here)) {  // the known one is 0, and the others are where they can be
            const Mask<S> at0 = starts_here & (!rising) & (left | !four), at1 = rising & left;
            const Mask<S> at2 = starts_here & !(rising | at0), at3 = rising & !left, not3 = starts_here & !at3;
            t0 = select(at0, zero, select(starts_here, min(t0, zero), t0));
            t1 = select(at1, zero, select(at0, max(t1, zero), select(starts_here, min(t1, zero), t1)));
            t2 = select(at2, zero, select(at0 | at1, max(t2, zero), select(at3, min(t2, zero), t2)));
            t3 = select(at3, zero, select(not3, max(t3, zero), t3));
        }
        const S first_of_two = select(turned, -t3, t0), last = select(turned, -t0, t3);
        return {{select(four, first_of_two + shift, S(-inf)), select(four, select(turned, -t2, t1) + shift, S(-inf)),
                 select(four, select(turned, -t1, t2), first_of_two) + shift, last + shift},
                hit};
    }
    /// What of `v` is at right angles to the axis, for a `v` that nearly is.
    template <class S>
    STRAHL_INLINE Vec3<S> across(const Vec3<S>& v) const {
        const Vec3<S> a = splat<S>(axis);
        return fma(-dot(v, a), a, v);
    }
    /// The unit vector out from the axis to a point counted from the centre, or 0 where rounding hides it: at the poles
    /// of a spindle.
    template <class S>
    STRAHL_INLINE Vec3<S> out_from_axis(const Vec3<S>& p) const {
        using E = Element<S>;
        const Vec3<S> once = across(p), u = across(once);  // again, for close to the axis the first is rounding
        const S square = dot(u, u), least(std::numeric_limits<E>::min());
        const Mask<S> known = square > max(S(E(.25)) * dot(once, once), least);
        return scale(select(known, S(1) / sqrt(square), S(0)), u);
    }
    /// The normal at a point counted from the centre.
    template <class S>
    STRAHL_INLINE Vec3<S> outwards(const Vec3<S>& p) const {
        const Vec3<S> q = fma(-S(major), out_from_axis(p), p);
        return scale(S(1) / sqrt(dot(q, q)), q);
    }
    /// The point at `t`, put back onto the torus.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const Ray<S>& ray, S t, S) const {
        const Vec3<S> c = splat<S>(centre), p = fma(t, ray.direction, ray.origin - c), out = out_from_axis(p);
        const Vec3<S> put_back = fma(S(minor), outwards(p), scale(S(major), out));
        const Vec3<S> position = c + select(dot(out, out) > S(0), put_back, p);
        return {position, outwards(position - c)};
    }
};

/// All points nearer than `minor` to a circle. If `minor` is the larger radius, the hole in the middle is closed: a
/// spindle torus.
struct Torus {
    DVec3 centre{0, 0, 0}, axis{0, 0, 1};
    double major = 1, minor = .25;

    bool operator==(const Torus&) const = default;

    static constexpr const char* name = "torus";
    static constexpr int faces = 1, max_crossings = 4;
    static constexpr bool bounded = true, convex = false, closed = true, hot = false;
    static constexpr auto fields = std::make_tuple(
        Field{"centre", &Torus::centre, "the point in the middle"},
        Field{"axis", &Torus::axis, "the direction around which the torus lies", Range::direction},
        Field{"major radius", &Torus::major, "from the centre to the middle of the tube", Range::positive},
        Field{"minor radius", &Torus::minor, "that of the tube", Range::positive});
    const char* fault() const { return length(axis) > 0 ? nullptr : "its axis has no direction"; }
    Box bounds() const {
        const DVec3 a = normalize(axis);
        DVec3 reach;
        for (int i = 0; i < 3; ++i) reach[i] = minor + major * std::sqrt(std::max(0., 1 - a[i] * a[i]));
        return {centre - reach, centre + reach};
    }
    bool contains(const DVec3& p) const {
        const DVec3 a = normalize(axis), f = p - centre;
        const double along = dot_product(f, a);
        return std::hypot(length(f - along * a) - major, along) < minor;
    }
    auto pov() const { return std::tuple("torus", major, minor); }
    /// Where POV-Ray's axes and its origin go: its torus lies around the y axis.
    std::array<DVec3, 4> pov_axes() const {
        const DVec3 y = normalize(axis), other = std::abs(y.x) < .5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
        const DVec3 z = normalize(cross_product(other, y));
        return {cross_product(y, z), y, z, centre};
    }
    /// POV-Ray's usual way to solve quartics takes nearly flat ones for cubics.
    static constexpr const char* pov_more = " sturm";
    /// Along chords of its circle.
    std::vector<Capsule> capsules() const {
        constexpr int chords = 48;
        const auto [x, y, z, middle] = pov_axes();
        const auto point = [&](int i) {
            const double turn = 2 * std::numbers::pi * i / chords;
            return centre + major * (std::cos(turn) * x + std::sin(turn) * z);
        };
        const double reach = minor + major * (1 - std::cos(std::numbers::pi / chords));
        std::vector<Capsule> around;
        for (int i = 0; i < chords; ++i) around.push_back({point(i), point(i + 1), reach});
        return around;
    }

    template <class T>
    using Kernels = std::tuple<TorusKernel<T>, AffineKernel<TorusKernel<T>, T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        const DVec3 a = normalize(axis);
        const double unit = major + minor;
        if (to_world.similar())
            emit(TorusKernel<T>{cast<T>(to_world.point(centre)), cast<T>(to_world.direction(a)),
                                static_cast<T>(to_world.length(major)), static_cast<T>(to_world.length(minor))});
        else
            emit(affine<T>(
                TorusKernel<T>{Vec3<T>(0), cast<T>(a), static_cast<T>(major / unit), static_cast<T>(minor / unit)},
                centre, unit, transformed(bounds(), to_world.matrix), to_world));
    }
};

}  // namespace strahl
