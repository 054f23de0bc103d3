// Each formula of proofs on its own, against numbers of 113 bits: rays, bodies and lights that are off by some amount
// of any size, or by rounding alone, in the directions that hurt most.
//
//     PROOF_TRIALS=1000000 test_proof -tc='formulas*' -s     more of them
#include "tests/proof/spans.h"

using namespace strahl;
using namespace strahl::trial;

template <>
struct trial::Case<Sphere> {
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
    /// How far a point is from a face.
    R off(const Vector& p, int) const { return size(length(p - Vector(shape.centre)) - R(shape.radius)); }
    /// Some point of the surface, and the normal there.
    std::pair<Vector, Vector> point(Dice& dice) const {
        const Vector n = unit(Vector(dice.direction()));
        return {Vector(shape.centre) + R(shape.radius) * n, n};
    }
};
template <>
struct trial::Case<Plane> {
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
struct trial::Case<Cylinder> {
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
struct trial::Case<Cone> {
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
        // 113 bits do not tell how an apex is passed that is met but for rounding.
        if (dice.chance(.6) || (cap ? shape.cap_radius : shape.base_radius) == 0)
            return {exact.base + along * exact.axis + radius(along) * out, cosine * out - sine * exact.axis};
        return {exact.base + end * exact.axis + (1 - near) * radius(end) * out, R(cap ? 1 : -1) * exact.axis};
    }
};

/// Rays that hardly lean, and lines that are off by as much as they are slanted.
TEST_CASE("formulas of cylinders' ends") {
    Closest between{"way in and out"};
    Dice dice(8);
    for (int i = 0; i < trials(); ++i) {
        const double height = std::pow(10, dice.in(-1, 1)), start = dice.chance(.5) ? -1 : dice.upto(2);
        const double slope = (dice.chance(.5) ? 1 : -1) * std::pow(10, dice.in(-6, 0));
        const double slope_error = std::abs(slope) * dice.in(0, 1.5), error = any_size(dice, -1) * height;
        // Rays that start on an end are there but for this.
        const double along = start == 1   ? error * dice.in(-1, 1)
                             : start == 2 ? height + error * dice.in(-1, 1)
                                          : height * dice.in(-.5, 1.5);
        const auto most = [&] { return R(dice.chance(.5) ? dice.in(-1, 1) : dice.chance(.5) ? 1 : -1); };
        const R exact_slope = R(slope) + most() * R(slope_error), off = R(along) + most() * R(error);
        if (exact_slope == 0) continue;
        const R to_base = start == 1 ? R(0) : R(-1) * off / exact_slope;
        const R to_cap = start == 2 ? R(0) : (R(height) - off) / exact_slope;
        const R near = to_base < to_cap ? to_base : to_cap, far = to_base < to_cap ? to_cap : to_base;
        if (far < 0) continue;  // all of it is behind the ray
        const double spare = 9 * unit_error<double>;
        const SpanBounds<double> span =
            between_ends(along, slope, height, error + spare * std::abs(along), slope_error + spare, start);
        const auto holds = [](R t, double low, double high) {
            return (low == -inf || R(low) <= t) && (high == inf || t <= R(high));
        };
        between.demand(holds(near, span.near_low, span.near_high) && holds(far, span.far_low, span.far_high));
    }
}

TEST_CASE("formulas of balls") { try_body<Sphere>(1); }
TEST_CASE("formulas of planes") { try_body<Plane>(2); }
TEST_CASE("formulas of cylinders") { try_body<Cylinder>(3); }
TEST_CASE("formulas of cones") { try_body<Cone>(14); }
