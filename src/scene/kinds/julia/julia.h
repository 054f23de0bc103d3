// The body whose points stay near the origin under an iteration of quaternions or of hypercomplex numbers: POV-Ray's
// julia_fractal, after A. Norton, "Generation and Display of Geometric Fractals in 3-D", 1982.
#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>

#include "scene/kinds/julia/julia_numbers.h"
#include "scene/kinds/prism.h"

namespace strahl {

/// An iteration: z becomes step(z) + constant, `count` times. It begins at the point of three coordinates, with a
/// fourth part by which it is on the plane slice . z = distance. What is always within the root of `exit` is inside.
template <class R>
struct JuliaIteration {
    FourParts<R> constant, slice;
    R distance, precision;
    TwoParts<R> exponent;
    int count;
    JuliaStep step;
    bool quaternions;
    R square, exit;  // of the radius of a ball around it, and of where the iteration ends

    static constexpr R near = R(1e-7);  // how exactly a crossing is found

    /// Do steps take functions of complex numbers? POV-Ray tests with y in place of z then whether points are inside,
    /// but not how far away they are.
    STRAHL_INLINE bool by_function() const { return step > JuliaStep::reciprocal; }

    template <class V>
    STRAHL_INLINE FourParts<V> begin(const Vec3<V>& p) const {
        const V w = (V(distance) - V(slice.x) * p.x - V(slice.y) * p.y - V(slice.z) * p.z) / V(slice.w);
        return {p.x, p.y, p.z, w};
    }
    template <class V>
    STRAHL_INLINE V size(const FourParts<V>& z) const {
        if (quaternions) return (z.y * z.y + z.z * z.z + z.w * z.w) + z.x * z.x;
        if (step == JuliaStep::square) return (z.x * z.x + z.w * z.w) + (z.y * z.y + z.z * z.z);
        return z.x * z.x + z.y * z.y + z.z * z.z + z.w * z.w;
    }
    /// Returns the step of z without the constant.
    template <class V>
    STRAHL_INLINE FourParts<V> stepped(const FourParts<V>& z) const {
        const V two(2), three(3);
        if (quaternions) {
            const V d = z.y * z.y + z.z * z.z + z.w * z.w, x2 = z.x * z.x;
            const V all = step == JuliaStep::cube ? three * x2 - d : two * z.x;
            return {step == JuliaStep::cube ? z.x * (x2 - three * d) : x2 - d, z.y * all, z.z * all, z.w * all};
        }
        switch (step) {
            case JuliaStep::square:
                return {(z.x * z.x + z.w * z.w) - (z.y * z.y + z.z * z.z), two * (z.x * z.y - z.z * z.w),
                        two * (z.x * z.z - z.w * z.y), two * (z.x * z.w + z.y * z.z)};
            case JuliaStep::cube:  // which POV-Ray squares
                return squared(z);
            case JuliaStep::reciprocal: {
                const V det = ((z.x - z.w) * (z.x - z.w) + (z.y + z.z) * (z.y + z.z)) *
                              ((z.x + z.w) * (z.x + z.w) + (z.y - z.z) * (z.y - z.z));
                const V all = z.x * z.x + z.y * z.y + z.z * z.z + z.w * z.w, mixed = z.x * z.w - z.y * z.z;
                return {(z.x * all - two * z.w * mixed) / det, (-z.y * all - two * z.z * mixed) / det,
                        (-z.z * all - two * z.y * mixed) / det, (z.w * all - two * z.x * mixed) / det};
            }
            default:
                return function_of(z);
        }
    }
    template <class V>
    STRAHL_INLINE FourParts<V> next(const FourParts<V>& z) const {
        return stepped(z) + FourParts<V>{V(constant.x), V(constant.y), V(constant.z), V(constant.w)};
    }
    /// Goes on with the product that the slope is made of, by the number z of a later step.
    template <class V>
    STRAHL_INLINE FourParts<V> grown(const FourParts<V>& product, const FourParts<V>& z) const {
        if (quaternions) return product.times(z);
        if (step == JuliaStep::reciprocal) {
            const FourParts<V> s = squared(stepped(z));
            return product.by({-s.x, -s.y, -s.z, -s.w});
        }
        return by_function() ? stepped(z).by(product) : z.by(product);
    }
    /// Returns which points are inside.
    template <class V>
    STRAHL_INLINE Mask<V> holds(const Vec3<V>& p, Mask<V> lanes) const {
        FourParts<V> z = begin(by_function() ? Vec3<V>(p.x, p.y, p.y) : p);
        for (int i = 1; any(lanes); ++i) {
            lanes = lanes & !(size(z) > V(exit));
            if (i >= count) break;
            z = next(z);
        }
        return lanes;
    }
    /// Returns which points are inside, and how far those outside may go in a direction without passing the surface.
    template <class V>
    STRAHL_INLINE Mask<V> look(const Vec3<V>& p, const Vec3<V>& way, Mask<V> lanes, V& free) const {
        FourParts<V> z = begin(p), product = z;
        R share(1);
        free = V(precision);
        for (int i = 1; any(lanes); ++i) {
            share /= quaternions && step == JuliaStep::cube ? R(3) : R(2);
            const V own = size(z);
            const Mask<V> out = lanes & (own > V(exit));
            if (any(out)) {
                V found;
                if (quaternions) {
                    const V square =
                        product.x * product.x + product.y * product.y + product.z * product.z + product.w * product.w;
                    found = V(share) * sqrt(own / square) * log_of(own);
                } else {
                    const R factor = i < 2 ? R(2) : R(1) / (R(2) * share);
                    found = along(own, slope(product, z, step == JuliaStep::square ? factor : R(1)), way);
                }
                free = select(out, found, free);
                lanes = lanes & !out;
            }
            if (i >= count || none(lanes)) break;
            if (!quaternions && i > 1) product = grown(product, z);
            z = next(z);
            if (quaternions) product = product.times(z);
        }
        return lanes;
    }
    /// Returns the normal of the surface at a point inside and near to it, of any length.
    STRAHL_INLINE Vec3<R> normal(const Vec3<R>& p) const {
        FourParts<R> z = begin(by_function() ? Vec3<R>(p.x, p.y, p.y) : p), product = z;
        if (!quaternions) {
            for (int i = 1; i <= count; ++i) {
                z = next(z);
                if (i < count) product = grown(product, z);
            }
            return slope(product, z, R(1));
        }
        std::array<FourParts<R>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
        for (int i = 1; i <= count; ++i) {
            const R d = z.y * z.y + z.z * z.z + z.w * z.w, x2 = z.x * z.x;
            for (FourParts<R>& n : rows) {
                if (step == JuliaStep::square) {
                    n = {n.x * z.x - n.y * z.y - n.z * z.z - n.w * z.w, n.x * z.y + z.x * n.y, n.x * z.z + z.x * n.z,
                         n.x * z.w + z.x * n.w};
                } else {
                    const R twice = 2 * (n.y * z.y + n.z * z.z + n.w * z.w), mixed = 6 * z.x * n.x - twice;
                    const R all = 3 * x2 - d;
                    n = {(n.x * (x2 - d) - z.x * twice) * 3, n.y * all + z.y * mixed, n.z * all + z.z * mixed,
                         n.w * all + z.w * mixed};
                }
            }
            z = next(z);
        }
        const auto along = [&](const FourParts<R>& n) __attribute__((always_inline)) {
            return n.x * z.x + n.y * z.y + n.z * z.z + n.w * z.w;
        };
        return {along(rows[0]), along(rows[1]), along(rows[2])};
    }

