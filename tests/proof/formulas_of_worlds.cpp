// Compares errors of worlds and camera rays with the formulas of slack.cpp and eye_bounds.h, by numbers of 113 bits.
#include "tests/proof/trial.h"
#include "trace/proof/eye_bounds.h"
#include "trace/proof/slack.h"
#include "trace/world/extended_numbers.h"

using namespace strahl;
using namespace strahl::trial;

namespace {

std::vector<Transformation> similar(Dice& dice) {
    std::vector<Transformation> steps;
    for (int left = dice.upto(3); left > 0; --left) {
        const int which = dice.upto(2);
        if (which == 0) steps.push_back(Rotate{dice.vector(-200, 200)});
        if (which == 1) steps.push_back(Scale{DVec3(std::pow(10, dice.in(-2, 2)))});
        if (which == 2) steps.push_back(Translate{std::pow(10, dice.in(-1, 4)) * dice.direction()});
    }
    return steps;
}

/// The way into the world, exactly.
struct ExactWay {
    exact::Space<R> space;
    R scale;
    Vector origin;
    ExactWay(const std::vector<Transformation>& steps, const Placement& placement)
        : space(steps), scale(placement.scale), origin(placement.origin) {}
    Vector turned(const Vector& v) const {
        return v.x * space.columns[0] + v.y * space.columns[1] + v.z * space.columns[2];
    }
    Vector place(const Vector& p) const { return scale * (turned(p) + space.moved - origin); }
    R length(R own) const { return scale * trial::length(space.columns[0]) * own; }
};

/// Errors of bodies' numbers in worlds of T, and their bounds.
template <class T>
struct Differences {
    Closest share{"place and size of a body"}, turn{"axis or normal"}, plane{"distance of a plane"};

    static R off(const Vec3<T>& computed, const Vector& exact) { return length(vector(computed) - exact); }

