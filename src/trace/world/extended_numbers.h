// Computes the numbers of bodies and of a camera in long double, for the kinds that proofs know. Extended precision
// traces them, and slack.cpp takes them for exact.
#pragma once
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "num/vec_math.h"
#include "scene/kinds/kinds.h"
#include "trace/world/build_world.h"
#include "trace/world/eye.h"
#include "trace/world/view.h"

namespace strahl {

using Extended = long double;
using ExtendedVector = Vec3<Extended>;

template <class T>
ExtendedVector extended(const Vec3<T>& v) {
    return {v.x, v.y, v.z};
}
inline Extended sum_of(const ExtendedVector& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// The way from a primitive's own space into the world's, as WorldTransform has it in double.
class ExtendedTransform {
  public:
    ExtendedTransform(std::span<const Transformation> steps, const DVec3& origin, double scale);

    ExtendedVector turn(const ExtendedVector& v) const {
        return v.x * columns[0] + v.y * columns[1] + v.z * columns[2];
    }
    ExtendedVector way(const ExtendedVector& v) const { return scale * turn(v); }
    ExtendedVector point(const ExtendedVector& p) const { return scale * (turn(p) + moved - origin); }
    ExtendedVector point(const DVec3& p) const { return point(extended(p)); }
    /// Returns the most that a length can become under transformations that do not keep angles.
    Extended length(Extended own) const { return own * stretch * scale; }
    /// Transforms a normal, but for length and sign, by the transpose of the inverse.
    ExtendedVector normal(const ExtendedVector& n) const {
        const auto& [x, y, z] = columns;
        return n.x * cross_product(y, z) + n.y * cross_product(z, x) + n.z * cross_product(x, y);
    }
    /// Returns by how many times the rounding of a normal of length 1 is more than that of a direction.
    Extended normal_size() const {
        const Extended x = quick_length(columns[0]), y = quick_length(columns[1]), z = quick_length(columns[2]);
        return x * y + y * z + z * x;
    }
    bool mirrors() const { return dot_product(columns[0], cross_product(columns[1], columns[2])) < 0; }

    /// Returns whether all steps are known. Motions are not.
    bool known() const { return size < std::numeric_limits<Extended>::infinity(); }
    /// Returns the rounding error of lengths and directions, as a share.
    Extended rounding() const { return roundings * unit * unevenness; }
    /// Returns the rounding error of a point, as a distance in the world. The numbers of the scene are exact, so that
    /// moving by them only costs digits of the result.
    Extended rounding(const DVec3& p) const {
        const Extended steps = roundings == few ? 0 : roundings * unit * (length(sum_of(extended(p))) + scale * size);
        return steps + 4 * unit * sum_of(point(p));
    }
    static constexpr Extended unit = std::numeric_limits<Extended>::epsilon() / 2;

  private:
    template <class Step>
    void then(const Step& step) {
        for (ExtendedVector& column : columns) column = step(column);
        moved = step(moved);
    }
    void turn_by(int from, int to, double degrees);
    void add(const Rotate& rotate);
    void add(const Translate& translate);
    void add(const Scale& factor);
    void add(const Motion& motion);

    ExtendedVector columns[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, moved{0}, origin;
    Extended scale, size = 0;              // the largest number that was added on the way, beside the columns
    Extended stretch = 1, unevenness = 1;  // products of the largest factors, and of their ratios to the least
    static constexpr int few = 8;
    int roundings = few;
};

SphereKernel<Extended> extended_kernel(const Sphere& sphere, const ExtendedTransform& to_world);
PlaneKernel<Extended> extended_kernel(const Plane& plane, const ExtendedTransform& to_world);
CylinderKernel<Extended> extended_kernel(const Cylinder& cylinder, const ExtendedTransform& to_world);
ConeKernel<Extended> extended_kernel(const Cone& cone, const ExtendedTransform& to_world);
TorusKernel<Extended> extended_kernel(const Torus& torus, const ExtendedTransform& to_world);
DiscKernel<Extended> extended_kernel(const Disc& disc, const ExtendedTransform& to_world);
BoxKernel<Extended> extended_kernel(const Cuboid& box, const ExtendedTransform& to_world);
TriangleKernel<Extended> extended_kernel(const Triangle& triangle, const ExtendedTransform& to_world);
SmoothTriangleKernel<Extended> extended_kernel(const SmoothTriangle& triangle, const ExtendedTransform& to_world);
/// Return triangle i of a mesh.
Triangle triangle_of(const Mesh& mesh, std::size_t i);
SmoothTriangle smooth_triangle_of(const Mesh& mesh, std::size_t i);
/// A shape in the space of its own that affine() gives it, whose unit and centre are these in the primitive's space.
template <class K>
struct InOwnSpace {
    DVec3 centre;
    double unit;
    K kernel;
};
InOwnSpace<SphereKernel<Extended>> in_own_space(const Sphere& sphere);
InOwnSpace<CylinderKernel<Extended>> in_own_space(const Cylinder& cylinder);
InOwnSpace<ConeKernel<Extended>> in_own_space(const Cone& cone);
InOwnSpace<DiscKernel<Extended>> in_own_space(const Disc& disc);
InOwnSpace<TorusKernel<Extended>> in_own_space(const Torus& torus);
/// Returns for vectors u, v, w those whose product with each is 1 and with the two others 0.
std::array<ExtendedVector, 3> dual_of(const std::array<ExtendedVector, 3>& vectors);
/// Makes the kernel of a shape under any transformation; the box is the one that double has.
template <class Shape>
auto extended_affine(const Shape& shape, const ExtendedTransform& to_world, const HitBox<Extended>& box) {
    const auto [centre, unit, kernel] = in_own_space(shape);
    const Extended u = unit;
    const auto [x, y, z] = dual_of({to_world.way({u, 0, 0}), to_world.way({0, u, 0}), to_world.way({0, 0, u})});
    return AffineKernel<std::remove_const_t<decltype(kernel)>, Extended>{to_world.point(centre), x, y, z, box, kernel};
}

/// Emits kernels in long double, if there are any for this shape under these transformations. Returns whether it did.
template <class Shape, class Emit>
bool emit_extended(const Shape& shape, const WorldTransform& to_world, std::span<const Transformation> steps,
                   const Emit& emit) {
    constexpr bool is_mesh = std::is_same_v<Shape, Mesh>;
    constexpr bool takes_any = is_mesh || std::tuple_size_v<typename Shape::template Kernels<Extended>> == 1;
    const ExtendedTransform own(steps, to_world.origin, to_world.scale);
    if (!own.known()) return false;
    if constexpr (requires { in_own_space(shape); })
        if (!to_world.similar()) {
            shape.template emit<Extended>(to_world, [&](const auto& kernel) {
                if constexpr (requires { kernel.shape; }) emit(extended_affine(shape, own, kernel.box));
            });
            return true;
        }
    if (!to_world.similar() && !takes_any) return false;
    if constexpr (is_mesh) {
        const bool smooth = !shape.data->corner_normals.empty();
        for (std::size_t i = 0; i < shape.data->triangles.size(); ++i)
            smooth ? emit(extended_kernel(smooth_triangle_of(shape, i), own))
                   : emit(extended_kernel(triangle_of(shape, i), own));
        return true;
    } else if constexpr (requires { extended_kernel(shape, own); }) {
        emit(extended_kernel(shape, own));
        return true;
    }
    return false;
}
/// Emits the kernels of a shape. For proofs those in long double are computed in it where possible, instead of rounded
/// from double. Without proofs they are not, because they would not fit patterns, which are computed in double.
template <class T, class Shape, class Emit>
void emit_in(const Shape& shape, const WorldTransform& to_world, std::span<const Transformation> steps,
             const Emit& emit, bool proves = true) {
    if constexpr (std::is_same_v<T, Extended>)
        if (proves && emit_extended(shape, to_world, steps, emit)) return;
    shape.template emit<T>(to_world, emit);
}

Eye<Extended> extended_eye(const View& view, const Placement& placement);
/// The eye of a view in the world of a placement; for proofs one in long double is made in long double.
template <class T>
Eye<T> eye_of(const View& view, const Placement& placement) {
    if constexpr (std::is_same_v<T, Extended>)
        if (view.prove) return extended_eye(view, placement);
    const CameraFrame frame = frame_of(view.camera, static_cast<double>(view.width) / view.height);
    return {.position = cast<T>((view.camera.position - placement.origin) * placement.scale),
            .forward = cast<T>(frame.forward),
            .right = cast<T>(frame.right * frame.tan_x),
            .down = cast<T>(frame.down * frame.tan_y),
            .scale_x = static_cast<T>(2. / view.width),
            .scale_y = static_cast<T>(2. / view.height),
            .bias_x = static_cast<T>((1 + 2 * view.shift_x) / view.width - 1),
            .bias_y = static_cast<T>((1 + 2 * view.shift_y) / view.height - 1)};
}

}  // namespace strahl
