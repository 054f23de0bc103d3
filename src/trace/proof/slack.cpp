#include "trace/proof/slack.h"

#include <algorithm>
#include <cmath>

#include "scene/leaves.h"
#include "scene/overlap.h"
#include "trace/world/extended_numbers.h"

namespace strahl {
namespace {

/// Compares the kernels that a shape emits with those made in long double, and raises slack by the differences.
template <class T>
struct Comparison {
    const ExtendedTransform& to_world;
    Slack<T>& slack;
    std::size_t& triangles;  // number of compared triangles of the mesh

    static void raise(T& most, Extended value) {
        most = std::max(most, value < 1e300L ? static_cast<T>(value) * (1 + 1e-15) : HUGE_VAL);
    }
    static Extended apart(const Vec3<T>& a, const ExtendedVector& b) { return sum_of(extended(a) - b); }

    void operator()(const Sphere& sphere, const SphereKernel<T>& kernel) const {
        const SphereKernel<Extended> own = extended_kernel(sphere, to_world);
        const Extended off = apart(kernel.centre, own.centre) + to_world.rounding(sphere.centre) +
                             std::abs(kernel.radius - own.radius) + to_world.rounding() * kernel.radius;
        raise(slack.share, off / (sum_of(extended(kernel.centre)) + kernel.radius));
    }
    void operator()(const Plane& plane, const PlaneKernel<T>& kernel) const {
        const PlaneKernel<Extended> own = extended_kernel(plane, to_world);
        const ExtendedVector a = extended(plane.a), u = to_world.turn(extended(plane.b) - a),
                             v = to_world.turn(extended(plane.c) - a), p = to_world.point(plane.a);
        const Extended condition = quick_length(u) * quick_length(v) / quick_length(cross_product(u, v));
        raise(slack.turn, quick_length(extended(kernel.normal) - own.normal) + to_world.rounding() * condition);
        raise(slack.plane, std::abs(kernel.distance - own.distance) + to_world.rounding(plane.a) +
                               to_world.rounding() * condition * (sum_of(p) + std::abs(Extended(kernel.distance))));
    }
    void operator()(const Cylinder& cylinder, const CylinderKernel<T>& kernel) const {
        compare(kernel, extended_kernel(cylinder, to_world), to_world.rounding(cylinder.base), to_world.rounding());
    }
    void operator()(const Cone& cone, const ConeKernel<T>& kernel) const {
        compare(kernel, extended_kernel(cone, to_world), to_world.rounding(cone.base), to_world.rounding());
    }
    void operator()(const Torus& torus, const TorusKernel<T>& kernel) const {
        compare(kernel, extended_kernel(torus, to_world), to_world.rounding(torus.centre), to_world.rounding());
    }
    void operator()(const Disc& disc, const DiscKernel<T>& kernel) const {
        compare(kernel, extended_kernel(disc, to_world), to_world.rounding(disc.centre), to_world.rounding());
    }
    /// Compares kernels, of which long double's own positions are off by `place` and its lengths and directions by the
    /// share `rounding`.
    void compare(const CylinderKernel<T>& kernel, const CylinderKernel<Extended>& own, Extended place,
                 Extended rounding) const {
        const Extended off = apart(kernel.base, own.base) + place + std::abs(kernel.radius - own.radius) +
                             std::abs(kernel.height - own.height) + rounding * (kernel.radius + kernel.height);
        raise(slack.share, off / (sum_of(extended(kernel.base)) + kernel.radius + kernel.height));
        raise(slack.turn, quick_length(extended(kernel.axis) - own.axis) + rounding);
    }
    void compare(const ConeKernel<T>& kernel, const ConeKernel<Extended>& own, Extended place,
                 Extended rounding) const {
        const Extended size = kernel.widest + Extended(kernel.height);
        const Extended off = apart(kernel.base, own.base) + place + std::abs(kernel.radius - own.radius) +
                             std::abs(kernel.height - own.height) + 2 * rounding * size;
        const ExtendedVector angle{kernel.cosine - own.cosine, kernel.sine - own.sine, 0};
        raise(slack.share, off / (sum_of(extended(kernel.base)) + size));
        raise(slack.turn, std::max(quick_length(extended(kernel.axis) - own.axis), quick_length(angle)) + rounding);
    }
    void compare(const TorusKernel<T>& kernel, const TorusKernel<Extended>& own, Extended place,
                 Extended rounding) const {
        const Extended size = kernel.major + Extended(kernel.minor);
        const Extended off = apart(kernel.centre, own.centre) + place + std::abs(kernel.major - own.major) +
                             std::abs(kernel.minor - own.minor) + rounding * size;
        raise(slack.share, off / (sum_of(extended(kernel.centre)) + size));
        raise(slack.turn, quick_length(extended(kernel.axis) - own.axis) + rounding);
    }
    void compare(const DiscKernel<T>& kernel, const DiscKernel<Extended>& own, Extended place,
                 Extended rounding) const {
        const Extended off = apart(kernel.centre, own.centre) + place + std::abs(kernel.radius - own.radius) +
                             std::abs(kernel.hole - own.hole) + rounding * (kernel.radius + kernel.hole);
        const Extended whole = sum_of(extended(kernel.centre)) + kernel.radius;
        raise(slack.share, off / whole);
        raise(slack.turn, quick_length(extended(kernel.normal) - own.normal) + rounding);
    }
    /// In its own space a ball is exact.
    void compare(const SphereKernel<T>&, const SphereKernel<Extended>&, Extended, Extended) const {}
    /// Finds the size of E, of exact rows R (1 + E); columns are those of the inverse of R. Long double's own columns
    /// are off by `rounding` as a share of each, its rows by a few units of the products of three of their lengths as
    /// well.
    template <class Shape, class K>
    requires requires(const Shape& shape) { in_own_space(shape); }
    void operator()(const Shape& shape, const AffineKernel<K, T>& kernel) const {
        constexpr Extended few = 16 * ExtendedTransform::unit;
        const auto own = extended_affine(shape, to_world, {});
        const Extended off = apart(kernel.centre, own.centre) + to_world.rounding(in_own_space(shape).centre);
        raise(slack.share, off / (sum_of(extended(kernel.centre)) + sum_of(extended(kernel.box.half))));
        const std::array made{extended(kernel.row_x), extended(kernel.row_y), extended(kernel.row_z)};
        const std::array rows{own.row_x, own.row_y, own.row_z}, columns = dual_of(made);
        Extended condition = 0, narrow = std::abs(dot_product(made[0], cross_product(made[1], made[2])));
        ExtendedVector wrong[3]{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};  // rows of E
        for (int i = 0; i < 3; ++i) {
            condition += quick_length(columns[i]) * quick_length(made[i]);
            narrow *= quick_length(columns[i]);
            for (int j = 0; j < 3; ++j) wrong[j] = wrong[j] + columns[i][j] * (rows[i] - made[i]);
        }
        const Extended size = std::sqrt(dot_product(wrong[0], wrong[0]) + dot_product(wrong[1], wrong[1]) +
                                        dot_product(wrong[2], wrong[2]));
        raise(slack.turn, size + to_world.rounding() * condition + few * narrow);
        compare(kernel.shape, own.shape, 0, few);
    }
    /// Positions are those of the corners, directions the rows as shares of their lengths.
    void operator()(const Cuboid& box, const BoxKernel<T>& kernel) const {
        const BoxKernel<Extended> own = extended_kernel(box, to_world);
        const std::array rows{own.row_x, own.row_y, own.row_z};
        const std::array made{extended(kernel.row_x), extended(kernel.row_y), extended(kernel.row_z)};
        const auto edges = dual_of(rows), made_edges = dual_of(made);
        Extended condition = 0;  // the most by which rows are further off than edges
        for (int i = 0; i < 3; ++i) condition += quick_length(edges[i]) * quick_length(rows[i]);
        const Extended rounding = 2 * condition * to_world.rounding();
        const ExtendedVector centre = extended(box.corner) + extended(box.opposite);
        Extended off = apart(kernel.centre, own.centre) + to_world.rounding(box.corner) +
                       to_world.rounding(box.opposite) + ExtendedTransform::unit * to_world.length(sum_of(centre));
        for (int i = 0; i < 3; ++i) {
            off += sum_of(made_edges[i] - edges[i]) + rounding * sum_of(edges[i]);
            raise(slack.turn, quick_length(made[i] - rows[i]) / quick_length(made[i]) + rounding);
        }
        raise(slack.share, off / (sum_of(extended(kernel.centre)) + sum_of(extended(kernel.box.half))));
    }
    void operator()(const Triangle& triangle, const TriangleKernel<T>& kernel) const {
        const TriangleKernel<Extended> own = extended_kernel(triangle, to_world);
        const Extended off = std::max({apart(kernel.a, own.a) + to_world.rounding(triangle.a),
                                       apart(kernel.b, own.b) + to_world.rounding(triangle.b),
                                       apart(kernel.c, own.c) + to_world.rounding(triangle.c)});
        raise(slack.share,
              off / (sum_of(extended(kernel.a)) + sum_of(extended(kernel.b)) + sum_of(extended(kernel.c))));
    }
    /// Normals are compared as vectors of which the longest is 1.
    void operator()(const SmoothTriangle& triangle, const SmoothTriangleKernel<T>& kernel) const {
        const SmoothTriangleKernel<Extended> own = extended_kernel(triangle, to_world);
        (*this)(Triangle{triangle.a, triangle.b, triangle.c}, kernel.flat);
        Extended longest = 0;
        for (const DVec3& n : {triangle.normal_a, triangle.normal_b, triangle.normal_c})
            longest = std::max(longest, quick_length(to_world.normal(quick_unit(extended(n)))));
        const Extended rounding = 6 * to_world.rounding() * to_world.normal_size() / longest;
        const auto off = [](const Vec3<T>& a, const ExtendedVector& b) { return quick_length(extended(a) - b); };
        raise(slack.turn, rounding + std::max({off(kernel.normal_a, own.normal_a), off(kernel.normal_b, own.normal_b),
                                               off(kernel.normal_c, own.normal_c)}));
    }
    void operator()(const Mesh& mesh, const TriangleKernel<T>& kernel) const {
        (*this)(triangle_of(mesh, triangles++), kernel);
    }
    void operator()(const Mesh& mesh, const SmoothTriangleKernel<T>& kernel) const {
        (*this)(smooth_triangle_of(mesh, triangles++), kernel);
    }
    /// Skips kernels that proofs do not know.
    template <class Kind, class Kernel>
    void operator()(const Kind&, const Kernel&) const {}
};

/// Compares all shapes of a scene. A function in this namespace, because g++ warns of lambdas of other functions that
/// hold what the namespace hides.
template <class T>
void compare_all(const Scene& scene, const Placement& placement, Slack<T>& slack) {
    const auto compare_shape = [&](const Primitive& part, const WorldTransform& to_world,
                                   std::span<const Transformation> steps) {
        const ExtendedTransform own(steps, placement.origin, placement.scale);
        std::size_t triangles = 0;
        const Comparison<T> compare{own, slack, triangles};
        std::visit(
            [&](const auto& shape) {
                emit_in<T>(shape, to_world, steps, [&](const auto& kernel) { compare(shape, kernel); });
            },
            part.shape);
    };
    for (const Primitive& primitive : scene.primitives) {
        const glm::dmat4 outer = matrix(primitive.transformations);
        for_each_leaf_within(
            primitive,
            [&](const Primitive& leaf, const LeafWay& way) {
                compare_shape(leaf, {outer * way.inner, way.similarity, placement.origin, placement.scale}, way.steps);
            },
            [](Operation) {});
    }
}

}  // namespace

template <class T>
Slack<T> slack_of(const Scene& scene, const Placement& placement) {
    Slack<T> slack;
    compare_all(scene, placement, slack);
    if constexpr (std::is_same_v<T, double>)
        slack.culled = slack.share;
    else
        slack.culled = slack_of<double>(scene, placement).share;
    return slack;
}

template <class T>
void add_eye(Slack<T>& slack, const View& view, const Placement& placement) {
    constexpr Extended rounding = 32 * std::numeric_limits<Extended>::epsilon();  // of some 30 operations
    const Eye<T> eye = eye_of<T>(view, placement);
    const Eye<Extended> own = extended_eye(view, placement);
    const Extended width = view.width, height = view.height;
    slack.eye_lacks = {.position = Vec3<T>(own.position - extended(eye.position)),
                       .forward = Vec3<T>(own.forward - extended(eye.forward)),
                       .right = Vec3<T>(own.right - extended(eye.right)),
                       .down = Vec3<T>(own.down - extended(eye.down)),
                       .scale_x = static_cast<T>(2 / width - eye.scale_x),
                       .scale_y = static_cast<T>(2 / height - eye.scale_y),
                       .bias_x = static_cast<T>(1 / width - 1 - eye.bias_x),
                       .bias_y = static_cast<T>(1 / height - 1 - eye.bias_y)};
    const Extended sine = quick_length(cross_product(quick_unit(extended(view.camera.up)), own.forward));
    const bool known = in_perspective(view.camera);
    slack.eye_turn =
        known ? static_cast<T>(rounding / sine * (1 + quick_length(own.right) + quick_length(own.down))) : HUGE_VAL;
    slack.eye_away = static_cast<T>(quick_length(extended(slack.eye_lacks.position)) + rounding * sum_of(own.position));
}

namespace {

/// Returns a generous bound of the errors of a body's box, of its plane and of the test for its inside.
double margin_of(const Primitive& body, const Box& box, const DVec3& eye) {
    double margin = 1e-9 * static_cast<double>(sum_of(extended(eye)));
    for (int c = 0; c < 3; ++c)
        for (const double own : {box.low[c], box.high[c]})
            if (std::isfinite(own)) margin += 1e-9 * std::abs(own);
    const auto add = [&](const Primitive& leaf, const LeafWay& way) {
        constexpr double of_double = 4096;  // 11 bits less
        const ExtendedTransform own(way.steps, DVec3(0), 1);
        const Box inner = std::visit([](const auto& shape) { return shape.bounds(); }, leaf.shape);
        margin += own.known() ? of_double * static_cast<double>(own.rounding(inner.finite() ? inner.high : DVec3(1)))
                              : HUGE_VAL;
    };
    for_each_leaf_within(body, add, [](Operation) {});
    return margin;
}

/// Returns true if an eye is certainly outside of a body, or certainly inside a convex one: then all corners of an
/// octahedron around it are inside.
bool certain_side(const Primitive& body, const DVec3& eye) {
    const Box box = world_bounds(body);
    const double margin = margin_of(body, box, eye);
    if (const std::optional<HalfSpace> space = half_space(body)) {
        const double wrong = margin + 1e-9 * static_cast<double>(sum_of(extended(space->point)));
        return std::abs(dot_product(space->normal, eye - space->point)) > wrong;
    }
    bool outside = false, inside = true;
    for (int c = 0; c < 3; ++c) {
        outside |= eye[c] < box.low[c] - margin || eye[c] > box.high[c] + margin;
        for (const double way : {-2 * margin, 2 * margin}) {
            DVec3 beside = eye;
            beside[c] += way;
            inside &= contains(body, beside);
        }
    }
    const bool convex = std::visit([]<class Kind>(const Kind&) { return Kind::convex && Kind::closed; }, body.shape);
    return outside || (convex && inside);
}

}  // namespace

bool knows_medium(const Scene& scene, const DVec3& eye) {
    const auto shares = [](const Material& own) { return own.hollow || own.interior > 0; };
    return std::ranges::none_of(scene.materials, shares) &&
           std::ranges::all_of(scene.primitives, [&](const Primitive& body) {
               return !transparent(scene, body) || certain_side(body, eye);
           });
}

template Slack<double> slack_of(const Scene&, const Placement&);
template Slack<Extended> slack_of(const Scene&, const Placement&);
template void add_eye(Slack<double>&, const View&, const Placement&);
template void add_eye(Slack<Extended>&, const View&, const Placement&);

}  // namespace strahl
