#include "tests/attack/bodies/degenerate_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "tests/referee/dice.h"

namespace strahl {
namespace {

/// Makes bodies of about the size 1 around the origin.
class DegenerateBodies {
  public:
    explicit DegenerateBodies(Dice& dice) : dice(dice) {}

    Shape any(int levels = 1) {
        switch (dice.upto(levels > 0 ? 14 : 6)) {
            case 0:
                return make(Sphere{});
            case 1:
                return make(Cylinder{});
            case 2:
            case 3:
                return make(Cone{});
            case 4:
                return make(Cuboid{});
            case 5:
                return make(Torus{});
            case 6:
                return make(Plane{});
            case 7:
                return make(Disc{});
            case 8:
                return make(Triangle{});
            case 9:
                return make(SmoothTriangle{});
            case 10:
                return make(Mesh{});
            case 11:
                return make(Prism{});
            case 12:
                return make(Lathe{});
            case 13:
                return dice.chance(.4) ? make(Superellipsoid{}) : dice.chance(.5) ? make(Blob{}) : make(SphereSweep{});
            default:
                return composite();
        }
    }

    double least = 1;  // the smallest length in what was made

  private:
    double power(double lowest, double most) { return std::pow(10., dice.in(lowest, most)); }
    double known(double length) { return least = std::min(least, length), length; }
    /// 1, or next to nothing.
    double length() { return known(dice.chance(.4) ? 1 : power(-12, 0)); }
    /// About 1, often 1 itself or next to it.
    double near_one() { return dice.chance(.3) ? 1 : 1 + (dice.chance(.5) ? -1 : 1) * power(-17, -.5); }
    DVec3 axis() {
        if (dice.chance(.6)) return dice.direction();
        DVec3 axis(0);
        axis[dice.upto(2)] = dice.chance(.5) ? 1 : -1;
        return dice.chance(.7) ? axis : axis + power(-17, -1) * dice.direction();
    }
    DVec3 place() { return dice.chance(.4) ? DVec3(0) : dice.vector(-.5, .5); }