    void compare(const Sphere& shape, const SphereKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        share.take((off(kernel.centre, way.place(shape.centre)) + size(kernel.radius - way.length(shape.radius))) /
                       (norm1(kernel.centre) + kernel.radius),
                   slack.share);
    }
    void compare(const Plane& shape, const PlaneKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        const Vector a = shape.a, u = Vector(shape.b) - a, v = Vector(shape.c) - a;
        const Vector n = unit(cross(way.turned(u), way.turned(v)));
        turn.take(off(kernel.normal, n), slack.turn);
        plane.take(size(kernel.distance - dot(n, way.place(a))), slack.plane);
    }
    void compare(const Cylinder& shape, const CylinderKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        const Vector rise = Vector(shape.cap) - Vector(shape.base);
        share.take((off(kernel.base, way.place(shape.base)) + size(kernel.radius - way.length(shape.radius)) +
                    size(kernel.height - way.length(length(rise)))) /
                       (norm1(kernel.base) + kernel.radius + kernel.height),
                   slack.share);
        turn.take(off(kernel.axis, unit(way.turned(rise))), slack.turn);
    }
    void compare(const Cone& shape, const ConeKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        const referee::ConeShape<R> exact(shape);
        const R cosine = 1 / root(1 + exact.slope * exact.slope), sine = exact.slope * cosine;
        share.take((off(kernel.base, way.place(shape.base)) + size(kernel.radius - way.length(exact.radius)) +
                    size(kernel.height - way.length(exact.height))) /
                       (norm1(kernel.base) + kernel.widest + kernel.height),
                   slack.share);
        turn.take(off(kernel.axis, unit(way.turned(exact.axis))), slack.turn);
        turn.take(length(Vector{kernel.cosine - cosine, kernel.sine - sine, 0}), slack.turn);
    }
    void compare(const Disc& shape, const DiscKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        share.take((off(kernel.centre, way.place(shape.centre)) + size(kernel.radius - way.length(shape.radius)) +
                    size(kernel.hole - way.length(shape.hole))) /
                       (norm1(kernel.centre) + kernel.radius),
                   slack.share);
        turn.take(off(kernel.normal, unit(way.turned(shape.normal))), slack.turn);
    }
    void compare(const Torus& shape, const TorusKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        share.take((off(kernel.centre, way.place(shape.centre)) + size(kernel.major - way.length(shape.major)) +
                    size(kernel.minor - way.length(shape.minor))) /
                       (norm1(kernel.centre) + kernel.major + kernel.minor),
                   slack.share);
        turn.take(off(kernel.axis, unit(way.turned(shape.axis))), slack.turn);
    }
    void compare(const Triangle& shape, const TriangleKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        const R whole = norm1(kernel.a) + norm1(kernel.b) + norm1(kernel.c);
        share.take(off(kernel.a, way.place(shape.a)) / whole, slack.share);
        share.take(off(kernel.b, way.place(shape.b)) / whole, slack.share);
        share.take(off(kernel.c, way.place(shape.c)) / whole, slack.share);
    }
    /// Compares normals as vectors of which the longest has length 1. They may point to either side.
    void compare(const SmoothTriangle& shape, const SmoothTriangleKernel<T>& kernel, const ExactWay& way,
                 const Slack<T>& slack) {
        compare(Triangle{shape.a, shape.b, shape.c}, kernel.flat, way, slack);
        const Vec3<T>* const made[] = {&kernel.normal_a, &kernel.normal_b, &kernel.normal_c};
        Vector exact[] = {shape.normal_a, shape.normal_b, shape.normal_c};
        R longest = 0;
        for (Vector& n : exact) {
            n = unit(n), n = n.x * way.space.rows[0] + n.y * way.space.rows[1] + n.z * way.space.rows[2];
            if (length(n) > longest) longest = length(n);
        }
        const R side = dot(exact[0], vector(*made[0])) < 0 ? -1 : 1;
        for (int i : {0, 1, 2}) turn.take(off(*made[i], side / longest * exact[i]), slack.turn);
    }
    void compare(const Cuboid& shape, const BoxKernel<T>& kernel, const ExactWay& way, const Slack<T>& slack) {
        const Vector low = shape.corner, high = shape.opposite, edges = high - low;
        const auto row = [&](R edge, const Vector& own) { return R(2) / size(edge) / way.scale * own; };
        const Vector rows[] = {row(edges.x, way.space.rows[0]), row(edges.y, way.space.rows[1]),
                               row(edges.z, way.space.rows[2])};
        const Vector made[] = {vector(kernel.row_x), vector(kernel.row_y), vector(kernel.row_z)};
        // The products of corners, seen from the centre, with rows are 1 or -1.
        const auto corner = [](const Vector* own, const Vector& middle, const Vector& products) {
            const Vector u = cross(own[1], own[2]), v = cross(own[2], own[0]), w = cross(own[0], own[1]);
            return middle + R(1) / dot(own[0], u) * (products.x * u + products.y * v + products.z * w);
        };
        const Vector centre = way.place(R(.5) * (low + high));
        for (int i = 0; i < 8; ++i) {
            const auto sign = [&](int bit) { return R(i & bit ? 1 : -1); };
            const Vector products{sign(1), sign(2), sign(4)};
            const R wrong = length(corner(made, vector(kernel.centre), products) - corner(rows, centre, products));
            share.take(wrong / (norm1(kernel.centre) + norm1(kernel.box.half)), slack.share);
        }
        for (int i : {0, 1, 2}) turn.take(length(made[i] - rows[i]) / length(made[i]), slack.turn);
    }
    /// Compares the space in which a body is round: its place, its rows, and the body there.
    template <class Shape, class K>
    requires(!std::is_same_v<Shape, Torus>) void compare(const Shape& shape, const AffineKernel<K, T>& kernel,
                                                         const ExactWay& way, const Slack<T>& slack) {
        const auto centre = [&] {
            if constexpr (requires { shape.centre; })
                return Vector(shape.centre);
            else
                return Vector(shape.base);
        };
        const auto radius = [&]() -> R {
            if constexpr (requires { shape.radius; })
                return shape.radius;
            else
                return std::max(shape.base_radius, shape.cap_radius);
        };
        share.take(off(kernel.centre, way.place(centre())) / (norm1(kernel.centre) + norm1(kernel.box.half)),
                   slack.share);
        const Vector made[] = {vector(kernel.row_x), vector(kernel.row_y), vector(kernel.row_z)};
        const R volume = dot(made[0], cross(made[1], made[2]));
        R square = 0;  // of what exact rows are these times, less 1
        for (int k : {0, 1, 2}) {
            Vector wrong;
            for (int i : {0, 1, 2}) {
                const Vector column = 1 / volume * cross(made[(i + 1) % 3], made[(i + 2) % 3]);
                const Vector row = 1 / (radius() * way.scale) * way.space.rows[i];
                wrong = wrong + (k == 0 ? column.x : k == 1 ? column.y : column.z) * (row - made[i]);
            }
            square = square + dot(wrong, wrong);
        }
        turn.take(root(square), slack.turn);
        compare_own(shape, kernel.shape, slack);
    }
    void compare_own(const Sphere&, const SphereKernel<T>& own, const Slack<T>&) {
        share.demand(norm1(own.centre) == 0 && own.radius == 1);
    }
    void compare_own(const Cylinder& shape, const CylinderKernel<T>& own, const Slack<T>& slack) {
        const Vector rise = Vector(shape.cap) - Vector(shape.base);
        const R wrong = norm1(own.base) + size(own.radius - R(1)) + size(own.height - length(rise) / shape.radius);
        share.take(wrong / (own.radius + own.height), slack.share);
        turn.take(off(own.axis, unit(rise)), slack.turn);
    }
    void compare_own(const Cone& shape, const ConeKernel<T>& own, const Slack<T>& slack) {
        const referee::ConeShape<R> exact(shape);
        const R cosine = 1 / root(1 + exact.slope * exact.slope), sine = exact.slope * cosine;
        const R radius = std::max(shape.base_radius, shape.cap_radius);
        const R wrong = norm1(own.base) + size(own.radius - exact.radius / radius) +
                        size(own.height - exact.height / radius) + size(own.widest - R(1));
        share.take(wrong / (own.widest + own.height), slack.share);
        turn.take(off(own.axis, exact.axis), slack.turn);
        turn.take(length(Vector{own.cosine - cosine, own.sine - sine, 0}), slack.turn);
    }
    void compare_own(const Disc& shape, const DiscKernel<T>& own, const Slack<T>& slack) {
        const R wrong = norm1(own.centre) + size(own.radius - R(1)) + size(own.hole - R(shape.hole) / shape.radius);
        share.take(wrong / own.radius, slack.share);
        turn.take(off(own.normal, unit(Vector(shape.normal))), slack.turn);
    }