  private:
    template <class V>
    STRAHL_INLINE static FourParts<V> squared(const FourParts<V>& z) {
        const V two(2);
        return {z.x * z.x - z.y * z.y - z.z * z.z + z.w * z.w, two * (z.x * z.y - z.z * z.w),
                two * (z.z * z.x - z.w * z.y), two * (z.w * z.x + z.z * z.y)};
    }
    /// Returns the function of a hypercomplex number, which is two complex ones side by side.
    template <class V>
    STRAHL_INLINE FourParts<V> function_of(const FourParts<V>& z) const {
        constexpr int lanes = width<V>;
        alignas(64) R x[lanes], y[lanes], u[lanes], v[lanes];
        store_lanes(x, z.x - z.w), store_lanes(y, z.y + z.z), store_lanes(u, z.x + z.w), store_lanes(v, z.y - z.z);
        for (int k = 0; k < lanes; ++k) {
            const TwoParts<R> first = julia_function<R>(step, {x[k], y[k]}, exponent);
            const TwoParts<R> second = julia_function<R>(step, {u[k], v[k]}, exponent);
            x[k] = first.x, y[k] = first.y, u[k] = second.x, v[k] = second.y;
        }
        const V a = load_lanes<V>(x), b = load_lanes<V>(y), c = load_lanes<V>(u), d = load_lanes<V>(v), half(R(.5));
        return {half * (a + c), half * (b + d), half * (b - d), half * (c - a)};
    }
    template <class V>
    STRAHL_INLINE static V log_of(const V& v) {
        alignas(64) R lanes[width<V>];
        store_lanes(lanes, v);
        for (R& own : lanes) own = std::log(own);
        return load_lanes<V>(lanes);
    }
    /// Returns how the size of the last number grows with the point, but for a factor.
    template <class V>
    STRAHL_INLINE static Vec3<V> slope(const FourParts<V>& q, const FourParts<V>& z, R factor) {
        const V a = z.x * V(factor), b = z.y * V(factor), c = z.z * V(factor), d = z.w * V(factor);
        return {q.x * a + q.y * b + q.z * c + q.w * d, -q.y * a + q.x * b - q.w * c + q.z * d,
                -q.z * a - q.w * b + q.x * c + q.y * d};
    }
    /// Returns how far one may go until the size would be 0, if that is neither near nor far.
    template <class V>
    STRAHL_INLINE V along(const V& size, const Vec3<V>& slope, const Vec3<V>& way) const {
        const V falls = slope.x * way.x + slope.y * way.y + slope.z * way.z, twice = V(-2) * falls;
        const V least = V(precision) * twice, most = V(R(30)) * V(precision) * twice;
        const Mask<V> known = (falls < V(R(-1e-8))) & (size > least) & (size < most);
        return select(known, size / twice, V(precision));
    }
};

/// The numbers of an iteration, each as a sum of two, so that in worlds of floats they have more digits than one has.
template <class T>
struct JuliaNumbers {
    static constexpr int count = 15;
    std::array<T, count> high, low;

