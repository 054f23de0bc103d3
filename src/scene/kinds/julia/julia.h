// The body whose points stay near the origin under an iteration of quaternions or of hypercomplex numbers: POV-Ray's
// julia_fractal.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "scene/kinds/julia/julia_march.h"
#include "scene/kinds/prism.h"

namespace strahl {

/// The numbers of an iteration as a world keeps them, each as a sum of two, so that in worlds of floats they have more
/// digits than one has.
template <class T>
struct StoredJulia {
    static constexpr int count = 16;
    std::array<T, count> high, low;

    template <class R>
    STRAHL_INLINE JuliaNumbers<R> as() const {
        const auto at = [&](std::size_t i) __attribute__((always_inline)) { return R(high[i]) + R(low[i]); };
        JuliaNumbers<R> own{{at(0), at(1), at(2), at(3)},
                            {at(4), at(5), at(6), at(7)},
                            at(8),
                            at(9),
                            {at(10), at(11)},
                            static_cast<int>(at(12)),
                            static_cast<JuliaStep>(static_cast<int>(at(13))),
                            JuliaRule::function,
                            R(16),
                            at(15),
                            R(16)};
        if (at(14) == 0) {
            // POV-Ray squares where it says cube.
            if (own.step <= JuliaStep::cube) own.rule = JuliaRule::square;
            if (own.step == JuliaStep::reciprocal) own.rule = JuliaRule::reciprocal;
            return own;
        }
        own.rule = own.step == JuliaStep::cube ? JuliaRule::quaternion_cube : JuliaRule::quaternion_square;
        const FourParts<R>& c = own.constant;
        const R all = 1 + std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z + c.w * c.w) + R(1e-7), radius = min(all, R(2));
        // Rays begin on the ball, and are not to be told to be further out, which makes another first step.
        own.square = radius * radius, own.exit = own.square + (std::is_same_v<R, float> ? R(4e-6) : R(1e-7));
        return own;
    }
    static StoredJulia of(const std::array<double, count>& numbers) {
        StoredJulia all;
        for (std::size_t i = 0; i < count; ++i)
            all.high[i] = static_cast<T>(numbers[i]), all.low[i] = static_cast<T>(numbers[i] - double(all.high[i]));
        return all;
    }
};

/// A Julia set in its own space. It has one face.
template <class T>
struct JuliaKernel : ContourKernel<T> {
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::turn;
    StoredJulia<T> numbers;

    static constexpr int face_count() { return 1; }

