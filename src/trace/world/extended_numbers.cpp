#include "trace/world/extended_numbers.h"

#include <algorithm>
#include <numbers>
#include <utility>
#include <variant>

namespace strahl {
namespace {

constexpr Extended degree = std::numbers::pi_v<Extended> / 180;

}  // namespace

ExtendedTransform::ExtendedTransform(std::span<const Transformation> steps, const DVec3& own_origin, double own_scale)
    : origin(extended(own_origin)), scale(own_scale) {
    for (const Transformation& step : steps) std::visit([&](const auto& own) { add(own); }, step);
}

/// Turns by quarters, which are exact, and by what is left, less than an eighth of a turn. That counts as 16 roundings:
/// two each of the angle, its sine and its cosine, for each of two components, and three of their sum; and once more
/// where a point goes through the matrix.
void ExtendedTransform::turn_by(int from, int to, double degrees) {
    int quarters = 0;
    const Extended rest = std::remquo(Extended(degrees), Extended(90), &quarters) * degree;
    if (rest != 0) roundings += 16;
    Extended sine = std::sin(rest), cosine = std::cos(rest);
    if (quarters & 1) std::swap(sine, cosine), cosine = -cosine;
    if (quarters & 2) sine = -sine, cosine = -cosine;
    then([&](const ExtendedVector& v) {
        ExtendedVector turned = v;
        turned[from] = cosine * v[from] - sine * v[to];
        turned[to] = sine * v[from] + cosine * v[to];
        return turned;
    });
}

void ExtendedTransform::add(const Rotate& rotate) {
    turn_by(1, 2, rotate.degrees.x);
    turn_by(2, 0, rotate.degrees.y);
    turn_by(0, 1, rotate.degrees.z);
}
void ExtendedTransform::add(const Translate& translate) {
    moved = moved + extended(translate.by);
    size = std::max({size, sum_of(extended(translate.by)), sum_of(moved)});
    roundings += 2;
}
void ExtendedTransform::add(const Scale& factor) {
    then([&](const ExtendedVector& v) { return v * extended(factor.by); });
    const auto [least, most] = std::minmax({std::abs(factor.by.x), std::abs(factor.by.y), std::abs(factor.by.z)});
    stretch *= most, unevenness *= Extended(most) / least;
    size = std::max(size, size * most);
    roundings += 4;
}
void ExtendedTransform::add(const Motion&) { size = std::numeric_limits<Extended>::infinity(); }

SphereKernel<Extended> extended_kernel(const Sphere& sphere, const ExtendedTransform& to_world) {
    return {to_world.point(sphere.centre), to_world.length(sphere.radius)};
}
PlaneKernel<Extended> extended_kernel(const Plane& plane, const ExtendedTransform& to_world) {
    const ExtendedVector a = extended(plane.a), u = to_world.turn(extended(plane.b) - a),
                         v = to_world.turn(extended(plane.c) - a);
    const ExtendedVector normal = Extended(to_world.mirrors() ? -1 : 1) * quick_unit(cross_product(u, v));
    return {normal, dot_product(normal, to_world.point(plane.a))};
}
CylinderKernel<Extended> extended_kernel(const Cylinder& cylinder, const ExtendedTransform& to_world) {
    const ExtendedVector rise = extended(cylinder.cap) - extended(cylinder.base);
    return {to_world.point(cylinder.base), quick_unit(to_world.turn(rise)), to_world.length(cylinder.radius),
            to_world.length(quick_length(rise))};
}
ConeKernel<Extended> extended_kernel(const Cone& cone, const ExtendedTransform& to_world) {
    const ExtendedVector rise = extended(cone.cap) - extended(cone.base);
    const Extended height = quick_length(rise), widening = Extended(cone.cap_radius) - cone.base_radius;
    const Extended slant = std::sqrt(height * height + widening * widening);
    return {to_world.point(cone.base),
            quick_unit(to_world.turn(rise)),
            to_world.length(cone.base_radius),
            to_world.length(height),
            height / slant,
            widening / slant,
            to_world.length(std::max(cone.base_radius, cone.cap_radius))};
}
TorusKernel<Extended> extended_kernel(const Torus& torus, const ExtendedTransform& to_world) {
    return {to_world.point(torus.centre), quick_unit(to_world.turn(extended(torus.axis))), to_world.length(torus.major),
            to_world.length(torus.minor)};
}
DiscKernel<Extended> extended_kernel(const Disc& disc, const ExtendedTransform& to_world) {
    return {to_world.point(disc.centre), quick_unit(to_world.turn(extended(disc.normal))), to_world.length(disc.radius),
            to_world.length(disc.hole)};
}

InOwnSpace<SphereKernel<Extended>> in_own_space(const Sphere& sphere) {
    return {sphere.centre, sphere.radius, {ExtendedVector(0), 1}};
}
InOwnSpace<CylinderKernel<Extended>> in_own_space(const Cylinder& cylinder) {
    const ExtendedVector rise = extended(cylinder.cap) - extended(cylinder.base);
    return {
        cylinder.base, cylinder.radius, {ExtendedVector(0), quick_unit(rise), 1, quick_length(rise) / cylinder.radius}};
}
InOwnSpace<ConeKernel<Extended>> in_own_space(const Cone& cone) {
    const double unit = std::max(cone.base_radius, cone.cap_radius);
    ConeKernel<Extended> kernel = extended_kernel(cone, ExtendedTransform({}, cone.base, 1));
    kernel.radius /= unit, kernel.height /= unit, kernel.widest = 1;
    return {cone.base, unit, kernel};
}
InOwnSpace<DiscKernel<Extended>> in_own_space(const Disc& disc) {
    return {disc.centre,
            disc.radius,
            {ExtendedVector(0), quick_unit(extended(disc.normal)), 1, Extended(disc.hole) / disc.radius}};
}
InOwnSpace<TorusKernel<Extended>> in_own_space(const Torus& torus) {
    const double unit = torus.major + torus.minor;
    return {torus.centre,
            unit,
            {ExtendedVector(0), quick_unit(extended(torus.axis)), Extended(torus.major) / unit,
             Extended(torus.minor) / unit}};
}

std::array<ExtendedVector, 3> dual_of(const std::array<ExtendedVector, 3>& vectors) {
    const auto& [u, v, w] = vectors;
    const Extended scale = 1 / dot_product(u, cross_product(v, w));
    return {scale * cross_product(v, w), scale * cross_product(w, u), scale * cross_product(u, v)};
}
BoxKernel<Extended> extended_kernel(const Cuboid& box, const ExtendedTransform& to_world) {
    const ExtendedVector corner = extended(box.corner), opposite = extended(box.opposite), ways = opposite - corner;
    const auto half_edge = [&](int i) {
        ExtendedVector own{0};
        own[i] = std::abs(ways[i]) / 2;
        return to_world.way(own);
    };
    const std::array edges{half_edge(0), half_edge(1), half_edge(2)};
    const auto [x, y, z] = dual_of(edges);
    BoxKernel<Extended> kernel{to_world.point(Extended(.5) * (corner + opposite)), x, y, z, {}};
    kernel.box.middle = kernel.centre;
    for (int c = 0; c < 3; ++c) {
        const Extended half = std::abs(edges[0][c]) + std::abs(edges[1][c]) + std::abs(edges[2][c]);
        kernel.box.half[c] = half + 16 * ExtendedTransform::unit * (std::abs(kernel.centre[c]) + half);
    }
    return kernel;
}

TriangleKernel<Extended> extended_kernel(const Triangle& triangle, const ExtendedTransform& to_world) {
    return {to_world.point(triangle.a), to_world.point(triangle.b), to_world.point(triangle.c)};
}
SmoothTriangleKernel<Extended> extended_kernel(const SmoothTriangle& triangle, const ExtendedTransform& to_world) {
    std::array normals{extended(triangle.normal_a), extended(triangle.normal_b), extended(triangle.normal_c)};
    Extended longest = 0;
    for (ExtendedVector& n : normals) n = to_world.normal(quick_unit(n)), longest = std::max(longest, quick_length(n));
    for (ExtendedVector& n : normals) n = 1 / longest * n;
    return {extended_kernel(Triangle{triangle.a, triangle.b, triangle.c}, to_world), normals[0], normals[1],
            normals[2]};
}
Triangle triangle_of(const Mesh& mesh, std::size_t i) {
    const auto [a, b, c] = mesh.data->triangles[i];
    const auto& points = mesh.data->points;
    return {points[a], points[b], points[c]};
}
SmoothTriangle smooth_triangle_of(const Mesh& mesh, std::size_t i) {
    const auto [a, b, c] = triangle_of(mesh, i);
    const auto [k, l, m] = mesh.data->corner_normals[i];
    const auto& normals = mesh.data->normals;
    return {a, b, c, normals[k], normals[l], normals[m]};
}

Eye<Extended> extended_eye(const View& view, const Placement& placement) {
    const Camera& camera = view.camera;
    const ExtendedVector position = extended(camera.position);
    const ExtendedVector forward = quick_unit(extended(camera.look_at) - position);
    const ExtendedVector right = quick_unit(cross_product(quick_unit(extended(camera.up)), forward));
    const Extended aspect = camera.aspectratio ? Extended(*camera.aspectratio) : Extended(view.width) / view.height;
    const Extended tangent = std::tan(Extended(camera.fov) * degree);
    return {.position = Extended(placement.scale) * (position - extended(placement.origin)),
            .forward = forward,
            .right = tangent * right,
            .down = tangent / aspect * cross_product(forward, right),
            .scale_x = Extended(2) / view.width,
            .scale_y = Extended(2) / view.height,
            .bias_x = (1 + 2 * Extended(view.shift_x)) / view.width - 1,
            .bias_y = (1 + 2 * Extended(view.shift_y)) / view.height - 1};
}

}  // namespace strahl
