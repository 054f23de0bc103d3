// Balls, planes, cylinders, cones and discs to try the formulas of, and as kernels have them, which are off.
#pragma once
#include "tests/proof/spans.h"

namespace strahl::trial {

template <>
struct Case<Sphere> {
    Sphere shape;
    SphereKernel<double> kernel;
    Slack<double> slack;
    explicit Case(Dice& dice) : shape{dice.vector(-3, 3), std::pow(10, dice.in(-1.5, .5))} {
        const double off = any_size(dice, -7);
        kernel = {rounded(Vector(shape.centre) + R(off) * Vector(dice.direction())), shape.radius * (1 + off)};
        const R wrong = length(vector(kernel.centre) - Vector(shape.centre)) + size(R(kernel.radius) - R(shape.radius));
        slack.share = 1.0000001 * above(wrong / (R(norm1(kernel.centre)) + R(kernel.radius)));
    }
    double scale() const { return shape.radius; }
    /// Returns the distance of a point from a face.
    R off(const Vector& p, int) const { return size(length(p - Vector(shape.centre)) - R(shape.radius)); }
    /// Returns a random point of the surface, and the normal there.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const Vector n = unit(Vector(dice.direction()));
        return {Vector(shape.centre) + R(shape.radius) * n, n};
    }
};
template <>
struct Case<Plane> {
    Plane shape;
    PlaneKernel<double> kernel;
    Slack<double> slack;
    explicit Case(Dice& dice) {
        shape.a = dice.vector(-3, 3), shape.b = shape.a + dice.direction(), shape.c = shape.a + dice.direction();
        const double off = any_size(dice, -7);
        const Vector n = unit(referee::normal<R>(shape)), across = perpendicular(dice, n);
        kernel.normal = rounded(unit(n + R(off) * across));
        kernel.distance = static_cast<double>(dot(n, Vector(shape.a))) + off;
        slack.turn = above(length(vector(kernel.normal) - n));
        slack.plane = above(size(kernel.distance - dot(n, Vector(shape.a))));
    }
    double scale() const { return 1; }
    R off(const Vector& p, int) const { return size(dot(unit(referee::normal<R>(shape)), p - Vector(shape.a))); }
    std::pair<Vector, Vector> point(Dice& dice) const {
        const Vector n = unit(referee::normal<R>(shape));
        return {Vector(shape.a) + R(dice.in(-3, 3)) * perpendicular(dice, n), n};
    }
};
template <>
struct Case<Cylinder> {
    Cylinder shape;
    CylinderKernel<double> kernel;
    Slack<double> slack;
    Vector axis;
    R height;
    explicit Case(Dice& dice) {
        shape.base = dice.vector(-3, 3), shape.cap = shape.base + dice.arrow(.1, 3);
        shape.radius = std::pow(10, dice.in(-1.5, .3));
        const Vector rise = Vector(shape.cap) - Vector(shape.base);
        height = length(rise), axis = unit(rise);
        const double off = any_size(dice, -7);
        kernel.axis = rounded(unit(axis + R(off) * perpendicular(dice, axis)));
        kernel.base = rounded(Vector(shape.base) + R(off) * Vector(dice.direction()));
        kernel.radius = shape.radius * (1 + off), kernel.height = static_cast<double>(height) * (1 - off);
        slack.turn = above(length(vector(kernel.axis) - axis));
        const R wrong = length(vector(kernel.base) - Vector(shape.base)) + size(R(kernel.radius) - R(shape.radius)) +
                        size(R(kernel.height) - height);
        slack.share = 1.0000001 * above(wrong / (R(norm1(kernel.base)) + R(kernel.radius) + R(kernel.height)));
    }
    double scale() const { return shape.radius; }
    R off(const Vector& p, int face) const {
        const Vector f = p - Vector(shape.base);
        const R along = dot(f, axis);
        return size(face == 0 ? length(f - along * axis) - R(shape.radius) : face == 1 ? along : along - height);
    }
    /// Half of them near a rim.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const Vector out = perpendicular(dice, axis), base = shape.base;
        const R near = dice.chance(.5) ? R(std::pow(10, dice.in(-14, -1))) : R(dice.in(0, 1));
        const bool cap = dice.chance(.5);
        if (dice.chance(.5))
            return {base + (cap ? (1 - near) * height : near * height) * axis + R(shape.radius) * out, out};
        return {base + (cap ? height : R(0)) * axis + R(shape.radius) * (1 - near) * out, R(cap ? 1 : -1) * axis};
    }
};
template <>
struct Case<Cone> {
    Cone shape;
    ConeKernel<double> kernel;
    Slack<double> slack;
    referee::ConeShape<R> exact{Cone{}};
    R cosine, sine;
    /// Half of them have an apex.
    explicit Case(Dice& dice) {
        shape.base = dice.vector(-3, 3), shape.cap = shape.base + dice.arrow(.1, 3);
        shape.base_radius = std::pow(10, dice.in(-1.5, .3));
        shape.cap_radius = dice.chance(.5) ? 0 : std::pow(10, dice.in(-1.5, .3));
        if (dice.chance(.5)) std::swap(shape.base_radius, shape.cap_radius);
        exact = referee::ConeShape<R>(shape);
        cosine = 1 / root(1 + exact.slope * exact.slope), sine = exact.slope * cosine;
        const double off = any_size(dice, -7), widest = std::max(shape.base_radius, shape.cap_radius);
        kernel.axis = rounded(unit(exact.axis + R(off) * perpendicular(dice, exact.axis)));
        kernel.base = rounded(Vector(shape.base) + R(off) * Vector(dice.direction()));
        kernel.radius = shape.base_radius * (1 + off), kernel.height = static_cast<double>(exact.height) * (1 - off);
        const R angle = (dice.chance(.5) ? 1 : -1) * off;
        kernel.cosine = static_cast<double>(cosine - angle * sine), kernel.widest = widest;
        kernel.sine = static_cast<double>(sine + angle * cosine);
        const Vector wrong_angle{R(kernel.cosine) - cosine, R(kernel.sine) - sine, 0};
        slack.turn = std::max(above(length(vector(kernel.axis) - exact.axis)), above(length(wrong_angle)));
        const R wrong = length(vector(kernel.base) - Vector(shape.base)) +
                        size(R(kernel.radius) - R(shape.base_radius)) + size(R(kernel.height) - exact.height);
        slack.share = 1.0000001 * above(wrong / (R(norm1(kernel.base)) + R(widest) + R(kernel.height)));
    }
    double scale() const { return kernel.widest; }
    R radius(R along) const { return exact.radius + exact.slope * along; }
    R off(const Vector& p, int face) const {
        const Vector f = p - exact.base;
        const R along = dot(f, exact.axis);
        if (face == 0) return size(cosine * (length(f - along * exact.axis) - radius(along)));
        return size(face == 1 ? along : along - exact.height);
    }
    /// Half of them near a rim or an apex, on either side of it.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const Vector out = perpendicular(dice, exact.axis);
        const bool cap = dice.chance(.5);
        R near = dice.in(0, 1);
        if (dice.chance(.5)) near = std::pow(10, dice.in(-14, -1)) * (dice.chance(.7) ? 1 : -1);
        const R along = (cap ? 1 - near : near) * exact.height, end = cap ? exact.height : R(0);
        // 113 bits do not tell on which side a ray passes an apex that it meets up to rounding.
        if (dice.chance(.6) || (cap ? shape.cap_radius : shape.base_radius) == 0)
            return {exact.base + along * exact.axis + radius(along) * out, cosine * out - sine * exact.axis};
        return {exact.base + end * exact.axis + (1 - near) * radius(end) * out, R(cap ? 1 : -1) * exact.axis};
    }
};
template <>
struct Case<Disc> {
    Disc shape;
    DiscKernel<double> kernel;
    Slack<double> slack;
    Vector normal;
    explicit Case(Dice& dice) {
        shape.centre = dice.vector(-3, 3), shape.normal = dice.arrow(.1, 3);
        shape.radius = std::pow(10, dice.in(-1.5, .5));
        shape.hole = dice.chance(.5) ? 0 : shape.radius * dice.in(.01, .99);
        normal = unit(Vector(shape.normal));
        const double off = any_size(dice, -7);
        kernel.normal = rounded(unit(normal + R(off) * perpendicular(dice, normal)));
        kernel.centre = rounded(Vector(shape.centre) + R(off) * Vector(dice.direction()));
        kernel.radius = shape.radius * (1 + off), kernel.hole = shape.hole * (1 - off);
        slack.turn = above(length(vector(kernel.normal) - normal));
        const R wrong = length(vector(kernel.centre) - Vector(shape.centre)) +
                        size(R(kernel.radius) - R(shape.radius)) + size(R(kernel.hole) - R(shape.hole));
        slack.share = 1.0000001 * above(wrong / (R(norm1(kernel.centre)) + R(kernel.radius)));
    }
    double scale() const { return shape.radius; }
    R off(const Vector& p, int) const { return size(dot(normal, p - Vector(shape.centre))); }
    /// Returns a random point of the surface, two times in three near a rim, on either side of it.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const int which = dice.upto(2);
        const R near = std::pow(10, dice.in(-15, -1)) * (dice.chance(.7) ? 1 : -1);
        const R out = which == 0   ? R(shape.radius) * (1 - near)
                      : which == 1 ? R(shape.hole) * (1 + near)
                                   : R(dice.in(shape.hole, shape.radius));
        return {Vector(shape.centre) + out * perpendicular(dice, normal), normal};
    }
};

}  // namespace strahl::trial
