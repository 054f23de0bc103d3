// Random scenes.
#include "tests/referee/random_scene.h"

#include <cmath>
#include <tuple>
#include <type_traits>

#include "tests/referee/dice.h"
#include "tests/referee/random_pattern.h"
#include "tests/referee/random_places.h"

namespace strahl {
namespace {

Material matt(Dice& dice) {
    return {.rgb = dice.vector(0, 1),
            .reflection = 0,
            .refraction = 0,
            .diffuse = dice.in(.2, 1),
            .ambient = dice.chance(.5) ? dice.in(0, .5) : 0,
            .specular = dice.chance(.5) ? dice.in(0, 1) : 0,
            .pow = dice.chance(.3) ? dice.in(1, 80) : dice.upto(60),
            .ior = 1};
}
Material mirror(Dice& dice) {
    Material m = matt(dice);
    m.reflection = dice.chance(.3) ? 1 : dice.in(.1, 1);
    return m;
}
Material glass(Dice& dice) {
    Material m = dice.chance(.3) ? mirror(dice) : matt(dice);
    m.refraction = dice.chance(.3) ? 1 : dice.in(.2, 1);
    m.diffuse *= .3;
    m.ior = dice.chance(.15) ? 1 : dice.chance(.2) ? dice.in(.6, 1) : dice.in(1, 2.2);
    return m;
}

Shape sphere(Dice& dice) { return Sphere{dice.vector(-1.6, 1.6), dice.in(.2, 1.4)}; }
Shape cylinder(Dice& dice) {
    const DVec3 base = dice.vector(-1.6, 1.6);
    return Cylinder{base, base + dice.arrow(.3, 3), dice.in(.1, .9)};
}
/// Behind the bodies as `eye` sees them; it faces the eye or, more rarely, away from it.
Shape plane(Dice& dice, const DVec3& eye) {
    DVec3 n = dice.direction();
    if (n.x * eye.x + n.y * eye.y + n.z * eye.z < 0) n = -n;
    const DVec3 a = -dice.in(1, 3.5) * n;
    const DVec3 across = dice.direction();
    const DVec3 u{n.y * across.z - n.z * across.y, n.z * across.x - n.x * across.z, n.x * across.y - n.y * across.x};
    const DVec3 v{n.y * u.z - n.z * u.y, n.z * u.x - n.x * u.z, n.x * u.y - n.y * u.x};
    return dice.chance(.7) ? Plane{a, a + u, a + v} : Plane{a, a + v, a + u};
}

/// Is no number 0 that must not be?
template <class Kind>
bool in_range(const Kind& body) {
    const auto good = [&](const auto& field) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(body.*field.member)>, double>)
            return field.range != Range::positive || body.*field.member > 0;
        return true;
    };
    return std::apply([&](const auto&... field) { return (good(field) && ...); }, Kind::fields);
}
/// A bounded body of any kind.
/// A tetrahedron of its own: two of the usual one would share faces.
Mesh mesh(Dice& dice) {
    MeshData data = *Mesh::tetrahedron();
    for (DVec3& point : data.points) point = point + dice.vector(-.2, .2);
    return {.data = std::make_shared<const MeshData>(std::move(data)), .file = ""};
}

template <class... Kinds>
Shape any_kind(Dice& dice, std::type_identity<std::variant<Kinds...>>) {
    const auto make = [&]<class Kind>(Kind body) -> Shape {
        if constexpr (std::is_same_v<Kind, Mesh>) return mesh(dice);
        if constexpr (std::is_same_v<Kind, Prism>) return random_prism(dice);
        if constexpr (std::is_same_v<Kind, Lathe>) return random_lathe(dice);
        const auto fill = [&](auto& value) {
            if constexpr (std::is_same_v<decltype(value), DVec3&>)
                value = dice.vector(-1.6, 1.6);
            else
                value = dice.chance(.2) ? 0 : dice.in(.1, .9);
        };
        do std::apply([&](const auto&... field) { (fill(body.*field.member), ...); }, Kind::fields);
        while (body.fault() || !in_range(body));
        if constexpr (std::is_same_v<Kind, Superellipsoid>)
            if (body.e > .5) return dice.chance(.5) ? Shape(random_blob(dice)) : Shape(random_sweep(dice));
        return body;
    };
    Shape shape;
    do {
        // Blobs and sweeps take the place of rounder superellipsoids: all other scenes are as they were before.
        constexpr auto listed = []<class Kind>(Kind) {
            return !std::is_same_v<Kind, Blob> && !std::is_same_v<Kind, SphereSweep> &&
                   !std::is_same_v<Kind, JuliaFractal>;
        };
        const int wanted = dice.upto(sizeof...(Kinds) - 4);
        int number = 0;
        ((listed(Kinds{}) && number++ == wanted ? void(shape = make(Kinds{})) : void()), ...);
    } while (!std::visit([](const auto& body) { return body.bounded; }, shape));
    return shape;
}

