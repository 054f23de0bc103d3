// Exact arithmetic, as nearly as numbers of 113 bits have it: a recursive tracer that takes the doubles of a Scene and
// rounds nothing to double, the camera's axes and all matrices included. Bodies are the referee's. The same in long
// double, 100 times as fast, sees nearly all of what need not be judged by more.
#pragma once
#include <vector>

#include "tests/proof/exact_bodies.h"
#include "trace/tracer.h"
#include "trace/world/split_unions.h"

namespace strahl::exact {

/// Looks through the middles of pixels.
template <class R = Quadruple>
struct Eye {
    using Vector = referee::Vector<R>;
    Vector position, forward, right, down;
    int width, height;

    explicit Eye(const View& view) : position(view.camera.position), width(view.width), height(view.height) {
        forward = unit(Vector(view.camera.look_at) - position);
        right = unit(cross(Vector(view.camera.up), forward));
        down = cross(forward, right);
        const R angle = radians<R>(view.camera.fov), tangent = sine_of(angle) / cosine_of(angle);
        const R aspect = view.camera.aspectratio ? R(*view.camera.aspectratio) : R(width) / R(height);
        right = tangent * right, down = tangent / aspect * down;
    }
    Line<R> ray(int x, int y) const {
        const R u = (2 * R(x) + 1) / width - 1, v = (2 * R(y) + 1) / height - 1;
        return {position, unit(forward + u * right + v * down)};
    }
};

template <class R = Quadruple>
class Tracer {
    using Vector = referee::Vector<R>;

  public:
    Tracer(const Scene& own, const View& own_view)
        : scene(with_split_unions(own)), view(own_view), eye(view), sky(own.background, {}) {
        for (const Primitive& primitive : scene.primitives) bodies.emplace_back(scene, primitive);
    }
    Vector at(int x, int y) const {
        std::vector<int> inside;
        for (int i = 0; i < std::ssize(bodies); ++i)
            if (bodies[i].medium->refraction > 0 && bodies[i].surrounds(eye.position)) inside.push_back(i);
        return see(eye.ray(x, y), 1, inside);
    }

    /// Returns the share of its light that a spot sends along -l.
    static R share_of_spot(const Light& light, const Vector& l) {
        if (!light.spot) return 1;
        const auto less_cosine = [](double degrees) {
            const R sine = sine_of(radians<R>(degrees) / 2);
            return 2 * sine * sine;
        };
        const Vector off = l + unit(Vector(light.spot->look_at) - Vector(light.position));
        const R from_axis = dot(off, off) / 2, radius = less_cosine(light.spot->radius);
        const R falloff = less_cosine(light.spot->falloff);
        if (!(from_axis < falloff) || !(from_axis < 1)) return 0;
        const R part = from_axis > radius ? (falloff - from_axis) / (falloff - radius) : R(1);
        const R share = part * part * (3 - 2 * part);
        return light.spot->tightness == 0 ? share : share * power(1 - from_axis, R(light.spot->tightness));
    }

  private:
    Vector see(const Line<R>& line, int generation, const std::vector<int>& inside) const {
        int body = -1;
        Crossing<R> hit{};
        for (int i = 0; i < std::ssize(bodies); ++i)
            for (const auto& crossing : bodies[i].meet(line, i))
                if (crossing.t > 0 && (body < 0 || crossing.t < hit.t)) body = i, hit = crossing;
        const bool foggy = scene.fog && inside.empty();
        if (body < 0) return foggy ? Vector(scene.fog->color) : sky.at(line.direction);
        const Vector sum = light_of(line, hit, body, generation, inside);
        if (!foggy) return sum;
        const R left = exponential(-hit.t / R(scene.fog->distance));
        return left * sum + (1 - left) * Vector(scene.fog->color);
    }

    Vector light_of(const Line<R>& line, const Crossing<R>& hit, int body, int generation,
                    const std::vector<int>& inside) const {
        const Material& material = bodies[body].material_of(hit.face);
        const Vector e = line.direction, p = line.origin + hit.t * e,
                     color = bodies[body].leaf_of(hit.face).color_at(p, hit.face);
        Vector n = unit(hit.normal);
        if (dot(e, n) > 0) n = R(-1) * n;
        const Vector flat = n;
        n = bodies[body].leaf_of(hit.face).bent(p, hit.face, flat);
        const Vector mirrored = e - 2 * dot(e, n) * n;
        Vector sum = R(material.ambient) * color * Vector(scene.settings.ambient_light);
        for (const Light& light : scene.lights) sum = sum + from(light, p, flat, n, mirrored, color, body, hit.face);
        if (generation >= view.depth) return sum;
        R share = material.reflection;
        if (material.refraction > 0) {
            auto [ratio, after] = pass(body, inside);
            const Vector before = dot(e, n) > 0 ? R(-1) * n : n;  // on the ray's side
            const R s = -dot(e, before), k = 1 - ratio * ratio * (1 - s * s);
            if (k < 0)
                share += R(material.refraction);
            else
                sum = sum + R(material.refraction) *
                                see({p, unit(ratio * e + (ratio * s - root(k)) * before), body, hit.face},
                                    generation + 1, after);
        }
        Vector away = mirrored;
        if (dot(away, flat) < 0) {
            if (dot(away, n) < 0) away = e;
            away = away - 2 * dot(away, flat) * flat;
        }
        if (share > 0) sum = sum + share * see({p, away, body, hit.face}, generation + 1, inside);
        return sum;
    }

    Vector from(const Light& light, const Vector& p, const Vector& flat, const Vector& n, const Vector& mirrored,
                const Vector& color, int body, int face) const {
        const Vector way = light.direction ? R(-1) * Vector(*light.direction) : Vector(light.position) - p,
                     l = unit(way);
        const R facing = dot(n, l), glance = dot(mirrored, l);
        if (!(facing > 0) || !(dot(flat, l) > 0)) return {};
        const Material& material = bodies[body].material_of(face);
        const R highlight = glance > 0 ? R(material.specular) * power(glance, R(material.pow)) : R(0);
        Vector share = light.color * (R(material.diffuse) * facing * color + Vector{highlight, highlight, highlight});
        share = share_of_spot(light, l) * share;
        const R distance = root(dot(way, way));
        for (int i = 0; i < std::ssize(bodies); ++i)
            for (const auto& crossing : bodies[i].meet({p, l, body, face}, i)) {
                if (!(crossing.t > 0 && (light.direction || crossing.t < distance))) continue;
                const Material& other = bodies[i].material_of(crossing.face);
                if (!(other.refraction > 0)) return {};
                share = R(other.refraction) * share *
                        bodies[i].leaf_of(crossing.face).color_at(p + crossing.t * l, crossing.face);
            }
        return share;
    }

    /// The ratio of indices at a surface of `body`, and the medium stack behind it, by POV-Ray's rule.
    std::pair<R, std::vector<int>> pass(int body, std::vector<int> inside) const {
        const auto ior = [&](int i) { return i < 0 ? R(1) : R(bodies[i].medium->ior); };
        const auto inner = [&] { return inside.empty() ? -1 : inside.back(); };
        const int before = inner();
        for (std::size_t i = 0; i < inside.size(); ++i) {
            if (inside[i] != body) continue;
            inside.erase(inside.begin() + static_cast<std::ptrdiff_t>(i));
            return {body == before ? ior(before) / ior(inner()) : R(1), inside};
        }
        inside.push_back(body);
        return {ior(before) / ior(body), inside};
    }

    Scene scene;
    View view;
    Eye<R> eye;
    Paint<R> sky;
    std::vector<Body<R>> bodies;
};

}  // namespace strahl::exact
