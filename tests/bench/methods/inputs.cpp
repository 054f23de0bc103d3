#include "tests/bench/methods/inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/stability/naive.h"
#include "tests/stability/stage.h"

namespace strahl::bench {
namespace {

using stability::Dice;
using Q = Quadruple;
using QVec3 = Vec3<Q>;
constexpr Q none = -7;  // a miss; rays that meet their own surface answer -1

Q magnitude(Q a) { return a < 0 ? -a : a; }
DVec3 unit(const DVec3& v) { return v / naive::length(v); }
DVec3 across(const DVec3& v, Dice& dice) {
    const DVec3 w = dice.direction();
    return unit(w - v * (naive::times(v, w) / naive::times(v, v)));
}
double power(Dice& dice, double low, double high) { return std::pow(10, dice(low, high)); }

struct Case {
    DVec3 o, aim, a, b{0, 0, 1};
    double r = 1, h = 1;
};

/// A body of this size and an eye at this distance in radii, which looks past its middle by up to `reach` radii.
Case around(Dice& dice, double size, double distance, double reach) {
    const DVec3 from = dice.direction();
    return {.o = from * (size * distance), .aim = across(from, dice) * (size * reach), .a = DVec3(0), .r = size};
}
Case round_case(std::string_view input, Dice& dice) {
    const double reach = dice(0, 1.2);
    if (input == "far") return around(dice, dice(.5, 2), power(dice, 3, 5), reach);
    if (input == "tiny") return around(dice, power(dice, -6, -4), power(dice, .3, 4), reach);
    if (input == "grazing")
        return around(dice, dice(.1, 2), dice(2, 20), 1 + (dice(0, 1) < .5 ? -1 : 1) * power(dice, -6, -3));
    if (input == "huge") {  // the ground: the eye just above, looking down
        const double r = power(dice, 4, 6), above = power(dice, 0, 1);
        const DVec3 up = dice.direction(), o = up * (r + above);
        return {.o = o, .aim = o - up * above + across(up, dice) * (above * dice(0, 20)), .a = DVec3(0), .r = r};
    }
    Case c = around(dice, dice(.1, 2), dice(2, 20), reach);
    if (input == "shifted")
        for (DVec3* p : {&c.o, &c.aim, &c.a}) *p += DVec3(1e4, -1e4, 1e4);
    return c;
}
Case plane_case(std::string_view input, Dice& dice) {
    const double scale = input == "far" ? 1e5 : input == "huge" ? 1e9 : input == "tiny" ? 1e-6 : 1;
    const double slope = input == "grazing" ? power(dice, -7, -4) : dice(.05, 1);
    const DVec3 n = dice.direction(), o = dice.direction() * scale;
    Case c{.o = o, .aim = o - n * slope + across(n, dice), .a = o - n * (scale * dice(.1, 10)), .b = n};
    if (input == "shifted")
        for (DVec3* p : {&c.o, &c.aim, &c.a}) *p += DVec3(1e4, -1e4, 1e4);
    return c;
}
Case cylinder_case(std::string_view input, Dice& dice) {
    Case c = round_case(input == "grazing" ? "easy" : input, dice);
    c.b = dice.direction();
    c.h = c.r * dice(.5, 3);
    c.a -= c.b * (c.h / 2);
    if (input == "grazing") {  // along the axis but for the last bits
        const DVec3 off = across(c.b, dice);
        c.o = c.a - c.b * (5 * c.r) + off * (c.r * dice(0, 1.2));
        c.aim = c.o + c.b + off * (dice(0, 1) < .3 ? 0 : power(dice, -30, -5));
    } else if (input == "huge") {  // the eye above the side
        c.a = c.a + c.b * (c.h / 2) - c.b * (c.h / 2);
    }
    return c;
}
Case box_case(std::string_view input, Dice& dice) {
    const double scale = input == "huge" ? 1e6 : input == "tiny" ? 1e-6 : 1;
    Case c{.o = dice.direction() * scale * (input == "far" ? power(dice, 3, 5) : dice(3, 9)),
           .aim = {},
           .a = DVec3(dice(-1, 0), dice(-1, 0), dice(-1, 0)) * scale,
           .b = DVec3(dice(0, 1), dice(0, 1), dice(0, 1)) * scale};
    const int flat = static_cast<int>(dice(0, 3));
    if (input == "grazing" && dice(0, 1) < .7) c.b[flat] = c.a[flat];  // without thickness
    for (int i = 0; i < 3; ++i) c.aim[i] = dice(c.a[i], c.b[i]);
    if (input == "grazing") {  // to an edge, or along one in the box's face
        const int edge = static_cast<int>(dice(0, 3));
        for (int i = 0; i < 3; ++i)
            if (i != edge) c.aim[i] = dice(0, 1) < .5 ? c.a[i] : c.b[i];
        if (dice(0, 1) < .3) c.o = c.aim, c.o[flat] = -5;
    }
    if (input == "shifted")
        for (DVec3* p : {&c.o, &c.aim, &c.a, &c.b}) *p += DVec3(1e4, -1e4, 1e4);
    return c;
}

/// Returns the t at which the ray first meets the sphere, or `none`.
Q sphere_root(const QVec3& o, const QVec3& d, const QVec3& c, Q r) {
    const auto roots = naive::sphere<Q>(o, d, c, r);
    if (!roots.hit || roots.far <= 0) return none;
    return roots.near > 0 ? roots.near : roots.far;
}
Q cylinder_root(const QVec3& o, const QVec3& d, const QVec3& base, const QVec3& axis, Q r, Q h) {
    const Q square = naive::times(axis, axis);  // the axis is of length 1 but for rounding
    const QVec3 f = o - base;
    const Q fa = naive::times(f, axis), da = naive::times(d, axis);
    const QVec3 g = f - axis * (fa / square), e = d - axis * (da / square);
    const Q a = naive::times(e, e), b = naive::times(g, e), c = naive::times(g, g) - r * r;
    Q near = -std::numeric_limits<double>::infinity(), far = std::numeric_limits<double>::infinity();
    if (a > 0) {
        const Q k = b * b - a * c;
        if (k <= 0) return none;
        near = (-b - root(k)) / a, far = (-b + root(k)) / a;
    } else if (c >= 0) {
        return none;
    }
    if (da != 0) {
        const Q low = -fa / da, high = (h - fa) / da;
        near = std::max(near, std::min(low, high)), far = std::min(far, std::max(low, high));
    } else if (fa <= 0 || fa >= h) {
        return none;
    }
    return near < far && far > 0 ? (near > 0 ? near : far) : none;
}
Q box_root(const QVec3& o, const QVec3& d, const QVec3& low, const QVec3& high) {
    Q near = 0, far = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        if (d[i] == 0) {
            if (o[i] < low[i] || o[i] > high[i]) return none;
            continue;
        }
        const Q a = (low[i] - o[i]) / d[i], b = (high[i] - o[i]) / d[i];
        near = std::max(near, std::min(a, b)), far = std::min(far, std::max(a, b));
    }
    return near <= far ? near : none;
}
double quantile(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(.999 * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace

template <class T>
Rays<T> rays_for(std::string_view group, std::string_view input, std::size_t n) {
    Rays<T> rays;
    for (auto& column : rays.column) column.resize(n);
    Dice dice;
    for (std::size_t i = 0; i < n; ++i) {
        const Case c = group == "plane"      ? plane_case(input, dice)
                       : group == "cylinder" ? cylinder_case(input, dice)
                       : group == "box"      ? box_case(input, dice)
                                             : round_case(input, dice);
        // The direction from the rounded origin, so that it still aims at what it should.
        const Vec3<T> o = naive::to<T>(c.o);
        Vec3<T> d = naive::to<T>(c.aim - naive::to<double>(o));
        d = d / naive::length(d);
        const Vec3<T> a = naive::to<T>(c.a);
        Vec3<T> b = naive::to<T>(c.b);
        if (group == "plane" || group == "cylinder") b = b / naive::length(b);
        double h = c.h;
        if (group == "plane") h = naive::times(c.b, c.a);
        if (group == "box")
            h = 4 * double(std::numeric_limits<float>::epsilon()) *  // boxes are kept in float
                std::max({std::abs(c.a.x), std::abs(c.b.x), std::abs(c.a.y), std::abs(c.b.y), std::abs(c.a.z),
                          std::abs(c.b.z), std::abs(c.o.x) * .1, std::abs(c.o.y) * .1, std::abs(c.o.z) * .1});
        for (int k = 0; k < 3; ++k) {
            rays.column[Rays<T>::ox + k][i] = o[k], rays.column[Rays<T>::dx + k][i] = d[k];
            rays.column[Rays<T>::ax + k][i] = a[k], rays.column[Rays<T>::bx + k][i] = b[k];
        }
        rays.column[Rays<T>::r][i] = static_cast<T>(c.r), rays.column[Rays<T>::h][i] = static_cast<T>(h);
    }
    return rays;
}

template <class T>
Wrong judge(std::string_view group, const Rays<T>& rays, const Answers<T>& answers) {
    Wrong wrong;
    std::vector<double> errors, distances;
    std::size_t asked = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto number = [&](int c) { return static_cast<Q>(rays.column[c][i]); };
        const auto vector = [&](int c) { return QVec3(number(c), number(c + 1), number(c + 2)); };
        using R = Rays<T>;
        const QVec3 o = vector(R::ox), d = vector(R::dx), a = vector(R::ax), b = vector(R::bx);
        const Q r = number(R::r), h = number(R::h), t = static_cast<Q>(answers.t[i]);
        const QVec3 p(answers.x[i], answers.y[i], answers.z[i]);
        const bool hit = std::isfinite(answers.t[i]);
        Q exact = none, off = 0;
        if (group == "box") {
            exact = box_root(o, d, a, b);
            ++asked;
            wrong.answers += exact != none && !hit;
            continue;
        }
        if (group == "sphere" || group == "start") {
            exact = sphere_root(o, d, a, r);
            off = (naive::length(p - a) - r) / r;
        } else if (group == "plane") {
            exact = (h - naive::times(b, o)) / naive::times(b, d);
            if (exact <= 0) exact = none;
            off = (naive::times(b, p) - h) / naive::length(o - a);
        } else {
            exact = cylinder_root(o, d, a, b, r, h);
            const Q along = naive::times(p - a, b);
            const Q side = naive::length(p - a - b * along) - r;
            off = std::min({magnitude(side), magnitude(along), magnitude(along - h)}) / r;
        }
        if (group == "start") {
            if (exact == none) continue;
            // The chord, in radii, from the point that was found.
            exact = -2 * naive::times(d, p - a) / naive::times(d, d);
            ++asked;
            const bool right = hit && t >= 0;
            wrong.answers += !right;
            if (right) errors.push_back(static_cast<double>(magnitude(t - exact) / r));
            continue;
        }
        ++asked;
        wrong.answers += hit != (exact != none);
        if (!hit || exact == none) continue;
        errors.push_back(static_cast<double>(magnitude(t - exact) / exact));
        distances.push_back(static_cast<double>(magnitude(off)));
    }
    wrong.answers /= static_cast<double>(std::max<std::size_t>(asked, 1));
    wrong.t = quantile(errors), wrong.surface = quantile(distances);
    return wrong;
}

template Rays<float> rays_for(std::string_view, std::string_view, std::size_t);
template Rays<double> rays_for(std::string_view, std::string_view, std::size_t);
template Rays<long double> rays_for(std::string_view, std::string_view, std::size_t);
template Wrong judge(std::string_view, const Rays<float>&, const Answers<float>&);
template Wrong judge(std::string_view, const Rays<double>&, const Answers<double>&);
template Wrong judge(std::string_view, const Rays<long double>&, const Answers<long double>&);

}  // namespace strahl::bench