    Shape make(const Sphere&) { return Sphere{place(), dice.in(.3, 1)}; }
    Shape make(const Cylinder&) {
        const DVec3 base = place();
        return Cylinder{base, base + length() * axis(), length()};
    }
    Shape make(const Cone&) {
        const DVec3 base = place();
        Cone cone{base, length(), base + length() * axis(), 0};
        if (dice.chance(.7)) cone.cap_radius = dice.chance(.7) ? cone.base_radius * near_one() : length();
        if (dice.chance(.5)) std::swap(cone.base_radius, cone.cap_radius);
        return cone;
    }
    Shape make(const Cuboid&) {
        const DVec3 corner = place();
        const auto side = [&] { return (dice.chance(.5) ? -1 : 1) * length(); };
        const double x = side(), y = side(), z = side();
        return Cuboid{corner, corner + DVec3(x, y, z)};
    }
    Shape make(const Torus&) {
        const double major = dice.in(.3, 1);
        const double minor = major * (dice.chance(.4) ? near_one() : dice.chance(.5) ? power(-8, 0) : power(0, 2.9));
        return Torus{place(), power(-9, 9) * axis(), major, known(minor)};
    }
    Shape make(const Plane&) {
        const DVec3 a = place(), u = axis(), v = u + known(power(-9, 0)) * dice.direction();
        return Plane{a, a + power(-6, 6) * u, a + power(-6, 6) * v};
    }
    Shape make(const Disc&) {
        const double radius = length();
        const double hole = dice.chance(.4) ? 0 : radius * (dice.chance(.5) ? power(-12, 0) : 1 - known(power(-9, 0)));
        return Disc{place(), power(-9, 9) * axis(), radius, hole};
    }
    Shape make(const Triangle&) {
        const DVec3 a = place(), u = axis();
        return Triangle{a, a + u, a + dice.in(.2, 1) * u + length() * dice.direction()};
    }
    Shape make(const SmoothTriangle&) {
        const auto [a, b, c] = std::get<Triangle>(make(Triangle{}));
        const auto normal = [&] { return power(-9, 9) * axis(); };
        const DVec3 first = normal(), second = dice.chance(.2) ? -first : normal(), third = normal();
        return SmoothTriangle{a, b, c, first, second, third};
    }
    /// A contour whose lines may be tiny or lead back.
    Contour contour() {
        Contour contour{{dice.in(-1, 1), dice.in(-1, 1)}, {}};
        Contour::Point from = contour.start;
        for (int i = 1 + dice.upto(3); i >= 0; --i) {
            const auto near = [&](const Contour::Point& p) {
                const double size = length();
                return Contour::Point{p[0] + size * dice.in(-1, 1), p[1] + size * dice.in(-1, 1)};
            };
            const Contour::Point end = near(from);
            contour.strokes.push_back({dice.chance(.3) ? end : near(dice.chance(.5) ? end : from), end});
            if (dice.chance(.4)) contour.strokes.back().second = near(dice.chance(.5) ? end : from);
            from = end;
        }
        return contour;
    }
    Shape make(const Prism&) {
        Prism prism;
        do {
            prism = {0, length(), std::make_shared<const ContourData>(std::vector{contour()})};
        } while (prism.fault());
        return prism;
    }
    Shape make(const Lathe&) {
        Contour own = contour();
        if (dice.chance(.4)) own.strokes.push_back({own.start, own.start});
        if (dice.chance(.3)) own.start[0] = 0;
        return Lathe{std::make_shared<const ContourData>(std::vector{own}, true)};
    }
    Shape make(const Superellipsoid&) {
        // The radius of an edge is about its roundness.
        const auto roundness = [&] { return known(dice.chance(.3) ? 1. + dice.upto(1) : power(-5.9, .3)); };
        return Superellipsoid{roundness(), roundness()};
    }
    Shape make(const Blob&) {
        // Lumps may be in one place, tiny, or flat; the thinnest wall is about as thick as the least of them.
        std::vector<Lump> lumps(1 + static_cast<std::size_t>(dice.upto(3)));
        for (Lump& own : lumps) {
            own.from = own.to = dice.chance(.3) ? lumps[0].from : place();
            if (dice.chance(.4)) own.to = own.from + length() * axis();
            own.radius = &own == &lumps[0] ? dice.in(.3, 1) : length();
            own.strength = &own != &lumps[0] && dice.chance(.3) ? -1 : dice.in(.6, 1.2);
            if (dice.chance(.2)) own.z = length() * own.z;
        }
        return Blob{.5, std::make_shared<const BlobData>(std::move(lumps))};
    }
    Shape make(const SphereSweep&) {
        // Balls may be in one place, tiny, or without a radius; between two far ones the path is long and thin.
        std::vector<SweptBall> balls(4 + static_cast<std::size_t>(dice.upto(2)));
        const bool through = dice.chance(.5);
        for (SweptBall& own : balls)
            own = {dice.chance(.2) ? balls[0].centre : place(), dice.chance(.1) ? 0 : length(), through};
        balls[1].radius = dice.in(.3, 1);
        return SphereSweep{std::make_shared<const SweepData>(std::move(balls))};
    }
    Shape make(const Mesh&) {
        MeshData data = *Mesh::tetrahedron();
        const DVec3 n = normalize(axis());
        const double thickness = length();
        for (DVec3& point : data.points) {
            point = point + dice.vector(-.2, .2);
            point = point + (thickness - 1) * dot_product(point, n) * n;
        }
        return Mesh{.data = std::make_shared<const MeshData>(std::move(data)), .file = ""};
    }
    /// Two bodies of which the second may be the first, somewhat moved, or another one.
    Shape composite() {
        const auto closed = [&] {
            Shape shape = any(0);
            while (!std::visit([](const auto& kind) { return kind.closed; }, shape)) shape = any(0);
            return shape;
        };
        Primitive first{closed(), 0, {}}, second = first;
        if (dice.chance(.6)) second.shape = closed();
        if (dice.chance(.5)) second.transformations = {Translate{length() * normalize(axis())}};
        auto parts = std::make_shared<const std::vector<Primitive>>(std::vector{first, second});
        switch (dice.upto(2)) {
            case 0:
                return Union{parts};
            case 1:
                return Intersection{parts};
            default:
                return Difference{parts};
        }
    }