    template <class R>
    STRAHL_INLINE JuliaIteration<R> as() const {
        const auto at = [&](std::size_t i) __attribute__((always_inline)) { return R(high[i]) + R(low[i]); };
        JuliaIteration<R> own{{at(0), at(1), at(2), at(3)},
                              {at(4), at(5), at(6), at(7)},
                              at(8),
                              at(9),
                              {at(10), at(11)},
                              static_cast<int>(at(12)),
                              static_cast<JuliaStep>(static_cast<int>(at(13))),
                              at(14) != 0,
                              R(16),
                              R(16)};
        if (!own.quaternions) return own;
        const FourParts<R>& c = own.constant;
        const R all = 1 + std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z + c.w * c.w) + R(1e-7), radius = min(all, R(2));
        own.square = radius * radius, own.exit = own.square + R(1e-7);
        return own;
    }
    static JuliaNumbers of(const std::array<double, count>& numbers) {
        JuliaNumbers all;
        for (std::size_t i = 0; i < count; ++i)
            all.high[i] = static_cast<T>(numbers[i]), all.low[i] = static_cast<T>(numbers[i] - double(all.high[i]));
        return all;
    }
};

/// A Julia set in its own space. It has one face. Points are doubles, or have more digits.
template <class T>
struct JuliaKernel : ContourKernel<T> {
    static constexpr bool in_double = true;
    using Base = ContourKernel<T>;
    using Base::box, Base::centre, Base::turn;
    JuliaNumbers<T> numbers;

