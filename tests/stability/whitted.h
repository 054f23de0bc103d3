// Whitted's ray tracer as a first attempt: textbook formulas, an epsilon, untransformed coordinates.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "scene/scene.h"
#include "tests/stability/naive.h"
#include "trace/tracer.h"

namespace strahl::naive {

/// Single improvements of this ray tracer.
struct Habits {
    double epsilon = 1e-4;  // nearer hits do not count
    int depth = 6;
    bool asks_for_total_reflection = true;  // before the root is taken
};

template <class T>
class Whitted {
  public:
    Whitted(const Scene& scene, const Habits& habits) : scene(scene), habits(habits) {}

    Frame picture(int width, int height) const {
        Frame frame{width, height, {}};
        const CameraFrame axes = frame_of(scene.camera, double(width) / height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const DVec3 d = axes.forward + axes.right * (axes.tan_x * ((2 * x + 1.) / width - 1)) +
                                axes.down * (axes.tan_y * ((2 * y + 1.) / height - 1));
                const Vec3<T> color = trace(to<T>(scene.camera.position), to<T>(d / length(d)), habits.depth);
                for (int c = 0; c < 3; ++c) frame.rgb.push_back(static_cast<double>(color[c]));
            }
        return frame;
    }

  private:
    struct Hit {
        T t;
        Vec3<T> normal;
        const Material* material;
    };
    const Scene& scene;
    Habits habits;

    T first(T near, T far) const {
        const T epsilon = static_cast<T>(habits.epsilon);
        return near > epsilon ? near : far > epsilon ? far : std::numeric_limits<T>::infinity();
    }
    Hit meet(const Sphere& ball, Vec3<T> o, const Vec3<T>& d) const {
        const auto [near, far, hit] = sphere(o, d, to<T>(ball.centre), static_cast<T>(ball.radius));
        const T t = hit ? first(near, far) : std::numeric_limits<T>::infinity();
        const Vec3<T> n = o + d * t - to<T>(ball.centre);
        return {t, n / length(n), nullptr};
    }
    Hit meet(const Plane& plane, const Vec3<T>& o, const Vec3<T>& d) const {
        const Vec3<T> n = to<T>(plane.normal());
        const T t = times(to<T>(plane.a) - o, n) / times(d, n);
        return {first(t, t), n, nullptr};
    }
    template <class Other>
    Hit meet(const Other&, const Vec3<T>&, const Vec3<T>&) const {
        throw std::invalid_argument("the naive method knows spheres, planes and cylinders only");
    }
    Hit meet(const Cylinder& can, const Vec3<T>& o, const Vec3<T>& d) const {
        const Vec3<T> axis = to<T>(can.axis()), f = o - to<T>(can.base);
        const T height = static_cast<T>(length(can.cap - can.base)), r = static_cast<T>(can.radius);
        const T fa = times(f, axis), da = times(d, axis);
        const Vec3<T> g = f - axis * fa, e = d - axis * da;
        const T a = times(e, e), b = times(g, e), c = times(g, g) - r * r, root_of = std::sqrt(b * b - a * c);
        const T low = std::min(-fa / da, (height - fa) / da), high = std::max(-fa / da, (height - fa) / da);
        const T near = std::max((-b - root_of) / a, low), far = std::min((-b + root_of) / a, high);
        const T t = near < far ? first(near, far) : std::numeric_limits<T>::infinity();
        const Vec3<T> p = f + d * t;
        const T along = times(p, axis);
        const bool end = t == low || t == high;
        return {t, end ? axis * (along > height / 2 ? T(1) : T(-1)) : (p - axis * along) / r, nullptr};
    }
    std::optional<Hit> nearest(const Vec3<T>& o, const Vec3<T>& d) const {
        Hit best{std::numeric_limits<T>::infinity(), {}, nullptr};
        for (const Primitive& primitive : scene.primitives) {
            T k = 1;  // the only transformation supported
            for (const Transformation& step : primitive.transformations)
                if (const auto* by = std::get_if<Scale>(&step)) k *= static_cast<T>(by->by.x);
            Hit hit = std::visit([&](const auto& shape) { return meet(shape, Vec3<T>(o / k), d); }, primitive.shape);
            hit.t *= k, hit.material = &scene.materials[primitive.material];
            if (hit.t < best.t) best = hit;
        }
        if (!best.material) return {};
        return best;
    }
    Vec3<T> trace(const Vec3<T>& o, const Vec3<T>& d, int depth) const {
        if (depth == 0) return Vec3<T>(T(0));
        const auto hit = nearest(o, d);
        if (!hit) return to<T>(scene.background.color);
        const Material& m = *hit->material;
        const Vec3<T> p = o + d * hit->t;
        const bool outside = times(d, hit->normal) < 0;
        const Vec3<T> n = outside ? hit->normal : -hit->normal, mirror = mirrored(d, n);
        Vec3<T> sum = to<T>(m.rgb.color * m.ambient);
        for (const Light& light : scene.lights) {
            Vec3<T> l = to<T>(light.position) - p;
            const T distance = length(l);
            l = l / distance;
            const T cosine = times(n, l);
            if (!(cosine > 0)) continue;
            const auto shade = nearest(p, l);
            T share = 1;
            if (shade && shade->t < distance) share = static_cast<T>(shade->material->refraction);
            const T shine = std::pow(std::max(times(mirror, l), T(0)), static_cast<T>(m.pow));
            for (int c = 0; c < 3; ++c)
                sum[c] += share * static_cast<T>(light.color[c]) *
                          static_cast<T>(m.rgb.color[c] * m.diffuse * cosine + m.specular * shine);
        }
        T reflection = static_cast<T>(m.reflection);
        if (m.refraction > 0) {
            const T ratio = static_cast<T>(outside ? 1 / m.ior : m.ior), s = -times(d, n);
            const T k = 1 - ratio * ratio * (1 - s * s);
            if (k < 0 && habits.asks_for_total_reflection)
                reflection += static_cast<T>(m.refraction);
            else
                sum = sum +
                      trace(p, d * ratio + n * (ratio * s - std::sqrt(k)), depth - 1) * static_cast<T>(m.refraction);
        }
        if (reflection > 0) sum = sum + trace(p, mirror, depth - 1) * reflection;
        return sum;
    }
};

}  // namespace strahl::naive