    Dice& dice;
};

std::vector<Transformation> pose(Dice& dice, std::string& words) {
    std::vector<Transformation> steps;
    const auto add = [&](const char* name, const Transformation& step) {
        words += name;
        steps.push_back(step);
    };
    const auto power = [&](double least, double most) { return std::pow(10., dice.in(least, most)); };
    if (dice.chance(.2)) add(" stretched", Scale{{power(-2, 2), power(-2, 2), power(-2, 2)}});
    if (dice.chance(.2)) add(" mirrored", Scale{{dice.chance(.5) ? -1. : 1., 1, -1}});
    if (dice.chance(.2))
        add(" turned by quarters", Rotate{{90. * dice.upto(3), 90. * dice.upto(3), 90. * dice.upto(3)}});
    if (dice.chance(.4)) add(" turned", Rotate{dice.vector(-180, 180)});
    if (dice.chance(.1)) add(" flattened", Scale{{1, 1, power(-9, 0)}});
    if (dice.chance(.3)) add(" scaled", Scale{DVec3(power(-7, 7))});
    return steps;
}

/// The direction of a body's axis, or one of its sides, in its own space; of flat ones any direction.
DVec3 axis_of(const Shape& shape, Dice& dice) {
    const auto look = [&]<class Kind>(const Kind& kind) -> DVec3 {
        if constexpr (requires { kind.cap; })
            return normalize(kind.cap - kind.base);
        else if constexpr (requires { DVec3(kind.axis); })
            return normalize(kind.axis);
        else if constexpr (requires { DVec3(kind.normal); })
            return normalize(kind.normal);
        else if constexpr (requires { kind.c; })
            return dice.direction();
        else {
            DVec3 side(0);
            side[dice.upto(2)] = 1;
            return side;
        }
    };
    return std::visit(look, shape);
}

Material material(Dice& dice) {
    Material m{.rgb = dice.vector(.3, 1), .reflection = 0, .refraction = 0, .diffuse = .6, .ambient = .2};
    m.specular = dice.chance(.3) ? .3 : 0, m.pow = 20;
    if (dice.chance(.3)) m.reflection = .4;
    if (dice.chance(.3)) m.refraction = .6, m.ior = dice.chance(.3) ? 1 : 1.3;
    return m;
}

}  // namespace

DegenerateScene degenerate_scene(std::uint64_t seed) {
    Dice dice(seed);
    while (true) {
        DegenerateScene made;
        DegenerateBodies bodies(dice);
        Primitive body{bodies.any(), 0, {}};
        if (std::visit([](const auto& kind) { return kind.fault() != nullptr; }, body.shape)) continue;
        made.words = std::visit([](const auto& kind) { return std::string(kind.name) + ":"; }, body.shape);
        body.transformations = pose(dice, made.words);
        const auto power = [&](double least, double most) { return std::pow(10., dice.in(least, most)); };

        const glm::dmat4 to_world = matrix(body.transformations);
        const Box box = world_bounds(body);
        const bool bounded = box.finite();
        const double stretch = std::cbrt(std::abs(glm::determinant(glm::dmat3(to_world))));
        double size = bounded ? length(box.size()) : stretch;
        if (!(size > 0)) continue;
        DVec3 target = bounded ? box.low + box.size() * dice.vector(.3, .7) : transform_point(to_world, DVec3(0));
        if (dice.chance(.2) && bounded) {
            const DVec3 away = dice.direction() * size * power(0, 4);
            body.transformations.push_back(Translate{away});
            made.words += " moved", target = target + away;
        }
        DVec3 way = dice.direction();
        double distance = size * dice.in(1, 3);
        if (dice.chance(.2)) {
            way = normalize(glm::dmat3(to_world) * axis_of(body.shape, dice));
            made.words += ", along its axis";
            if (dice.chance(.5) && bounded) target = box.centre();
        }
        if (dice.chance(.15)) {
            made.words += ", from afar", distance = size * power(1, 4);
        } else if (dice.chance(.15)) {
            made.words += ", from within or nearby", distance = size * power(-3, -.5);
        }
        Scene& scene = made.scene;
        DVec3 up = dice.direction();
        scene.camera = {target - way * distance, target, up, 0, {}};
        scene.camera.fov = std::clamp(std::atan(size * dice.in(.2, .8) / distance) * 57.29577951308232, 1e-4, 60.);
        if (degenerate(scene.camera)) continue;
        scene.background = dice.vector(0, .4);
        scene.lights.push_back({target + (dice.direction() - way * .7) * size * 3., Color(1)});
        scene.materials = {material(dice), material(dice)};
        scene.primitives = {body};
        scene.primitives.push_back({Sphere{target + dice.direction() * size, size * dice.in(.1, .3)}, 1, {}});
        double farthest = std::max({length(scene.camera.position), length(target), length(scene.lights[0].position)});
        double shrunk = 1;
        for (const Transformation& step : body.transformations)
            if (const Scale* const scale = std::get_if<Scale>(&step))
                shrunk *= std::min({std::abs(scale->by.x), std::abs(scale->by.y), std::abs(scale->by.z)});
        // An eye in an opaque union sees what is in it, or not (scene/union_groups.h).
        const bool opaque_union = std::holds_alternative<Union>(body.shape) && scene.materials[0].refraction == 0;
        if (farthest > 1e9 || (opaque_union && contains(body, scene.camera.position))) continue;
        const auto is_made = [](const auto& kind) { return is_composite<std::remove_cvref_t<decltype(kind)>>; };
        if (std::visit(is_made, body.shape)) farthest = std::max(farthest, 1.);  // as the referee's tolerance there
        made.condition = std::max(farthest, size) / (bodies.least * shrunk);
        return made;
    }
}

}  // namespace strahl