    static constexpr int face_count() { return 1; }

    /// Calls crossed(lanes, t, face) where rays cross the surface ahead of their starts, from near to far, perhaps only
    /// `enough` times for each ray. As in POV-Ray: it goes along the ray by what iterations tell of the distance, but
    /// at least by 1 / precision, and halves a step whose ends are on different sides. A crossing is where it is inside
    /// by up to 1e-7. A ray that starts on the surface and leaves it at once is not looked at any further, if only the
    /// nearest crossing is asked for; floats do not know which rays these are, and go on.
    template <class V, class Crossed>
    STRAHL_INLINE void each_crossing(const void*, int enough, const Ray<V>& ray, V start, Mask<V> lanes,
                                     const Crossed& crossed) const {
        using R = Element<V>;
        const V zero(0), half(R(.5)), near(JuliaIteration<R>::near), none_yet(R(1e-10));
        const Mask<V> starts = lanes & (start == zero);
        lanes = lanes & (starts | box.may_meet(ray));
        if (none(lanes)) return;
        const JuliaIteration<R> own = numbers.template as<R>();
        const OwnLine<V> line = this->own_line(ray, lanes | !lanes);
        const Vec3<V>&origin = line.nearest, &way = line.unit;
        const V towards = -(origin.x * way.x + origin.y * way.y + origin.z * way.z);
        const V far = origin.x * origin.x + origin.y * origin.y + origin.z * origin.z;
        const V chord = V(own.square) - far + towards * towards;
        const V root = sqrt(max(chord, zero)), last = towards + root;
        lanes = lanes & (chord > none_yet) & !((far >= V(own.square)) & (towards < none_yet)) & !(last < near);
        if (none(lanes)) return;
        const auto moved = [&](const Vec3<V>& p, const V& by) __attribute__((always_inline)) {
            return Vec3<V>(p.x + by * way.x, p.y + by * way.y, p.z + by * way.z);
        };
        V place = max(towards - root, near), free, free_next;
        Vec3<V> p = moved(origin, place);
        Mask<V> inside = look(own, p, way, lanes, free);
        if (any(inside)) {
            const V step = select(inside, near + near, zero);
            place = place + step, p = moved(p, step);
            lanes = lanes & !(inside & (place > last));
            inside = look(own, p, way, lanes, free);
        }
        int found = 0;
        while (true) {
            free = max(free, V(own.precision));
            place = place + free;
            lanes = lanes & !(place > last);
            if (none(lanes)) return;
            const Vec3<V> before = p;
            p = moved(p, free);
            const Mask<V> inside_next = look(own, p, way, lanes, free_next);
            Mask<V> turns = lanes & ((inside & !inside_next) | (inside_next & !inside));
            if (any(turns)) {
                V step = select(turns, free, zero), at = place - free;
                Vec3<V> q = before;
                while (any(step > near)) {
                    const Mask<V> halves = step > near;
                    step = select(halves, half * step, step);
                    const Vec3<V> middle = moved(q, step);
                    const Mask<V> held = holds(own, middle, turns & halves);
                    const Mask<V> same = turns & halves & ((held & inside) | (!held & !inside));
                    q = select(same, middle, q), at = select(same, at + step, at);
                }
                at = select(inside, at, at + step);
                turns = turns & !(at > last);
                const Mask<V> itself = turns & starts & (at < V(R(1e-4)));
                const V t = at * line.per;
                const Mask<V> there = turns & !itself & (starts | box.holds(ray, t, abs(t)));
                if (any(there)) crossed(there, t, zero), ++found;
                if (found >= enough) lanes = lanes & !there;
                if (std::is_same_v<T, R> && enough == 1) lanes = lanes & !itself;
            }
            inside = inside_next, free = free_next;
        }
    }
    /// Returns the point of one ray at `t`, and the normal there.
    STRAHL_INLINE SurfacePoint<T> at(const void*, const Ray<T>& ray, T t) const {
        using R = std::conditional_t<std::is_same_v<T, float>, double, T>;
        const Vec3<T> position = fma(t, ray.direction, ray.origin), p = turn(position - splat<T>(centre));
        const Vec3<R> n = numbers.template as<R>().normal(Vec3<R>(R(p.x), R(p.y), R(p.z)));
        const R length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        if (!(length > 0) || !(length <= std::numeric_limits<R>::max())) return {position, -ray.direction};
        return {position, this->normal(T(n.x / length), T(n.y / length), T(n.z / length))};
    }