    /// Calls crossed(lanes, t, face) where rays cross the surface ahead of their starts, from near to far, perhaps only
    /// `enough` times for each ray. As in POV-Ray: it goes along the ray by what iterations tell of the distance, but
    /// at least by 1 / precision, and halves a step whose ends are on different sides. A crossing is where it is inside
    /// by up to 1e-7. A ray that starts on the surface and leaves it at once is not looked at any further, if only the
    /// nearest crossing is asked for; floats do not know which rays these are, and go on. For what is nearer than
    /// `anywhere` t may be any place in the step that crosses the surface.
    template <class V, class Crossed>
    STRAHL_INLINE void each_crossing(const void*, int enough, const Ray<V>& ray, V start, Mask<V> lanes,
                                     const Crossed& crossed, const V& anywhere = V(0)) const {
        using R = Element<V>;
        const V zero(0), near(JuliaMarch<V>::near), itself_until(JuliaMarch<V>::itself), none_yet(R(1e-10));
        const Mask<V> starts = lanes & (start == zero);
        lanes = lanes & (starts | box.may_meet(ray));
        if (none(lanes)) return;
        const JuliaNumbers<R> own = numbers.template as<R>();
        const OwnLine<V> line = this->own_line(ray, starts);
        const Vec3<V>&origin = line.nearest, &way = line.unit;
        const V towards = -dot(origin, way), off = towards * towards - dot(origin, origin);
        const V chord = V(own.square) + off, root = sqrt(max(chord, zero)), ahead = near - line.shift;
        const V held = V(own.reach) + off, leaves = towards + sqrt(max(held, zero));
        lanes = lanes & (chord > none_yet) & (held > zero) & (leaves > ahead);
        if (none(lanes)) return;
        JuliaMarch<V> march{.from = origin,
                            .way = way,
                            .last = towards + root,
                            .leaves = leaves,
                            .sure_from = select(starts, itself_until, zero - line.shift),
                            .sure_to = anywhere / line.per - line.shift,
                            .place = max(towards - root, ahead),
                            .lanes = lanes};
        with_rule(
            own.rule, [&](auto rule) __attribute__((always_inline)) { start_march<rule()>(own, march); });
        for (int found = 0; any(march.lanes);) {
            with_rule(
                own.rule, [&](auto rule) __attribute__((always_inline)) { advance<rule()>(own, march); });
            const Mask<V> itself = march.turned & starts & (march.at < itself_until);
            const V t = (line.shift + march.at) * line.per;
            const Mask<V> there = march.turned & !itself & (starts | box.holds(ray, t, abs(t)));
            if (any(there)) crossed(there, t, zero), ++found;
            if (found >= enough) march.lanes = march.lanes & !there;
            if (!std::is_same_v<R, float> && enough == 1) march.lanes = march.lanes & !itself;
        }
    }
    /// Returns the points of rays at `t`, and the normals there, which are found in double at least.
    template <class S>
    STRAHL_INLINE SurfacePoint<S> at(const void*, const Ray<S>& ray, const S& t) const {
        using V = Doubles<S>;
        using R = Element<V>;
        const Vec3<S> position = fma(t, ray.direction, ray.origin), p = turn(position - splat<S>(centre));
        const JuliaNumbers<R> own = numbers.template as<R>();
        Vec3<S> unit(S(0));
        for (int part = 0; part < width<S> / width<V>; ++part) {
            const Vec3<V> own_p = doubles_of(p, part);
            const Vec3<V> n = with_rule(
                own.rule, [&](auto rule) __attribute__((always_inline)) {
                    if constexpr (width<V> != 1)
                        return call_normal<rule()>(own, own_p);
                    else
                        return JuliaOrbit<V, rule()>::normal(own, own_p);
                });
            const V length = sqrt(dot(n, n));
            const Mask<V> known = (length > V(0)) & (length <= V(std::numeric_limits<R>::max()));
            const V per = select(known, V(1) / length, V(0));
            for (int c = 0; c < 3; ++c) unit[c] = unit[c] + lanes_of<S>(select(known, per * n[c], V(0)), part);
        }
        const Mask<S> known = dot(unit, unit) > S(0);
        return {position, select(known, this->normal(unit.x, unit.y, unit.z), -ray.direction)};
    }

  private:
    template <JuliaRule rule, class V>
    STRAHL_INLINE static void start_march(const JuliaNumbers<Element<V>>& own, JuliaMarch<V>& march) {
        if constexpr (width<V> != 1)
            call_start<rule>(own, march);
        else
            march.template start<rule>(own);
    }
    template <JuliaRule rule, class V>
    STRAHL_INLINE static void advance(const JuliaNumbers<Element<V>>& own, JuliaMarch<V>& march) {
        if constexpr (width<V> != 1)
            call_advance<rule>(own, march);
        else
            march.template advance<rule>(own);
    }
    /// Do so by calls for packs: their code is long, and the calls cost little.
    template <JuliaRule rule, class V>
    [[gnu::noinline]] static void call_start(const JuliaNumbers<Element<V>>& own, JuliaMarch<V>& march) {
        march.template start<rule>(own);
    }
    template <JuliaRule rule, class V>
    [[gnu::noinline]] static void call_advance(const JuliaNumbers<Element<V>>& own, JuliaMarch<V>& march) {
        march.template advance<rule>(own);
    }
    template <JuliaRule rule, class V>
    [[gnu::noinline]] static Vec3<V> call_normal(const JuliaNumbers<Element<V>>& own, const Vec3<V>& p) {
        return JuliaOrbit<V, rule>::normal(own, p);
    }
};

/// The points that an iteration of quaternions or of hypercomplex numbers leaves near the origin.
struct JuliaFractal {
    DVec3 constant{-.083, 0, -.83};
    double fourth = -.025, iterations = 20, precision = 20;
    DVec3 slice{0, 0, 0};
    double slice_fourth = 1, distance = 0, exponent = 0, imaginary = 0;
    JuliaStep step = JuliaStep::square;
    bool hypercomplex = false;  // in place of quaternions

    bool operator==(const JuliaFractal&) const = default;

