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
#include "scene/kinds/julia/julia_numbers.h"

namespace strahl {

/// Says what is iterated: squares or cubes of quaternions, or functions of hypercomplex numbers.
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
    // Squares of radii: of the ball in which POV-Ray looks for it, of one that holds it, and of where iterations end.
    R square, reach, exit;

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
    V x2, rest, growth{1}, last{1};

    STRAHL_INLINE JuliaOrbit(const JuliaNumbers<R>& own, const Vec3<V>& p) : own(own), z(own.begin(p)) {}
    /// Returns the squared distance from the origin, and keeps the products that step() needs.
    STRAHL_INLINE V size() {
        x2 = z.x * z.x;
        rest = fma(z.z, z.z, z.w * z.w);
        if (cubed) return rest = fma(z.y, z.y, rest), x2 + rest;
        return fma(z.y, z.y, x2) + rest;
    }
    STRAHL_INLINE void step(Mask<V>) {
        const V all = cubed ? fma(V(3), x2, -rest) : V(2) * z.x;
        const V x =
            cubed ? fma(z.x, fma(V(-3), rest, x2), V(own.constant.x)) : fma(-z.y, z.y, x2 + V(own.constant.x)) - rest;
        z = {x, fma(z.y, all, V(own.constant.y)), fma(z.z, all, V(own.constant.z)), fma(z.w, all, V(own.constant.w))};
    }
    /// Notes the size of those that have not been out before.
    STRAHL_INLINE void note(Mask<V> lanes, Mask<V>, const V& size) { last = select(lanes, size, last); }
    STRAHL_INLINE void grow(Mask<V> lanes, const V& size, int) {
        growth = select(lanes, growth * (V(R(cubed ? 9 : 4)) * size), growth);
    }
    /// Returns how far those may go that are out, in any direction.
    STRAHL_INLINE V free(const Vec3<V>&) const {
        constexpr R ln2 = std::numbers::ln2_v<R>;
        constexpr int terms = std::is_same_v<R, float> ? 5 : 12;
        return V(R(cubed ? ln2 / 3 : ln2 / 2)) * log2_by_series<terms>(last) * (V(1) / sqrt(growth));
    }
    /// Returns the normal at a point inside and near the surface, of any length: the size of the last number grows
    /// along it. Its slopes by earlier numbers are found from the last back to the first.
    STRAHL_INLINE static Vec3<V> normal(const JuliaNumbers<R>& own, const Vec3<V>& p) {
        std::array<FourParts<V>, most_julia_steps> passed;
        JuliaOrbit orbit(own, p);
        for (int i = 0; i < own.count; ++i) passed[i] = orbit.z, orbit.size(), orbit.step(Mask<V>());
        FourParts<V> n = orbit.z;
        const V two(2), three(3), six(6);
        for (int i = own.count; i-- > 0;) {
            const auto& [x, y, u, v] = passed[i];
            const V along = y * n.y + u * n.z + v * n.w, d = y * y + u * u + v * v;
            const V all = cubed ? three * x * x - d : two * x, back = cubed ? six * x * n.x + two * along : two * n.x;
            n = {cubed ? three * (x * x - d) * n.x + six * x * along : two * (x * n.x + along), all * n.y - y * back,
                 all * n.z - u * back, all * n.w - v * back};
        }
        return {n.x, n.y, n.z};
    }
};

/// A hypercomplex number that is iterated, as two complex numbers, x - w + i (y + z) and x + w + i (y - z), which do
/// not mix. How fast its size grows in a direction tells how far it is to where it is 0.
template <class V, JuliaRule rule>
requires(rule >= JuliaRule::square) struct JuliaOrbit<V, rule> {
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
    STRAHL_INLINE void note(Mask<V>, Mask<V> out, const V& size) {
        if (none(out)) return;
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
    STRAHL_INLINE static Vec3<V> normal(const JuliaNumbers<R>& own, const Vec3<V>& p) {
        JuliaOrbit orbit(own, rule == JuliaRule::function ? Vec3<V>(p.x, p.y, p.y) : p);
        const Mask<V> all = p.x == p.x;
        for (int i = 1; i <= own.count; ++i) orbit.grow(all, V(0), i), orbit.step(all);
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
        orbit.note(lanes, out, size);
        lanes = lanes & !out;
        if (i >= own.count || none(lanes)) break;
        orbit.grow(lanes, size, i);
        orbit.step(lanes);
    }
    free = select(lanes, V(0), orbit.free(way));
    return lanes;
}

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