std::vector<Transformation> steps(Dice& dice) {
    std::vector<Transformation> list;
    const auto factor = [&] { return dice.in(.6, 1.7) * (dice.chance(.2) ? -1 : 1); };
    for (int i = dice.upto(3); i > 0; --i) switch (dice.upto(3)) {
            case 0:
                list.push_back(Rotate{dice.vector(-180, 180)});
                break;
            case 1:
                list.push_back(Rotate{{90. * dice.upto(3), 0, 90. * dice.upto(3)}});
                break;
            case 2:
                list.push_back(Translate{dice.vector(-.7, .7)});
                break;
            default: {
                const double x = factor(), y = factor(), z = factor();
                list.push_back(dice.chance(.3) ? Scale{DVec3(x)} : Scale{{x, y, z}});
            }
        }
    return list;
}

Material any_material(Dice& dice, bool transparent) {
    const int kind = dice.upto(transparent ? 3 : 1);
    return kind == 0 ? matt(dice) : kind == 1 ? mirror(dice) : glass(dice);
}
int add(const Material& material, Scene& scene) {
    scene.materials.push_back(material);
    return static_cast<int>(scene.materials.size()) - 1;
}
/// Gives a composite 2 to 5 parts, with the material of the whole or one of their own, and some of them parts of
/// theirs.
void furnish(Shape& shape, int material, int levels, Scene& scene, Dice& dice, const RandomScene& what) {
    const auto part = [&] {
        while (true) {
            Shape own =
                dice.chance(.2) ? plane(dice, scene.camera.position) : any_kind(dice, std::type_identity<Shape>{});
            const auto fits = [&]<class Kind>(const Kind&) {
                return can_be_part<Kind> && (levels > 0 || !is_composite<Kind>);
            };
            if (!std::visit(fits, own)) continue;
            const int number = dice.chance(.6) ? material : add(any_material(dice, what.transparent), scene);
            furnish(own, number, levels - 1, scene, dice, what);
            return Primitive{own, number,
                             what.transformed && dice.chance(.5) ? steps(dice) : std::vector<Transformation>{}};
        }
    };
    const auto fill = [&]<class Kind>(Kind& kind) {
        if constexpr (is_composite<Kind>) {
            std::vector<Primitive> parts;
            for (int i = 1 + dice.upto(3); i >= 0; --i) parts.push_back(part());
            kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
        }
    };
    std::visit(fill, shape);
}

}  // namespace

namespace {

/// Contours of points that `point` makes.
template <class Point>
std::vector<Contour> random_contours(Dice& dice, const Point& point) {
    std::vector<Contour> contours(1 + static_cast<std::size_t>(dice.upto(2)));
    for (Contour& own : contours) {
        own.start = point();
        for (int i = 2 + dice.upto(4); i > 0; --i) {
            const Contour::Point end = point();
            own.strokes.push_back({dice.chance(.3) ? end : point(), end});
            if (dice.chance(.4)) own.strokes.back().second = point();
        }
    }
    return contours;
}

}  // namespace

Prism random_prism(Dice& dice) {
    std::vector<Contour> contours = random_contours(dice, [&] {
        return Contour::Point{dice.in(-1.4, 1.4), dice.in(-1.4, 1.4)};
    });
    const double base = dice.in(-1, .3);
    return {base, base + dice.in(.2, 1.2), std::make_shared<const ContourData>(std::move(contours))};
}

Lathe random_lathe(Dice& dice) {
    std::vector<Contour> contours = random_contours(dice, [&] {
        return Contour::Point{dice.in(0, 1.4), dice.in(-1.2, 1.2)};
    });
    for (Contour& own : contours) {
        Contour::Stroke& last = own.strokes.back();
        if (dice.chance(.6))
            own.start[0] = last.end[0] = 0;
        else
            last.end = own.start;
        if (dice.chance(.3)) last.control = last.end, last.second.reset();
    }
    return {std::make_shared<const ContourData>(std::move(contours), true)};
}

Blob random_blob(Dice& dice) {
    std::vector<Lump> lumps(2 + static_cast<std::size_t>(dice.upto(4)));
    for (Lump& own : lumps) {
        own.from = own.to = dice.vector(-.7, .7);
        if (dice.chance(.4)) own.to = dice.vector(-.7, .7);
        own.radius = dice.in(.4, 1), own.strength = &own != &lumps[0] && dice.chance(.2) ? -.5 : dice.in(.6, 1.2);
        if (dice.chance(.3)) own.x = dice.in(.6, 1.5) * own.x, own.y = {dice.in(-.4, .4), 1, dice.in(-.4, .4)};
    }
    return {dice.in(.3, .6), std::make_shared<const BlobData>(std::move(lumps))};
}

