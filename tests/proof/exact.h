// Exact arithmetic, as nearly as numbers of 113 bits have it: a recursive tracer that takes the doubles of a Scene and
// rounds nothing to double, the camera's axes and all matrices included. Bodies are the referee's. The same in long
// double, 100 times as fast, sees nearly all of what need not be judged by more.
#pragma once
#include <vector>

#include "tests/proof/exact_bodies.h"
#include "tests/proof/exact_finish.h"
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
            if (bodies[i].medium->transmits() && bodies[i].surrounds(eye.position)) inside.push_back(i);
        return see(eye.ray(x, y), 1, inside, 1);
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
    /// `weight` is how strong POV-Ray takes the ray for.
    Vector see(const Line<R>& line, int generation, const std::vector<int>& inside, R weight) const {
        int body = -1;
        Crossing<R> hit{};
        for (int i = 0; i < std::ssize(bodies); ++i)
            for (const auto& crossing : bodies[i].meet(line, i))
                if (crossing.t > 0 && (body < 0 || crossing.t < hit.t)) body = i, hit = crossing;
        const bool foggy = scene.fog && inside.empty();
        if (body < 0) return foggy ? Vector(scene.fog->color) : sky.at(line.direction);
        const Vector sum = light_of(line, hit, body, generation, inside, weight);
        if (!foggy) return sum;
        const R left = exponential(-hit.t / R(scene.fog->distance));
        return left * sum + (1 - left) * Vector(scene.fog->color);
    }

    Vector light_of(const Line<R>& line, const Crossing<R>& hit, int body, int generation,
                    const std::vector<int>& inside, R weight) const {
        const Material& material = bodies[body].material_of(hit.face);
        const Vector e = line.direction, p = line.origin + hit.t * e,
                     color = bodies[body].leaf_of(hit.face).color_at(p, hit.face);
        Vector n = unit(hit.normal);
        if (dot(e, n) > 0) n = R(-1) * n;
        const Vector flat = n;
        n = bodies[body].leaf_of(hit.face).bent(p, hit.face, flat);
        const Finish<R> finish(material, color);
        Vector sum = finish.ambient() * Vector(scene.settings.ambient_light);
        for (const Light& light : scene.lights) sum = sum + from(light, p, flat, n, e, finish, body, hit.face);
        if (generation >= view.depth) return sum;
        const R least = scene.settings.adc_bailout, facing = dot(e, n) > 0 ? dot(e, n) : -dot(e, n);
        const bool enters = dot(e, hit.normal) < 0;
        Sent<R> away = finish.reflected(facing, enters, least), through = finish.refracted(away, least);
        if (through.strength > 0) {
            auto [ratio, after] = pass(body, inside);
            const Vector before = dot(e, n) > 0 ? R(-1) * n : n;  // on the ray's side
            const R s = -dot(e, before), k = 1 - ratio * ratio * (1 - s * s);
            if (k < 0) {
                away = finish.total(through);
            } else if (weight * through.strength >= least) {
                const bool straight = ratio == 1 && !material.plain() && material.rgb.clear();
                const Vector beyond = ratio == 1 ? e : unit(ratio * e + (ratio * s - root(k)) * before);
                sum = sum + through.color * see({p, beyond, body, hit.face}, generation + !straight, after,
                                                weight * through.strength);
            }
        }
        Vector mirrored = e - 2 * dot(e, n) * n;
        if (dot(mirrored, flat) < 0) {
            if (dot(mirrored, n) < 0) mirrored = e;
            mirrored = mirrored - 2 * dot(mirrored, flat) * flat;
        }
        if (away.strength > 0 && weight * away.strength >= least)
            sum = sum + away.color * see({p, mirrored, body, hit.face}, generation + 1, inside, weight * away.strength);
        return sum;
    }

    Vector from(const Light& light, const Vector& p, const Vector& flat, const Vector& n, const Vector& e,
                const Finish<R>& finish, int body, int face) const {
        const Material& material = bodies[body].material_of(face);
        if (light.group == 0 ? material.common == 0 : material.group != light.group) return {};
        const Vector way = light.direction ? R(-1) * Vector(*light.direction) : Vector(light.position) - p,
                     l = unit(way);
        if (!(dot(n, l) > 0) || !(light.shadowless || dot(flat, l) > 0)) return {};
        const R distance = root(dot(way, way));
        R strength = share_of_spot(light, l);
        if (light.fades()) strength = 2 * strength / (1 + power(distance / light.fade_distance, R(light.fade_power)));
        Vector share = strength * (Vector(light.color) * finish.scattered(e, n, l, !light.shadowless));
        if (light.shadowless) return share;
        for (int i = 0; i < std::ssize(bodies); ++i)
            for (const auto& crossing : bodies[i].meet({p, l, body, face}, i)) {
                if (!(crossing.t > 0 && (light.direction || crossing.t < distance))) continue;
                const Material& other = bodies[i].material_of(crossing.face);
                if (other.shadow == 0) continue;
                if (!other.transmits()) return {};
                const Finish<R> own(other,
                                    bodies[i].leaf_of(crossing.face).color_at(p + crossing.t * l, crossing.face));
                share = share * own.shadow();
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
