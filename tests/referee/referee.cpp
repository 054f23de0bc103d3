// The referee. Every formula is written as the article and the scene language state it, and none as the tracer has it.
#include "tests/referee/referee.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/referee/body.h"

namespace strahl {
namespace {

using namespace referee;

struct Signature {
    std::uint64_t value = 0xcbf29ce484222325;
    void add(std::uint64_t event) { value = (value ^ event) * 0x100000001b3, value ^= value >> 29; }
};

}  // namespace

template <class R>
struct Referee<R>::World {
    Scene scene;
    Vector<R> eye, right, down, forward;
    int width, height, depth;
    OtherRules rules;
    Paint<R> sky;
    std::vector<Body<R>> bodies;

    /// The camera ray through a point of the picture, (-1, -1) to (1, 1). Angles turn `forward` about the axes.
    Line<R> sight(const R& x, const R& y) const {
        const auto turned = [](const Vector<R>& from, const Vector<R>& to, const R& angle) {
            const R half = sine_of(R(angle / 2));
            return (1 - 2 * half * half) * from + sine_of(angle) * to;
        };
        const Vector<R> across = unit(right), below = unit(down), off = x * right + y * down;
        const R u = x * dot(across, right), v = y * dot(below, down), round = root(dot(off, off));
        switch (scene.camera.projection) {
            case Projection::orthographic:
                return {eye + off, forward};
            case Projection::fisheye:
                return {eye, round > 0 ? turned(forward, (1 / round) * off, round) : forward};
            case Projection::spherical:
                return {eye, turned(turned(forward, across, u), below, v)};
            case Projection::cylinder:
                return {eye, unit(turned(forward, across, u) + v * below)};
            case Projection::cylinder2:
                return {eye, unit(turned(forward, below, v) + u * across)};
            case Projection::cylinder3:
                return {eye + v * below, turned(forward, across, u)};
            case Projection::cylinder4:
                return {eye + u * across, turned(forward, below, v)};
            default:
                return {eye, unit(forward + off)};
        }
    }

    Vector<R> see(const Line<R>& line, int generation, const std::vector<int>& inside, Signature& signature) const {
        constexpr std::uint64_t missed = 1;
        int body = -1;
        Crossing<R> hit{};
        for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
            for (const auto& crossing : bodies[i].meet(line, i))
                if (crossing.t > rules.nearest && crossing.t < rules.farthest && (body < 0 || crossing.t < hit.t))
                    body = i, hit = crossing;
        const bool foggy = scene.fog && inside.empty();
        if (body < 0) {
            signature.add(missed);
            if (!foggy) return sky.at(line.direction);
            const R left = left_by_fog(line, R(1e30));
            const Vector<R> fog(scene.fog->color);
            return left > 0 ? left * sky.at(line.direction) + (1 - left) * fog : fog;
        }
        signature.add(100 + 1000 * body + hit.face);
        const Vector<R> seen = sent(line, body, hit, generation, inside, signature);
        if (!foggy) return seen;
        const R left = left_by_fog(line, hit.t);
        return left * seen + (1 - left) * Vector<R>(scene.fog->color);
    }

    /// The share of light that fog leaves along a line, whose mean density between two heights is the difference of the
    /// integrals over their distance.
    R left_by_fog(const Line<R>& line, const R& t) const {
        const Fog& fog = *scene.fog;
        R density = 1;
        if (fog.altitude > 0) {
            const Vector<R> up = unit(Vector<R>(fog.up));
            const auto integral = [](const R& h) { return h > 0 ? angle_of(R(1), h) : h; };
            const R a = (dot(up, line.origin) - R(fog.offset)) / R(fog.altitude);
            const R rise = t * dot(up, line.direction) / R(fog.altitude);
            density = rise == 0 ? (a > 0 ? 1 / (1 + a * a) : R(1)) : (integral(a + rise) - integral(a)) / rise;
        }
        return std::max(exponential(-t * density / R(fog.distance)), R(fog.transmit));
    }