SphereSweep random_sweep(Dice& dice) {
    std::vector<SweptBall> balls(4 + static_cast<std::size_t>(dice.upto(4)));
    const bool through = dice.chance(.5), even = dice.chance(.5);
    const double radius = dice.in(.05, .4);
    for (SweptBall& own : balls) own = {dice.vector(-1.2, 1.2), even ? radius : dice.in(.05, .4), through};
    return {std::make_shared<const SweepData>(std::move(balls))};
}

Scene random_scene(std::uint64_t seed, const RandomScene& what) {
    Dice dice(seed);
    Scene scene;
    Camera& camera = scene.camera;
    camera.position = dice.arrow(4, 9);
    camera.look_at = dice.vector(-.7, .7);
    camera.up = dice.direction();
    camera.fov = dice.in(10, 35);
    if (dice.chance(.3)) camera.aspectratio = dice.in(.7, 2);
    scene.background = dice.vector(0, .6);
    scene.settings.ambient_light = dice.vector(0, 1);
    for (int i = dice.upto(3); i >= 0; --i) {
        const DVec3 position = dice.arrow(2.5, 6);
        scene.lights.push_back({position, dice.vector(0, 1)});
    }
    const auto put = [&](Shape shape, const Material& material, std::vector<Transformation> transformations) {
        const int number = add(material, scene);
        furnish(shape, number, what.levels, scene, dice, what);
        scene.primitives.push_back({std::move(shape), number, std::move(transformations)});
    };
    for (int i = dice.upto(2); i > 0; --i) {
        const Shape floor = plane(dice, scene.camera.position);
        put(floor, dice.chance(.5) ? mirror(dice) : matt(dice), {});
    }
    for (int i = dice.upto(5); i >= -1; --i) {
        const Shape shape = dice.chance(what.any_kind) ? any_kind(dice, std::type_identity<Shape>{})
                            : dice.chance(.55)         ? sphere(dice)
                            : dice.chance(.95)         ? cylinder(dice)
                                                       : plane(dice, scene.camera.position);
        const Material material = any_material(dice, what.transparent);
        put(shape, material, what.transformed && dice.chance(.5) ? steps(dice) : std::vector<Transformation>{});
    }
    if (what.lights)
        for (Light& light : scene.lights) {
            if (dice.chance(.4)) {
                Spot spot{dice.vector(-1, 1), dice.in(1, 30), 0, dice.chance(.5) ? 0 : dice.in(0, 20)};
                spot.falloff = dice.chance(.2) ? spot.radius : dice.in(spot.radius, 60);
                light.spot = spot;
            } else if (dice.chance(.6)) {
                light.direction = -light.position, light.position = DVec3(0);
            } else if (dice.chance(.5)) {
                const DVec3 u = dice.arrow(.2, 1);
                light.area = Area{u, cross_product(u, dice.direction()), 1 + dice.upto(2), 1 + dice.upto(1)};
            }
        }
    if (what.lights && dice.chance(.5)) {
        Fog fog{dice.in(2, 30), dice.vector(0, 1)};
        // Every third is ground fog; that takes no more numbers of the dice.
        if (fog.distance < 10)
            fog.altitude = fog.distance / 5, fog.offset = fog.color.x - .5, fog.up = fog.color - DVec3(.3);
        if (fog.distance > 5 && fog.distance < 15) fog.transmit = fog.color.y / 3;
        scene.fog = fog;
    }
    if (what.patterns && dice.chance(.5)) scene.background = Pigment(random_pattern(dice));
    if (what.patterns)
        for (Material& material : scene.materials)
            if (dice.chance(.5)) material.rgb = Pigment(random_pattern(dice));
    if (what.bumps)
        for (Material& material : scene.materials)
            if (dice.chance(.6)) material.bump = random_bump(dice);
    if (what.normals)
        for (Material& material : scene.materials)
            if (dice.chance(.6)) material.normal = random_normal_map(dice);
    if (what.patterns || what.bumps || what.normals)
        for (Primitive& primitive : scene.primitives)
            if (Mesh* const mesh = std::get_if<Mesh>(&primitive.shape)) {
                give_places(*mesh, dice);
                map_by_uv(scene.materials[primitive.material]);
            }
    if (what.camera_inside) {
        camera.fov = dice.in(25, 55);
        const DVec3 beside = dice.arrow(0, .5);
        const Sphere around{camera.position + beside, dice.in(.6, 2)};
        put(around, glass(dice), {});
    }
    return scene;
}

}  // namespace strahl
