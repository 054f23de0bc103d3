// Iterations whose Julia sets are bodies: which points stay near the origin, how far those are from these that leave
// it, and the normals of the surface between them, in the way of POV-Ray's julia_fractal, after A. Norton, "Generation
// and Display of Geometric Fractals in 3-D", 1982.
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "num/lane_math.h"
#include "scene/kinds/contours.h"
#include "scene/kinds/julia/julia_numbers.h"

namespace strahl {

/// What is iterated: squares or cubes of quaternions, or functions of hypercomplex numbers.
enum class JuliaRule { quaternion_square, quaternion_cube, square, reciprocal, function };

/// The numbers that an iteration is given by. It begins at the point of three coordinates, with a fourth part by which
/// it is on the plane slice . z = distance, and in each of `count` steps z becomes step(z) + constant. What is never
/// further from the origin than the root of `exit` is inside.
template <class R>
struct JuliaNumbers {
    FourParts<R> constant, slice;
    R distance, precision;
    TwoParts<R> exponent;
    int count;
    JuliaStep step;
    JuliaRule rule;
    R square, exit;  // of the radius of a ball around it, and of where the iteration ends

    template <class V>
    STRAHL_INLINE FourParts<V> begin(const Vec3<V>& p) const {
        const V w = V(distance) - V(slice.x) * p.x - V(slice.y) * p.y - V(slice.z) * p.z;
        return {p.x, p.y, p.z, slice.w == 1 ? w : w / V(slice.w)};
    }
};

/// A quaternion that is iterated. The distance to the surface is estimated by log |z| / |z'|, and |z'| is the product
/// of the sizes of all numbers before.
template <class V, JuliaRule rule>
struct JuliaOrbit {
    using R = Element<V>;
    static constexpr bool cubed = rule == JuliaRule::quaternion_cube;
    const JuliaNumbers<R>& own;
    FourParts<V> z;
    V x2, rest, growth{1}, last{1}, last_growth{1};

    STRAHL_INLINE JuliaOrbit(const JuliaNumbers<R>& own, const Vec3<V>& p) : own(own), z(own.begin(p)) {}
    /// Returns the square of how far from the origin it is; a step needs what this computes.
    STRAHL_INLINE V size() {
        x2 = z.x * z.x, rest = fma(z.y, z.y, fma(z.z, z.z, z.w * z.w));
        return x2 + rest;
    }
    STRAHL_INLINE void step(Mask<V>) {
        const V all = cubed ? fma(V(3), x2, -rest) : V(2) * z.x;
        const V x = cubed ? z.x * fma(V(-3), rest, x2) : x2 - rest;
        z = {x + V(own.constant.x), fma(z.y, all, V(own.constant.y)), fma(z.z, all, V(own.constant.z)),
             fma(z.w, all, V(own.constant.w))};
    }
    /// Notes the size of those that are out.
    STRAHL_INLINE void leave(Mask<V> out, const V& size) {
        last = select(out, size, last), last_growth = select(out, growth, last_growth);
    }
    STRAHL_INLINE void grow(Mask<V>, const V& size, int) { growth *= V(R(cubed ? 9 : 4)) * size; }
    /// Returns how far those may go that are out, in any direction.
    STRAHL_INLINE V free(const Vec3<V>&) const {
        constexpr R ln2 = std::numbers::ln2_v<R>;
        return V(R(cubed ? ln2 / 3 : ln2 / 2)) * log2_by_series(last) / sqrt(last_growth);
    }
    /// Returns the normal at a point inside and near the surface, of any length: the size of the last number grows
    /// along it. Its slopes by earlier numbers are found from the last back to the first.
    STRAHL_INLINE static Vec3<R> normal(const JuliaNumbers<R>& own, const Vec3<R>& p) {
        std::array<FourParts<R>, most_julia_steps> passed;
        JuliaOrbit<R, rule> orbit(own, p);
        for (int i = 0; i < own.count; ++i) passed[i] = orbit.z, orbit.size(), orbit.step(true);
        FourParts<R> n = orbit.z;
        for (int i = own.count; i-- > 0;) {
            const auto& [x, y, u, v] = passed[i];
            const R along = y * n.y + u * n.z + v * n.w, d = y * y + u * u + v * v;
            const R all = cubed ? 3 * x * x - d : 2 * x, back = cubed ? 6 * x * n.x + 2 * along : 2 * n.x;
            n = {cubed ? 3 * (x * x - d) * n.x + 6 * x * along : 2 * (x * n.x + along), all * n.y - y * back,
                 all * n.z - u * back, all * n.w - v * back};
        }
        return {n.x, n.y, n.z};
    }
};

/// A hypercomplex number that is iterated, as two complex numbers, x - w + i (y + z) and x + w + i (y - z), which do
/// not mix. How fast its size grows in a direction tells how far it is to where it is 0.
template <class V, JuliaRule rule>
requires(rule >= JuliaRule::square)
struct JuliaOrbit<V, rule> {
    using R = Element<V>;
    using Two = std::array<TwoParts<V>, 2>;
    const JuliaNumbers<R>& own;
    Two z, constant, growth, last_z, last_growth;
    V last{0}, last_factor{0};
    R factor = own.step == JuliaStep::square ? R(2) : R(1);  // of the slope, as POV-Ray has it