    /// The light that a surface sends back along a line.
    Vector<R> sent(const Line<R>& line, int body, const Crossing<R>& hit, int generation,
                   const std::vector<int>& inside, Signature& signature) const {
        enum : std::uint64_t { lit = 2, total, through, under };
        const Material& material = bodies[body].material(hit.face);
        const Vector<R> e = line.direction, p = line.origin + hit.t * e, of = bodies[body].color(hit.face, p);
        Vector<R> n = unit(hit.normal);
        if (dot(e, n) > 0) n = R(-1) * n;
        const Vector<R> flat = n;
        n = bodies[body].bent(hit.face, p, n);
        const Vector<R> mirrored = unit(e - 2 * dot(e, n) * n);
        Vector<R> sum = R(material.ambient) * of * Vector<R>(scene.settings.ambient_light);
        for (const Light& light : scene.lights) {
            const Vector<R> way = light.direction ? R(-1) * Vector<R>(*light.direction) : Vector<R>(light.position) - p;
            const Vector<R> l = unit(way);
            const R facing = dot(n, l), glance = dot(mirrored, l), shines = spot_share(light, l);
            const bool behind = !rules.bent_side && !(dot(flat, l) > 0);
            if (!(facing > 0) || behind || !(shines > 0)) continue;
            signature.add(glance > 0 ? lit : lit + 10);
            Vector<R> answer = R(material.diffuse) * facing * of;
            const R highlight = glance > 0 ? R(material.specular) * power(glance, R(material.pow)) : R(0);
            answer = answer + Vector<R>(highlight, highlight, highlight);
            const R distance = light.direction ? R(HUGE_VAL) : root(dot(way, way));
            sum = sum + shines * arriving({p, l, body, hit.face}, distance, signature) * light.color * answer;
        }
        if (generation >= depth) return sum;

        R share = material.reflection;
        if (material.refraction > 0) {
            auto [ratio, after] = pass(body, inside);
            const Vector<R> before = dot(e, n) > 0 ? R(-1) * n : n;  // on the ray's side
            const R s = -dot(e, before), k = 1 - ratio * ratio * (1 - s * s);
            signature.add(k < 0 ? total : through);
            if (k < 0) {
                const Material& whole = rules.one_share ? bodies[body].medium : material;
                share = R(whole.reflection) + R(whole.refraction);
            } else {
                const Line<R> bent{p, unit(ratio * e + (ratio * s - root(k)) * before), body, hit.face};
                const int next = rules.straight_is_free && ratio == 1 ? generation : generation + 1;
                sum = sum + R(material.refraction) * see(bent, next, after, signature);
            }
        }
        if (share > 0) {
            Vector<R> away = mirrored;
            if (dot(away, flat) < 0) {
                signature.add(under);
                if (dot(away, n) < 0) away = e;
                away = away - 2 * dot(away, flat) * flat;
            }
            sum = sum + share * see({p, away, body, hit.face}, generation + 1, inside, signature);
        }
        return sum;
    }

    /// The share of its light that a light sends along -l.
    static R spot_share(const Light& light, const Vector<R>& l) {
        if (!light.spot) return 1;
        const auto cosine_of = [](double degrees) {
            const R half = R(degrees) * R(3.14159265358979323846264338327950288L) / 360;
            const R sine = sine_of(half);
            return 1 - 2 * sine * sine;
        };
        const R cosine = -dot(unit(Vector<R>(light.spot->look_at) - Vector<R>(light.position)), l);
        const R radius = cosine_of(light.spot->radius), falloff = cosine_of(light.spot->falloff);
        if (!(cosine > 0) || cosine < falloff) return 0;
        const R tight = light.spot->tightness == 0 ? R(1) : power(cosine, R(light.spot->tightness));
        if (cosine >= radius) return tight;
        const R u = (cosine - falloff) / (radius - falloff);
        return tight * u * u * (3 - 2 * u);
    }

