#include "scene/motion/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "num/vec_math.h"
#include "scene/motion/set_followed.h"

namespace strahl {
namespace {

/// The rotation about a vector by its length, in radians.
glm::dquat exponential(const DVec3& turn) {
    const double half = length(turn) / 2;
    if (half == 0) return {1, 0, 0, 0};
    const DVec3 v = turn / (2 * half) * std::sin(half);
    return {std::cos(half), v.x, v.y, v.z};
}
/// The shorter of the two vectors of a rotation. Of half a turn, where both are equally long, the one as it is written.
DVec3 logarithm(const glm::dquat& q) {
    const DVec3 v(q.x, q.y, q.z);
    const double sine = length(v);
    if (sine == 0) return DVec3(0);
    const bool longer = q.w < -1e-9;
    return v / sine * (longer ? -2 * std::atan2(sine, -q.w) : 2 * std::atan2(sine, q.w));
}

/// The quaternion of a Rotate.
glm::dquat quaternion(const DVec3& degrees) {
    glm::dquat product{1, 0, 0, 0};
    for (int axis = 0; axis < 3; ++axis) {
        if (degrees[axis] == 0) continue;
        const double turn = std::fabs(degrees[axis]) <= 360 ? degrees[axis] : std::remainder(degrees[axis], 720);
        const double half = turn * (std::numbers::pi / 360);
        DVec3 v{0};
        v[axis] = std::sin(half);
        product = glm::dquat(std::cos(half), v.x, v.y, v.z) * product;
    }
    return product;
}
/// The degrees of a Rotate. About z by what is left after x, so that rounding does not show where both have one axis.
DVec3 degrees_of(const glm::dquat& q) {
    const glm::dmat3 m = glm::mat3_cast(q);  // m[column][row]
    const double x = std::atan2(m[1][2], m[2][2]), y = std::atan2(0 - m[0][2], std::hypot(m[0][0], m[0][1]));
    const double s = std::sin(x), c = std::cos(x);
    const double z = std::atan2(s * m[2][0] - c * m[1][0], c * m[1][1] - s * m[2][1]);
    return DVec3(x, y, z) * (180 / std::numbers::pi);
}

DVec3 rotation_at(const Window<MotionKey>& w) {
    const auto [spline, start, about] = rotation_curve(w);
    if (spline.knots == 0) return w.key[1]->rotate;  // written in different ways
    const double h = spline.share(w.h), g = 1 - h;
    return degrees_of(start * exponential(about[0] * (1 - g * g * g)) * exponential(about[1] * (h * h * (3 - 2 * h))) *
                      exponential(about[2] * (h * h * h)));
}

void append(std::vector<Transformation>& steps, const MotionKey& key) {
    if (key.scale != DVec3(1)) steps.push_back(Scale{key.scale});
    if (key.rotate != DVec3(0)) steps.push_back(Rotate{key.rotate});
    if (key.translate != DVec3(0)) steps.push_back(Translate{key.translate});
}
void append(std::vector<Transformation>& steps, std::span<const Transformation> moving, double time,
            const TrackValues& tracks) {
    for (const Transformation& step : moving)
        if (const Motion* const motion = std::get_if<Motion>(&step))
            append(steps, key_at(*motion, time, tracks));
        else
            steps.push_back(step);
}

double safe_factor(double factor) { return std::copysign(std::clamp(std::fabs(factor), 1e-4, 1e4), factor); }

}  // namespace

void follow(MotionKey& key, const TrackValues& values) {
    set_followed(key.follows, values, [&](const std::string& name) {
        return name == "translate" ? target(key.translate) : name == "rotate" ? target(key.rotate) : target(key.scale);
    });
    if (any_follows(key.follows, "scale"))
        for (int c = 0; c < 3; ++c) key.scale[c] = safe_factor(key.scale[c]);
    key.follows.clear();
}

RotationCurve rotation_curve(const Window<MotionKey>& w) {
    std::array<glm::dquat, 4> at_keys;
    for (int i = 0; i < 4; ++i)
        if (w.key[i]) at_keys[i] = quaternion(w.key[i]->rotate);
    std::array<DVec3, 3> turns{DVec3(0), DVec3(0), DVec3(0)};
    for (int i = 0; i < 3; ++i)
        if (w.key[i] && w.key[i + 1] && w.key[i]->rotate != w.key[i + 1]->rotate)
            turns[i] = logarithm(conjugate(at_keys[i]) * at_keys[i + 1]);
    RotationCurve curve{spline(w, turns), at_keys[1]};
    const DVec3 first = curve.spline.m / 3., last = curve.spline.n / 3.;
    curve.about = {first, logarithm(exponential(-first) * exponential(turns[1]) * exponential(-last)), last};
    return curve;
}

MotionKey key_at(const Motion& motion, double time, const TrackValues& tracks) {
    const auto [key, w] = moment_among(motion.keys, 0, time);
    if (key) {
        MotionKey own = *key;
        follow(own, tracks);
        return own;
    }
    const MotionKey &from = *w.key[1], &to = *w.key[2];
    MotionKey moment{time, from.translate, from.rotate, from.scale};
    if (from.translate != to.translate) moment.translate = point_at(w, &MotionKey::translate);
    if (from.rotate != to.rotate) moment.rotate = rotation_at(w);
    if (from.scale != to.scale)
        for (int c = 0; c < 3; ++c) moment.scale[c] = number_at(w, [c](const MotionKey& k) { return k.scale[c]; });
    return moment;
}

std::vector<Transformation> steps_of(const MotionKey& key) {
    std::vector<Transformation> steps;
    append(steps, key);
    return steps;
}
std::vector<Transformation> at(const Motion& motion, double time, const TrackValues& tracks) {
    return steps_of(key_at(motion, time, tracks));
}
std::vector<Transformation> at(std::span<const Transformation> steps, double time, const TrackValues& tracks) {
    std::vector<Transformation> still;
    append(still, steps, time, tracks);
    return still;
}
void set_at(std::vector<Transformation>& still, std::span<const Transformation> steps, double time,
            const TrackValues& tracks) {
    still.clear();
    append(still, steps, time, tracks);
}

std::vector<double> key_times(std::span<const Transformation> steps) {
    std::vector<double> times;
    for (const Transformation& step : steps)
        if (const Motion* const motion = std::get_if<Motion>(&step))
            for (const MotionKey& key : motion->keys) times.push_back(key.time);
    return times;
}

}  // namespace strahl