    STRAHL_INLINE JuliaOrbit(const JuliaNumbers<R>& own, const Vec3<V>& p) : own(own) {
        const auto [x, y, u, v] = own.begin(p);
        const FourParts<R>& c = own.constant;
        z = growth = last_z = last_growth = {{{x - v, y + u}, {x + v, y - u}}};
        constant = {{{V(c.x - c.w), V(c.y + c.z)}, {V(c.x + c.w), V(c.y - c.z)}}};
    }
    STRAHL_INLINE V size() const { return V(R(.5)) * (z[0].square_of_size() + z[1].square_of_size()); }
    STRAHL_INLINE void step(Mask<V> lanes) {
        for (int i = 0; i < 2; ++i) z[i] = stepped(z[i], lanes) + constant[i];
    }
    /// Notes the numbers of those that are out.
    STRAHL_INLINE void leave(Mask<V> out, const V& size) {
        last = select(out, size, last), last_factor = select(out, V(factor), last_factor);
        for (int i = 0; i < 2; ++i)
            last_z[i] = z[i].where(out, last_z[i]), last_growth[i] = growth[i].where(out, last_growth[i]);
    }
    STRAHL_INLINE void grow(Mask<V> lanes, const V&, int i) {
        if (i < 2) return;
        if (own.step == JuliaStep::square) factor *= 2;
        for (int k = 0; k < 2; ++k) {
            const TwoParts<V> by = rule == JuliaRule::square ? z[k] : stepped(z[k], lanes);
            growth[k] = growth[k] * (rule == JuliaRule::reciprocal ? by * TwoParts<V>{-by.x, -by.y} : by);
        }
    }
    /// Returns how far those may go that are out until the size would be 0, if that is neither near nor far.
    STRAHL_INLINE V free(const Vec3<V>& way) const {
        const Vec3<V> n = slope(last_growth, last_z);
        const V least(own.precision), twice = V(-2) * last_factor * dot(n, way);
        const Mask<V> known = (twice > V(R(2e-8))) & (last > least * twice) & (last < V(R(30)) * least * twice);
        return any(known) ? select(known, last / twice, least) : least;
    }
    STRAHL_INLINE static Vec3<R> normal(const JuliaNumbers<R>& own, const Vec3<R>& p) {
        JuliaOrbit<R, rule> orbit(own, rule == JuliaRule::function ? Vec3<R>(p.x, p.y, p.y) : p);
        for (int i = 1; i <= own.count; ++i) orbit.grow(true, R(0), i), orbit.step(true);
        return slope(orbit.growth, orbit.z);
    }

