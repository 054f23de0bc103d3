#include "trace/slack.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "num/vec_math.h"

namespace strahl {
namespace {

using Exact = long double;
using Vector = Vec3<Exact>;
constexpr Exact infinite = std::numeric_limits<Exact>::infinity();
constexpr Exact rounding = 0x1p-58L;  // of a few dozen operations in long double

Vector exact(const DVec3& v) { return {v.x, v.y, v.z}; }
Exact dot_of(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Exact length_of(const Vector& v) { return std::sqrt(dot_of(v, v)); }
Exact sum_of(const Vector& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }
Vector cross_of(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// world = columns * own + moved, each entry of a size with which it was reckoned.
struct Matrix {
    Vector columns[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, moved{0};
    Exact similarity = 1, size = 0;  // the largest number that was added on the way, beside the columns
    Vector turn(const Vector& v) const { return v.x * columns[0] + v.y * columns[1] + v.z * columns[2]; }
    Exact determinant() const { return dot_of(columns[0], cross_of(columns[1], columns[2])); }
    /// Puts a step after this.
    template <class Step>
    void then(const Step& step) {
        for (Vector& column : columns) column = step(column);
        moved = step(moved);
    }
};

struct Turn {
    int from, to;
    Exact sine, cosine;
    Vector operator()(const Vector& v) const {
        Vector turned = v;
        turned[from] = cosine * v[from] - sine * v[to];
        turned[to] = sine * v[from] + cosine * v[to];
        return turned;
    }
};
Turn turn_by(int from, int to, double degrees) {
    int quarters = 0;
    const Exact rest = std::remquo(Exact(degrees), Exact(90), &quarters) * (std::numbers::pi_v<Exact> / 180);
    const Exact s = std::sin(rest), c = std::cos(rest);
    switch (quarters & 3) {
        case 0:
            return {from, to, s, c};
        case 1:
            return {from, to, c, -s};
        case 2:
            return {from, to, -s, -c};
        default:
            return {from, to, -c, s};
    }
}

void add(Matrix& matrix, const Rotate& rotate) {
    matrix.then(turn_by(1, 2, rotate.degrees.x));
    matrix.then(turn_by(2, 0, rotate.degrees.y));
    matrix.then(turn_by(0, 1, rotate.degrees.z));
}
void add(Matrix& matrix, const Translate& translate) {
    matrix.moved = matrix.moved + exact(translate.by);
    matrix.size = std::max({matrix.size, sum_of(exact(translate.by)), sum_of(matrix.moved)});
}
void add(Matrix& matrix, const Scale& scale) {
    matrix.then([&](const Vector& v) { return v * exact(scale.by); });
    matrix.similarity *= std::abs(Exact(scale.by.x));
    matrix.size = std::max(matrix.size, matrix.size * std::abs(Exact(scale.by.x)));
}
void add(Matrix& matrix, const Motion&) { matrix.size = infinite; }

Matrix exact_matrix(std::span<const Transformation> steps) {
    Matrix matrix;
    for (const Transformation& step : steps) std::visit([&](const auto& own) { add(matrix, own); }, step);
    return matrix;
}

/// Compares what a shape emits with what it should.
struct Comparison {
    const Placement& placement;
    const Matrix& matrix;
    Slack<double>& slack;

    Vector place(const DVec3& p) const {
        return Exact(placement.scale) * (matrix.turn(exact(p)) + matrix.moved - exact(placement.origin));
    }
    Exact length(Exact own) const { return own * matrix.similarity * Exact(placement.scale); }
    /// Of a place, in the world.
    Exact noise(const DVec3& p) const {
        const Exact size =
            length(sum_of(exact(p))) + Exact(placement.scale) * (matrix.size + sum_of(exact(placement.origin)));
        return rounding * size;
    }
    static void raise(double& most, Exact value) {
        most = std::max(most, value < 1e300L ? static_cast<double>(value) * (1 + 1e-15) : HUGE_VAL);
    }

    void operator()(const Sphere& sphere, const SphereKernel<double>& kernel) const {
        const Exact off = sum_of(exact(kernel.centre) - place(sphere.centre)) + noise(sphere.centre) +
                          std::abs(kernel.radius - length(sphere.radius)) + rounding * kernel.radius;
        raise(slack.share, off / (sum_of(exact(kernel.centre)) + kernel.radius));
    }
    void operator()(const Plane& plane, const PlaneKernel<double>& kernel) const {
        const Vector u = matrix.turn(exact(plane.b) - exact(plane.a)), v = matrix.turn(exact(plane.c) - exact(plane.a));
        const Vector across = cross_of(u, v), p = place(plane.a);
        const Exact size = length_of(across), condition = length_of(u) * length_of(v) / size;
        const Vector n = (matrix.determinant() < 0 ? -1 : 1) / size * across;
        raise(slack.turn, length_of(exact(kernel.normal) - n) + rounding * condition);
        raise(slack.plane, std::abs(kernel.distance - dot_of(n, p)) + noise(plane.a) +
                               rounding * condition * (sum_of(p) + std::abs(Exact(kernel.distance))));
    }
    void operator()(const Cylinder& cylinder, const CylinderKernel<double>& kernel) const {
        const Vector rise = exact(cylinder.cap) - exact(cylinder.base), turned = matrix.turn(rise);
        const Exact off = sum_of(exact(kernel.base) - place(cylinder.base)) + noise(cylinder.base) +
                          std::abs(kernel.radius - length(cylinder.radius)) +
                          std::abs(kernel.height - length(length_of(rise))) +
                          rounding * (kernel.radius + kernel.height);
        raise(slack.share, off / (sum_of(exact(kernel.base)) + kernel.radius + kernel.height));
        const Exact apart = sum_of(exact(cylinder.cap)) + sum_of(exact(cylinder.base));
        raise(slack.turn, length_of(exact(kernel.axis) - Exact(1) / length_of(turned) * turned) +
                              rounding * (1 + apart / length_of(rise)));
    }
    /// Kernels that proofs do not know.
    template <class Kind, class Kernel>
    void operator()(const Kind&, const Kernel&) const {}
};

}  // namespace

Slack<double> slack_of(const Scene& scene, const Placement& placement) {
    Slack<double> slack;
    for (const Primitive& primitive : scene.primitives) {
        const Matrix own = exact_matrix(primitive.transformations);
        const WorldTransform to_world{matrix(primitive.transformations), similarity(primitive.transformations),
                                      placement.origin, placement.scale};
        const Comparison compare{placement, own, slack};
        std::visit(
            [&](const auto& shape) {
                shape.template emit<double>(to_world, [&](const auto& kernel) { compare(shape, kernel); });
            },
            primitive.shape);
    }
    return slack;
}

void add_eye(Slack<double>& slack, const View& view, const Placement& placement) {
    const Camera& camera = view.camera;
    const auto unit = [](const Vector& v) { return Exact(1) / length_of(v) * v; };
    const Vector forward = unit(exact(camera.look_at) - exact(camera.position)), up = unit(exact(camera.up));
    const Vector wide = cross_of(up, forward);
    const Exact sine = length_of(wide);
    const Vector right = unit(wide), down = cross_of(forward, right);
    const Exact aspect = camera.aspectratio ? Exact(*camera.aspectratio) : Exact(view.width) / view.height;
    const Exact tan_x = std::tan(Exact(camera.fov) * (std::numbers::pi_v<Exact> / 180)), tan_y = tan_x / aspect;
    const CameraFrame frame = frame_of(camera, static_cast<double>(view.width) / view.height);
    const auto off = [](const DVec3& computed, const Vector& own) { return length_of(exact(computed) - own); };
    const Exact apart = sum_of(exact(camera.look_at)) + sum_of(exact(camera.position));
    const Exact condition = (1 + apart / length_of(exact(camera.look_at) - exact(camera.position))) / sine;
    const Exact wrong = off(frame.forward, forward) + off(frame.right * frame.tan_x, tan_x * right) +
                        off(frame.down * frame.tan_y, tan_y * down) + rounding * condition * (1 + tan_x + tan_y);
    // Roundings in units of 2 each: where a pixel is has 7 at most, as a share of a tangent, and counts no more than
    // that against the direction, whose length is at least the forward axis's; 2 sums, 2 products of a tangent, the
    // division.
    constexpr double u = std::numeric_limits<double>::epsilon();
    const DVec3 eye = (camera.position - placement.origin) * placement.scale;
    const Vector place = Exact(placement.scale) * (exact(camera.position) - exact(placement.origin));
    slack.eye_away =
        static_cast<double>(off(eye, place) + rounding * Exact(placement.scale) *
                                                  (sum_of(exact(camera.position)) + sum_of(exact(placement.origin))));
    const Exact shifted =
        2 * (std::abs(Exact(view.shift_x)) * tan_x / view.width + std::abs(Exact(view.shift_y)) * tan_y / view.height);
    slack.eye_turn =
        static_cast<double>(wrong + shifted) * (1 + 1e-9) + u * (1.6 + 4 * static_cast<double>(tan_x + tan_y));
}

}  // namespace strahl