    static constexpr const char* name = "julia_fractal";
    static constexpr int faces = 1, max_crossings = 4;  // it may be many more
    static constexpr bool bounded = true, convex = false, closed = false, hot = false, arguments_move = false;
    static constexpr double least_slice = 1e-10, most_precision = 1e5;
    static constexpr auto fields = std::make_tuple(
        Field{"constant", &JuliaFractal::constant, "what each step adds, its first three parts"},
        Field{"fourth part", &JuliaFractal::fourth, "the fourth part of that"},
        Field{"iterations", &JuliaFractal::iterations, "how many steps are taken", Range::steps},
        Field{"precision", &JuliaFractal::precision, "rays go on by at least 1 / precision near it; from 1 to 100000",
              Range::positive},
        Field{"slice", &JuliaFractal::slice, "three parts of the normal of its slice through the space of four parts",
              Range::any, Given::optional},
        Field{"fourth of slice", &JuliaFractal::slice_fourth, "the fourth part of that, not 0", Range::any,
              Given::optional},
        Field{"distance of slice", &JuliaFractal::distance, "how far the slice is from the origin", Range::any,
              Given::optional},
        Field{"exponent", &JuliaFractal::exponent, "of the step `pwr`", Range::any, Given::optional},
        Field{"imaginary exponent", &JuliaFractal::imaginary, "its imaginary part", Range::any, Given::optional});

    /// Takes one of POV-Ray's words for how numbers are multiplied, or for the step; false if it is none.
    bool take_word(std::string_view word) {
        if (word == "quaternion" || word == "hypercomplex") return hypercomplex = word == "hypercomplex", true;
        for (std::size_t i = 0; i < julia_words.size(); ++i)
            if (word == julia_words[i]) return step = static_cast<JuliaStep>(i), true;
        return false;
    }
    /// Returns POV-Ray's words for the numbers and the step.
    std::string words() const {
        return (hypercomplex ? "hypercomplex " : "quaternion ") +
               std::string(julia_words[static_cast<std::size_t>(step)]);
    }
    const char* fault() const {
        if (!hypercomplex && step > JuliaStep::cube) return "quaternions are only squared or cubed";
        if (!(std::fabs(slice_fourth) >= least_slice)) return "the fourth part of its slice is 0";
        if (!(iterations >= 1 && iterations <= most_julia_steps)) return "its steps are not from 1 to 1000";
        return precision >= 1 && precision <= most_precision ? nullptr : "its precision is not from 1 to 100000";
    }
    bool open() const { return false; }
    double radius() const { return std::sqrt(numbers<double>().template as<double>().square); }
    Box bounds() const {
        const double reach = std::sqrt(numbers<double>().template as<double>().reach);
        return {DVec3(-reach), DVec3(reach)};
    }
    bool contains(const DVec3& p) const {
        const JuliaNumbers<double> own = numbers<double>().template as<double>();
        return with_rule(own.rule, [&](auto rule) { return julia_holds<rule()>(own, Vec3<double>(p), true); });
    }
    static constexpr int face_count() { return 1; }

    /// Returns the square of the radius of a ball around the origin that holds it. A number that is inside after a step
    /// was not further from the origin before than the root of how far it may be, and the constant with it.
    double reach() const {
        const auto before = [this](double constant, double far) {
            for (int i = 1; i < iterations; ++i) {
                const double power = constant + far;
                far = std::min(far, !hypercomplex && step == JuliaStep::cube ? std::cbrt(power) : std::sqrt(power));
            }
            return far * far;
        };
        if (step > JuliaStep::cube) return 16;
        const DVec3& c = constant;
        constexpr double margin = 1 + 1e-5;
        if (!hypercomplex) {
            const double size = std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z + fourth * fourth);
            return margin * before(size, std::min(1 + size, 2.));
        }
        const double far = std::sqrt(2 * 16.);  // each of two complex numbers, of whose squares the size is the mean
        const double first = before(std::hypot(c.x - fourth, c.y + c.z), far);
        const double second = before(std::hypot(c.x + fourth, c.y - c.z), far);
        return margin * std::min(16., (first + second) / 2);
    }
    template <class T>
    StoredJulia<T> numbers() const {
        const double square = slice.x * slice.x + slice.y * slice.y + slice.z * slice.z + slice_fourth * slice_fourth;
        const double per = 1 / std::sqrt(square);
        return StoredJulia<T>::of({constant.x, constant.y, constant.z, fourth, per * slice.x, per * slice.y,
                                   per * slice.z, per * slice_fourth, distance, 1 / precision, exponent, imaginary,
                                   iterations, static_cast<double>(step), hypercomplex ? 0. : 1., reach()});
    }
    template <class T>
    using Kernels = std::tuple<JuliaKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        emit(JuliaKernel<T>{ContourKernel<T>::of(DVec3(0), DVec3(1), bounds(), 0, to_world), numbers<T>()});
    }
};

}  // namespace strahl
