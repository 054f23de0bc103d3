// Exact arithmetic, as nearly as numbers of 113 bits have it: a recursive tracer that takes the doubles of a Scene and
// rounds nothing to double, the camera's axes and all matrices included. Bodies are the referee's. The same in long
// double, 100 times as fast, sees nearly all of what need not be judged by more.
#pragma once
#include <array>
#include <vector>

#include "scene/scene.h"
#include "tests/referee/basic.h"
#include "tests/referee/box.h"
#include "tests/referee/cone.h"
#include "tests/referee/disc.h"
#include "tests/referee/pattern.h"
#include "tests/referee/triangle.h"
#include "trace/tracer.h"

namespace strahl::exact {

using referee::Crossing;
using referee::Line;
using referee::Vector;

template <class R>
R radians(double degrees) {
    const R pi = R(0x1.921fb54442d18p+1) + R(0x1.1a62633145c07p-53) + R(-0x1.f1976b7ed8fbcp-109);
    return R(degrees) * pi / 180;
}
template <class R>
R cosine_of(R x) {
    const R half = sine_of(x / 2);
    return 1 - 2 * half * half;
}

/// local = rows * (world - moved)
template <class R = Quadruple>
struct Space {
    using Vector = referee::Vector<R>;
    std::array<Vector, 3> columns{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}, rows;
    Vector moved;

    explicit Space(const std::vector<Transformation>& steps) {
        for (const Transformation& step : steps) std::visit([&](const auto& own) { add(own); }, step);
        const auto& [a, b, c] = columns;
        const R scale = R(1) / dot(a, cross(b, c));
        rows = {scale * cross(b, c), scale * cross(c, a), scale * cross(a, b)};
    }
    Vector turn(const Vector& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }

  private:
    template <class Step>
    void then(const Step& step) {
        for (Vector& column : columns) column = step(column);
        moved = step(moved);
    }
    void add(const Rotate& r) {
        const auto sine = [](double degrees) { return sine_of(radians<R>(degrees)); };
        const auto cosine = [](double degrees) { return cosine_of(radians<R>(degrees)); };
        then([&, s = sine(r.degrees.x), c = cosine(r.degrees.x)](const Vector& v) {
            return Vector{v.x, c * v.y - s * v.z, s * v.y + c * v.z};
        });
        then([&, s = sine(r.degrees.y), c = cosine(r.degrees.y)](const Vector& v) {
            return Vector{c * v.x + s * v.z, v.y, c * v.z - s * v.x};
        });
        then([&, s = sine(r.degrees.z), c = cosine(r.degrees.z)](const Vector& v) {
            return Vector{c * v.x - s * v.y, s * v.x + c * v.y, v.z};
        });
    }
    void add(const Translate& t) { moved = moved + Vector(t.by); }
    void add(const Scale& s) {
        then([&](const Vector& v) { return v * Vector(s.by); });
    }
    void add(const Motion&) {}
};

/// A colour, the same everywhere or by a pattern in a space of its own within a body's.
template <class R>
struct Paint {
    Pigment pigment;
    Space<R> space;
    Paint(const Pigment& own, const std::vector<Transformation>& body) : pigment(own), space(steps_of(own, body)) {}
    Vector<R> at(const Vector<R>& p) const {
        return pigment.pattern ? referee::color_of(pigment, space.turn(p - space.moved)) : Vector<R>(pigment.color);
    }
    static std::vector<Transformation> steps_of(const Pigment& own, const std::vector<Transformation>& body) {
        std::vector<Transformation> steps;
        if (own.pattern) steps = own.pattern->transformations;
        steps.insert(steps.end(), body.begin(), body.end());
        return steps;
    }
};

template <class R>
struct Body {
    Shape shape;
    Material material;
    Space<R> space;
    Paint<R> paint;