  private:
    template <class V>
    STRAHL_INLINE static Mask<V> look(const JuliaIteration<Element<V>>& own, const Vec3<V>& p, const Vec3<V>& way,
                                      Mask<V> lanes, V& free) {
        if constexpr (width < V >> 1)
            return call_look<V>(own, p, way, lanes, free);
        else
            return own.look(p, way, lanes, free);
    }
    template <class V>
    STRAHL_INLINE static Mask<V> holds(const JuliaIteration<Element<V>>& own, const Vec3<V>& p, Mask<V> lanes) {
        if constexpr (width < V >> 1)
            return call_holds<V>(own, p, lanes);
        else
            return own.holds(p, lanes);
    }
    /// Do so by calls for packs: their code is long, and the calls cost little.
    template <class V>
    [[gnu::noinline]] static Mask<V> call_look(const JuliaIteration<Element<V>>& own, const Vec3<V>& p,
                                               const Vec3<V>& way, Mask<V> lanes, V& free) {
        return own.look(p, way, lanes, free);
    }
    template <class V>
    [[gnu::noinline]] static Mask<V> call_holds(const JuliaIteration<Element<V>>& own, const Vec3<V>& p,
                                                Mask<V> lanes) {
        return own.holds(p, lanes);
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
    /// Returns the words for these.
    std::string words() const {
        return (hypercomplex ? "hypercomplex " : "quaternion ") +
               std::string(julia_words[static_cast<std::size_t>(step)]);
    }
    const char* fault() const {
        if (!hypercomplex && step > JuliaStep::cube) return "quaternions are only squared or cubed";
        if (!(std::fabs(slice_fourth) >= least_slice)) return "the fourth part of its slice is 0";
        return precision >= 1 && precision <= most_precision ? nullptr : "its precision is not from 1 to 100000";
    }
    bool open() const { return false; }
    double radius() const { return std::sqrt(numbers<double>().template as<double>().square); }
    Box bounds() const { return {DVec3(-radius()), DVec3(radius())}; }
    bool contains(const DVec3& p) const { return numbers<double>().template as<double>().holds(p, true); }
    static constexpr int face_count() { return 1; }

    template <class T>
    JuliaNumbers<T> numbers() const {
        const double square = slice.x * slice.x + slice.y * slice.y + slice.z * slice.z + slice_fourth * slice_fourth;
        const double per = 1 / std::sqrt(square);
        return JuliaNumbers<T>::of({constant.x, constant.y, constant.z, fourth, per * slice.x, per * slice.y,
                                    per * slice.z, per * slice_fourth, distance, 1 / precision, exponent, imaginary,
                                    iterations, static_cast<double>(step), hypercomplex ? 0. : 1.});
    }
    template <class T>
    using Kernels = std::tuple<JuliaKernel<T>>;
    template <class T, class Emit>
    void emit(const WorldTransform& to_world, const Emit& emit) const {
        emit(JuliaKernel<T>{ContourKernel<T>::of(DVec3(0), DVec3(1), bounds(), 0, to_world), numbers<T>()});
    }
};

}  // namespace strahl