    /// Compares the kernels of a shape under these transformations, some of them uneven.
    template <class Shape>
    void take(const Shape& shape, std::vector<Transformation> steps, const std::vector<Transformation>& uneven,
              const Placement& placement) {
        steps.insert(steps.end(), uneven.begin(), uneven.end());
        Scene scene;
        scene.primitives.push_back({shape, 0, steps});
        const Slack<T> slack = slack_of<T>(scene, placement);
        const WorldTransform to_world{matrix(steps), similarity(steps), placement.origin, placement.scale};
        emit_in<T>(shape, to_world, steps, [&](const auto& kernel) {
            if constexpr (requires { compare(shape, kernel, ExactWay(steps, placement), slack); })
                compare(shape, kernel, ExactWay(steps, placement), slack);
        });
    }
};

/// Errors of camera rays in T, and their bounds.
template <class T>
struct RayDifferences {
    Closest start{"start"}, turn{"direction"};

    void take(const View& view, const Placement& placement, int x, int y) {
        Slack<T> slack;
        add_eye(slack, view, placement);
        const Eye<T> eye = eye_of<T>(view, placement);
        const exact::Eye exact(view);
        // Computes u and v as the kernel does.
        const T u = fma(T(x), eye.scale_x, eye.bias_x), v = fma(T(y), eye.scale_y, eye.bias_y);
        const Vec3<T> d = fma(u, eye.right, fma(v, eye.down, eye.forward));
        const Vec3<T> direction = scale(1 / std::sqrt(dot(d, d)), d);
        turn.take(length(exact.ray(x, y).direction - unit(vector(direction))), camera_turn(eye, slack, T(x), T(y)));
        const Vector place = R(placement.scale) * (exact.position - Vector(placement.origin));
        start.take(length(place - vector(eye.position)), slack.eye_away);
    }
};

}  // namespace