    /// The share of a light that reaches the start of `line`, `distance` away from it.
    Vector<R> arriving(const Line<R>& line, R distance, Signature& signature) const {
        Vector<R> share{1, 1, 1};
        Signature crossed;
        struct Caster {
            R t;
            int body, face;
        };
        std::vector<Caster> casters;
        for (int i = 0; i < static_cast<int>(bodies.size()); ++i)
            for (const auto& crossing : bodies[i].meet(line, i))
                if (crossing.t > 0 && crossing.t < distance - rules.shadow && crossing.t < rules.farthest)
                    casters.push_back({crossing.t, i, crossing.face});
        std::stable_sort(casters.begin(), casters.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
        R last = 0;
        for (const auto& [t, body, face] : casters) {
            if (t - last < rules.shadow) continue;
            const Material& material = bodies[body].material(face);
            if (!(material.refraction > 0)) return signature.add(0), Vector<R>();
            share = R(material.refraction) * share * bodies[body].color(face, line.origin + t * line.direction);
            crossed.add(body);
            last = t;
        }
        signature.add(crossed.value);
        return share;
    }

    /// The ratio n1/n2 at a surface of `body`, and the medium stack behind it, by POV-Ray's rule.
    std::pair<R, std::vector<int>> pass(int body, std::vector<int> inside) const {
        const auto ior = [&](int i) { return R(bodies[i].medium.ior); };
        const R here = inside.empty() ? R(1) : ior(inside.back());
        for (std::size_t i = 0; i < inside.size(); ++i) {
            if (inside[i] != body) continue;
            const bool last = i + 1 == inside.size();
            inside.erase(inside.begin() + i);
            if (!last) return {R(1), inside};
            return {here / (inside.empty() ? R(1) : ior(inside.back())), inside};
        }
        inside.push_back(body);
        return {here / ior(body), inside};
    }
};

template <class R>
Referee<R>::Referee(const Scene& given, const Camera& camera, int width, int height, int depth,
                    const OtherRules& rules) {
    Scene scene = given;
    if (const double gamma = scene.settings.assumed_gamma; gamma != 0) {
        decode(scene.background, gamma);
        for (Material& material : scene.materials) decode(material.rgb, gamma);
    }
    const CameraFrame frame = frame_of(camera, double(width) / height);
    scene.camera = camera;
    World w{scene,
            camera.position,
            R(frame.tan_x) * Vector<R>(frame.right),
            R(frame.tan_y) * Vector<R>(frame.down),
            frame.forward,
            width,
            height,
            depth,
            rules,
            Paint<R>(scene.background, glm::dmat4(1)),
            {}};
    w.scene.lights = points_of(scene.lights);
    for (const Primitive& p : scene.primitives) w.bodies.emplace_back(p, scene.materials);
    world = std::make_unique<const World>(std::move(w));
}
template <class R>
Referee<R>::~Referee() = default;

template <class R>
Sample Referee<R>::at(double x, double y) const {
    const World& w = *world;
    const R sx = 2 * R(x) / w.width - 1, sy = 2 * R(y) / w.height - 1;
    const Line<R> line = w.sight(sx, sy);
    const Vector<R> off = sx * w.right + sy * w.down;
    const bool fisheye = w.scene.camera.projection == Projection::fisheye;
    if (fisheye && dot(off, off) > dot(w.down, w.down)) return {};
    std::vector<int> inside;
    for (int i = 0; i < static_cast<int>(w.bodies.size()); ++i)
        if (w.bodies[i].transparent() && w.bodies[i].surrounds(line.origin)) inside.push_back(i);
    Signature signature;
    const Vector<R> seen = w.see(line, 1, inside, signature);
    return {{static_cast<long double>(seen.x), static_cast<long double>(seen.y), static_cast<long double>(seen.z)},
            signature.value};
}

template <class R>
bool Referee<R>::explains(int i, int j, const double* rgb, double tolerance, double reach) const {
    const Sample centre = at(i + .5, j + .5);
    std::array<long double, 3> spread{};
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const Sample near = at(i + .5 + dx * reach, j + .5 + dy * reach);
            if (near.signature != centre.signature) return true;
            for (int c = 0; c < 3; ++c) spread[c] = std::max(spread[c], std::abs(near.rgb[c] - centre.rgb[c]));
        }
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(centre.rgb[c] - rgb[c]) <= tolerance + spread[c])) return false;
    return true;
}

template class Referee<long double>;
#if LDBL_MANT_DIG < 113
template class Referee<Quadruple>;
#endif

}  // namespace strahl