    std::vector<Crossing<R>> meet(const Line<R>& line, int self) const {
        const Line<R> local{space.turn(line.origin - space.moved), space.turn(line.direction)};
        const int source = line.body == self ? line.face : -1;
        std::vector<Crossing<R>> found;
        std::visit(
            [&](const auto& own) {
                if constexpr (requires { crossings(own, local, source); }) found = crossings(own, local, source).list;
            },
            shape);
        for (auto& [t, face, n] : found) n = n.x * space.rows[0] + n.y * space.rows[1] + n.z * space.rows[2];
        return found;
    }
    bool surrounds(const Vector<R>& world) const {
        const Vector<R> p = space.turn(world - space.moved);
        return std::visit(
            [&](const auto& own) {
                if constexpr (requires { contains<R>(own, p); }) return contains<R>(own, p);
                return false;
            },
            shape);
    }
};

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
        : scene(own), view(own_view), eye(view), sky(own.background, {}) {
        for (const Primitive& p : scene.primitives) {
            const Material& material = scene.materials[p.material];
            bodies.push_back({p.shape, material, Space<R>(p.transformations), {material.rgb, p.transformations}});
        }
    }
    Vector at(int x, int y) const {
        std::vector<int> inside;
        for (int i = 0; i < std::ssize(bodies); ++i)
            if (bodies[i].material.refraction > 0 && bodies[i].surrounds(eye.position)) inside.push_back(i);
        return see(eye.ray(x, y), 1, inside);
    }

    /// What a spot sends along -l.
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
        if (body < 0) return scene.fog ? Vector(scene.fog->color) : sky.at(line.direction);
        const Vector sum = light_of(line, hit, body, generation, inside);
        if (!scene.fog || !inside.empty()) return sum;
        const R left = exponential(-hit.t / R(scene.fog->distance));
        return left * sum + (1 - left) * Vector(scene.fog->color);
    }

    Vector light_of(const Line<R>& line, const Crossing<R>& hit, int body, int generation,
                    const std::vector<int>& inside) const {
        const Material& material = bodies[body].material;
        const Vector e = line.direction, p = line.origin + hit.t * e, color = bodies[body].paint.at(p);
        Vector n = unit(hit.normal);
        if (dot(e, n) > 0) n = R(-1) * n;
        const Vector mirrored = e - 2 * dot(e, n) * n;
        Vector sum = R(material.ambient) * color * Vector(scene.settings.ambient_light);
        for (const Light& light : scene.lights) sum = sum + from(light, p, n, mirrored, color, body, hit.face);
        if (generation >= view.depth) return sum;
        R share = material.reflection;
        if (material.refraction > 0) {
            auto [ratio, after] = pass(body, inside);
            const R s = -dot(e, n), k = 1 - ratio * ratio * (1 - s * s);
            if (k < 0)
                share += R(material.refraction);
            else
                sum =
                    sum + R(material.refraction) * see({p, unit(ratio * e + (ratio * s - root(k)) * n), body, hit.face},
                                                       generation + 1, after);
        }
        if (share > 0) sum = sum + share * see({p, mirrored, body, hit.face}, generation + 1, inside);
        return sum;
    }

    Vector from(const Light& light, const Vector& p, const Vector& n, const Vector& mirrored, const Vector& color,
                int body, int face) const {
        const Vector way = light.direction ? R(-1) * Vector(*light.direction) : Vector(light.position) - p,
                     l = unit(way);
        const R facing = dot(n, l), glance = dot(mirrored, l);
        if (!(facing > 0)) return {};
        const Material& material = bodies[body].material;
        const R highlight = glance > 0 ? R(material.specular) * power(glance, R(material.pow)) : R(0);
        Vector share = light.color * (R(material.diffuse) * facing * color +
                                      Vector{highlight, highlight, highlight});
        share = share_of_spot(light, l) * share;
        const R distance = root(dot(way, way));
        for (int i = 0; i < std::ssize(bodies); ++i)
            for (const auto& crossing : bodies[i].meet({p, l, body, face}, i)) {
                if (!(crossing.t > 0 && (light.direction || crossing.t < distance))) continue;
                const Material& other = bodies[i].material;
                if (!(other.refraction > 0)) return {};
                share = R(other.refraction) * share * bodies[i].paint.at(p + crossing.t * l);
            }
        return share;
    }

    /// The ratio of indices at a surface of `body`, and the medium stack behind it, by POV-Ray's rule.
    std::pair<R, std::vector<int>> pass(int body, std::vector<int> inside) const {
        const auto ior = [&](int i) { return i < 0 ? R(1) : R(bodies[i].material.ior); };
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