  private:
    /// Returns how the size of a number grows with the point, but for a factor.
    STRAHL_INLINE static Vec3<V> slope(const Two& growth, const Two& z) {
        const TwoParts<V> a = growth[0].conjugate() * z[0], b = growth[1].conjugate() * z[1];
        const V half(R(.5));
        return {half * (a.x + b.x), half * (a.y + b.y), half * (a.y - b.y)};
    }
    STRAHL_INLINE TwoParts<V> stepped(const TwoParts<V>& a, Mask<V> lanes) const {
        if constexpr (rule == JuliaRule::square) return a * a;
        if constexpr (rule == JuliaRule::reciprocal) return a.reciprocal();
        alignas(64) R x[width<V>], y[width<V>];
        store_lanes(x, a.x), store_lanes(y, a.y);
        for (unsigned left = bits(lanes); left; left &= left - 1) {
            const int k = std::countr_zero(left);
            const TwoParts<R> value = julia_function<R>(own.step, {x[k], y[k]}, own.exponent);
            x[k] = value.x, y[k] = value.y;
        }
        return {load_lanes<V>(x), load_lanes<V>(y)};
    }
};

/// Returns which points are inside. By functions POV-Ray asks so with y in place of z, but not how far those outside
/// may go.
template <JuliaRule rule, class V>
STRAHL_INLINE Mask<V> julia_holds(const JuliaNumbers<Element<V>>& own, const Vec3<V>& p, Mask<V> lanes) {
    JuliaOrbit<V, rule> orbit(own, rule == JuliaRule::function ? Vec3<V>(p.x, p.y, p.y) : p);
    for (int i = 1; any(lanes); ++i) {
        lanes = lanes & !(orbit.size() > V(own.exit));
        if (i >= own.count) break;
        orbit.step(lanes);
    }
    return lanes;
}
/// Returns which points are inside, and how far those outside may go in a direction without passing the surface.
template <JuliaRule rule, class V>
STRAHL_INLINE Mask<V> julia_look(const JuliaNumbers<Element<V>>& own, const Vec3<V>& p, const Vec3<V>& way,
                                 Mask<V> lanes, V& free) {
    JuliaOrbit<V, rule> orbit(own, p);
    for (int i = 1;; ++i) {
        const V size = orbit.size();
        const Mask<V> out = lanes & (size > V(own.exit));
        if (any(out)) {
            orbit.leave(out, size);
            lanes = lanes & !out;
            if (none(lanes)) break;
        }
        if (i >= own.count) break;
        orbit.grow(lanes, size, i);
        orbit.step(lanes);
    }
    free = orbit.free(way);
    return lanes;
}

/// Rays that go through a Julia set: the lines along which they go until `last`, where they are and how far they may go
/// from there, which of them are inside, which were found to cross the surface, and where.
template <class V>
struct JuliaMarch {
    Vec3<V> way;
    V last, place;
    Mask<V> lanes;
    Vec3<V> p{};
    V free{0}, at{0};
    Mask<V> inside{}, turned{};

    using R = Element<V>;
    static constexpr R near = R(1e-7);  // how exactly a crossing is found

    STRAHL_INLINE Vec3<V> moved(const Vec3<V>& from, const V& by) const {
        return {fma(by, way.x, from.x), fma(by, way.y, from.y), fma(by, way.z, from.z)};
    }
    /// Looks at the places where rays begin, or somewhat further in if these are inside.
    template <JuliaRule rule>
    STRAHL_INLINE void start(const JuliaNumbers<R>& own) {
        inside = julia_look<rule>(own, p, way, lanes, free);
        if (none(inside)) return;
        const V step = select(inside, V(near + near), V(0));
        place = place + step, p = moved(p, step);
        lanes = lanes & !(inside & !(place <= last));
        inside = julia_look<rule>(own, p, way, lanes, free);
    }
    /// Goes on until all rays have crossed the surface or passed the last place, and finds where they crossed it. Those
    /// that did wait for the others.
    template <JuliaRule rule>
    STRAHL_INLINE void advance(const JuliaNumbers<R>& own) {
        const V zero(0);
        Mask<V> going = lanes;
        Vec3<V> q = p;
        V part = zero;
        turned = lanes & !lanes;
        while (true) {
            const V step = select(going, max(free, V(own.precision)), zero);
            const Vec3<V> before = p;
            place = place + step, p = moved(p, step);
            const Mask<V> ended = going & !(place <= last);  // or it is no number
            lanes = lanes & !ended, going = going & !ended;
            if (none(going)) break;
            V free_next;
            const Mask<V> turns = going & either(julia_look<rule>(own, p, way, going, free_next), inside);
            free = select(going, free_next, free);
            if (none(turns)) continue;
            q = select(turns, before, q), part = select(turns, step, part), at = select(turns, place - step, at);
            turned = turned | turns, going = going & !turns;
            if (none(going)) break;
        }
        while (any(part > V(near))) {
            const Mask<V> halves = part > V(near);
            part = select(halves, V(R(.5)) * part, part);
            const Vec3<V> middle = moved(q, part);
            const Mask<V> same = halves & !either(julia_holds<rule>(own, middle, halves), inside);
            q = select(same, middle, q), at = select(same, at + part, at);
        }
        at = select(inside, at, at + part), inside = either(inside, turned);
        turned = turned & !(at > last);
    }
};

/// Calls call(rule), in which `rule` is a constant.
template <class Call>
STRAHL_INLINE auto with_rule(JuliaRule rule, const Call& call) {
    switch (rule) {
        case JuliaRule::quaternion_square:
            return call(std::integral_constant<JuliaRule, JuliaRule::quaternion_square>());
        case JuliaRule::quaternion_cube:
            return call(std::integral_constant<JuliaRule, JuliaRule::quaternion_cube>());
        case JuliaRule::square:
            return call(std::integral_constant<JuliaRule, JuliaRule::square>());
        case JuliaRule::reciprocal:
            return call(std::integral_constant<JuliaRule, JuliaRule::reciprocal>());
        default:
            return call(std::integral_constant<JuliaRule, JuliaRule::function>());
    }
}

}  // namespace strahl