TEST_CASE("formulas of worlds") {
    Differences<double> differences;
    Differences<Extended> in_extended;
    Dice dice(9);
    for (int i = 0; i < trials(); ++i) {
        const double far = std::pow(10, dice.in(-1, 5));
        const Placement placement{dice.chance(.5) ? DVec3(0) : dice.vector(-far, far),
                                  std::ldexp(1, dice.upto(20) - 10)};
        const DVec3 at = dice.vector(-far, far);
        const std::vector<Transformation> steps = similar(dice);
        const std::vector<Transformation> uneven{Scale{dice.vector(.1, 3)}, Rotate{dice.vector(-200, 200)}};
        const std::vector<Transformation> more = dice.chance(.5) ? uneven : std::vector<Transformation>{};
        const auto take = [&](const auto& shape) {
            differences.take(shape, steps, more, placement), in_extended.take(shape, steps, more, placement);
        };
        const int which = dice.upto(8);
        if (which == 8) take(Torus{at, dice.arrow(.1, 3), dice.in(.5, 3), dice.in(.1, 3)});
        if (which == 0) take(Sphere{at, dice.in(.1, 3)});
        if (which == 1) take(Plane{at, at + dice.direction(), at + dice.direction()});
        if (which == 2) take(Cylinder{at, at + dice.arrow(.1, 3), dice.in(.1, 3)});
        if (which == 5) take(Triangle{at, at + dice.arrow(.1, 3), at + dice.arrow(.1, 3)});
        if (which == 6) take(Cone{at, dice.in(.1, 3), at + dice.arrow(.1, 3), dice.chance(.5) ? 0 : dice.in(0, 3)});
        if (which == 7)
            take(SmoothTriangle{at, at + dice.arrow(.1, 3), at + dice.arrow(.1, 3), dice.arrow(.1, 3),
                                dice.arrow(.1, 3), dice.arrow(.1, 3)});
        if (which == 4) take(Cuboid{at, at + dice.arrow(.1, 3)});
        if (which == 3) take(Disc{at, dice.arrow(.1, 3), dice.in(.2, 3), dice.chance(.5) ? 0 : dice.in(.01, .19)});
    }
}

TEST_CASE("formulas of camera rays") {
    RayDifferences<double> differences;
    RayDifferences<Extended> in_extended;
    Dice dice(10);
    for (int i = 0; i < trials(); ++i) {
        const double far = std::pow(10, dice.in(-1, 3));
        View view;
        view.prove = true;
        view.width = 1 + dice.upto(2000), view.height = 1 + dice.upto(2000);
        view.camera.position = dice.vector(-far, far);
        view.camera.look_at = view.camera.position + dice.arrow(1, 10);
        view.camera.up = dice.direction(), view.camera.fov = dice.in(1, 80);
        const Placement placement{dice.chance(.5) ? DVec3(0) : dice.vector(-far, far), std::ldexp(1, dice.upto(8) - 4)};
        const int x = dice.upto(view.width - 1), y = dice.upto(view.height - 1);
        differences.take(view, placement, x, y), in_extended.take(view, placement, x, y);
    }
}
