// Random worlds of what proofs know: glass, mirrors and dull bodies that touch and overlap, of all sizes and anywhere.
// Two thirds of them have other bodies besides balls and rods, and patterns; a third has POV-Ray's finishes.
#pragma once
#include <cmath>
#include <numbers>

#include "scene/scene.h"
#include "tests/proof/bodies.h"
#include "tests/proof/finished.h"
#include "tests/proof/painted.h"
#include "tests/referee/dice.h"

namespace strahl::proof {

inline Material random_material(Dice& dice, bool glass) {
    Material m;
    m.rgb.color = dice.vector(.2, 1);
    m.ambient = dice.in(0, .3), m.diffuse = dice.in(.1, .7);
    m.specular = dice.chance(.5) ? dice.in(0, 1) : 0, m.pow = std::floor(std::pow(10, dice.in(0, 2.5)));
    m.reflection = dice.chance(.5) ? dice.in(.1, .9) : 0;
    if (glass && dice.chance(.4))
        m.refraction = dice.in(.3, .9), m.reflection = dice.in(0, .3), m.ior = dice.in(1, 2.4);
    if (dice.chance(.05)) m.ior = 1;
    return m;
}

/// Random numbers for bodies that replace balls and rods. With dice of their own the other bodies stay the same.
inline Dice dice_of_others(std::uint64_t seed) { return Dice(seed ^ 0x5deece66dull); }

/// Returns a random world of scale 1 around 0, scaled and moved. Some have glass, contacts and transformations.
inline Scene random_world(std::uint64_t seed) {
    Dice dice(seed);
    const double size = dice.chance(.5) ? 1 : std::pow(10, dice.in(-3, 4));
    const double far = dice.chance(.5) ? 0 : std::pow(10, dice.in(0, 4));
    const DVec3 shift = dice.vector(-far, far);
    const bool glass = dice.chance(.5), transformed = dice.chance(.3), contacts = dice.chance(.5);
    const int count = dice.chance(.2) ? 40 + dice.upto(80) : 2 + dice.upto(9);
    const auto place = [&](const DVec3& p) { return size * p + shift; };
    Scene scene;
    scene.background.color = dice.vector(.1, .9);
    scene.settings.max_trace_level = 2 + dice.upto(6);
    for (int i = 0; i <= dice.upto(3); ++i) {
        Light light{.position = place(dice.arrow(4, 12)), .color = dice.vector(.2, .9)};
        if (dice.chance(.15)) light.direction = dice.direction();
        scene.lights.push_back(light);
    }
    const auto put = [&](const Shape& shape) {
        Primitive primitive{shape, static_cast<int>(scene.materials.size()), {}};
        if (transformed && dice.chance(.5)) {
            primitive.transformations.push_back(Rotate{dice.vector(-200, 200)});
            primitive.transformations.push_back(Scale{DVec3(dice.in(.5, 2))});
            primitive.transformations.push_back(Translate{size * dice.vector(-1, 1)});
        }
        scene.primitives.push_back(primitive);
        scene.materials.push_back(random_material(dice, glass));
    };
    Dice others = dice_of_others(seed);
    const bool has_others = others.chance(.67);
    for (Light& light : scene.lights) {
        if (!has_others || light.direction || !others.chance(.3)) continue;
        const double radius = others.in(0, 40), soft = others.chance(.3) ? 0 : others.in(0, 40);
        light.spot = Spot{place(others.vector(-1, 1)), radius, radius + soft};
        if (others.chance(.4)) light.spot->tightness = others.chance(.7) ? others.upto(30) : others.in(0, 3);
    }
    const auto stretch = [&](const DVec3& around) {
        if (!has_others || !others.chance(.25)) return;
        std::vector<Transformation>& steps = scene.primitives.back().transformations;
        const std::vector<Transformation> uneven = uneven_steps(others, place(around));
        steps.insert(steps.begin(), uneven.begin(), uneven.end());
    };
    DVec3 last(0);
    double last_radius = 1;
    for (int i = 0; i < count; ++i) {
        const double radius = count > 20 ? dice.in(.05, .3) : dice.in(.2, 1.2);
        const bool touches = contacts && i > 0 && dice.chance(.3);
        const DVec3 centre = touches ? last + (last_radius + radius) * dice.direction() : dice.vector(-2.5, 2.5);
        if (has_others && others.chance(.1)) {
            const int material = static_cast<int>(scene.materials.size());
            put(random_composite(others, place(centre), size * radius, material, transformed));
            const Material own = scene.materials.back();
            scene.materials.push_back(own.refraction > 0 ? own : random_material(others, false));
        } else if (has_others && others.chance(.6)) {
            const DVec3 out = unit(centre - last), at = touches ? last + last_radius * out : centre;
            for (const Shape& shape : random_bodies(others, place(at), size * radius, touches, out)) {
                put(shape);
                stretch(at);
            }
        } else if (dice.chance(.7)) {
            put(Sphere{place(centre), size * radius});
            stretch(centre);
            last = centre, last_radius = radius;
        } else {
            put(Cylinder{place(centre), place(centre + dice.arrow(.3, 3)), size * radius * .6});
            stretch(centre);
        }
    }
    if (dice.chance(.6)) {
        const DVec3 a{0, 0, -2.5};
        if (dice.chance(.5))
            put(Plane{place(a), place(a + DVec3(1, 0, 0)), place(a + DVec3(0, 1, 0))});
        else
            put(Plane{place(a), place(a + dice.vector(-1, 1)), place(a + dice.vector(-1, 1))});
    }
    scene.camera.position = place(dice.chance(.1) ? dice.vector(-1, 1) : dice.arrow(5, 9));
    scene.camera.look_at = place(dice.vector(-1, 1));
    scene.camera.up = {dice.in(-.2, .2), 0, -1};
    scene.camera.fov = dice.in(10, 40);
    Dice paint = dice_of_paint(seed);
    if (has_others && paint.chance(.6)) paint_world(paint, size, shift, scene);
    Dice words = dice_of_finishes(seed);
    if (words.chance(.33)) finish_world(words, size, scene);
    return scene;
}

/// Returns a world of dull and mirroring balls and rods, some of which touch, so many that light buffers pay.
inline Scene random_crowd(std::uint64_t seed) {
    Dice dice(seed ^ 0xc0ffee);
    const double size = dice.chance(.5) ? 1 : std::pow(10, dice.in(-3, 4));
    const double far = dice.chance(.5) ? 0 : size * std::pow(10, dice.in(0, 3));
    const DVec3 shift = dice.vector(-far, far);
    const auto place = [&](const DVec3& p) { return size * p + shift; };
    Scene scene;
    scene.background.color = dice.vector(.1, .9);
    scene.settings.max_trace_level = 2 + dice.upto(6);
    for (int i = 0; i <= dice.upto(3); ++i) {
        Light light{.position = place(dice.chance(.2) ? dice.vector(-2, 2) : dice.arrow(4, 12)),
                    .color = dice.vector(.2, .9)};
        if (dice.chance(.25)) light.direction = dice.direction();
        scene.lights.push_back(light);
    }
    const auto put = [&](const Shape& shape) {
        scene.primitives.push_back({shape, static_cast<int>(scene.materials.size()), {}});
        scene.materials.push_back(random_material(dice, false));
    };
    DVec3 last(0);
    double last_radius = 1;
    for (int i = 66 + dice.upto(50); i > 0; --i) {
        const double radius = dice.in(.03, .3);
        const bool touches = dice.chance(.4);
        const DVec3 centre = touches ? last + (last_radius + radius) * dice.direction() : dice.vector(-2.5, 2.5);
        if (dice.chance(.7)) {
            put(Sphere{place(centre), size * radius});
            last = centre, last_radius = radius;
        } else {
            put(Cylinder{place(centre), place(centre + dice.arrow(.1, 2)), size * radius * .5});
        }
    }
    const DVec3 a{0, 0, -2.5};
    if (dice.chance(.7)) put(Plane{place(a), place(a + DVec3(1, 0, 0)), place(a + dice.vector(-1, 1))});
    scene.camera.position = place(dice.arrow(5, 9));
    scene.camera.look_at = place(dice.vector(-1, 1));
    scene.camera.up = {dice.in(-.2, .2), 0, -1};
    scene.camera.fov = dice.in(10, 40);
    return scene;
}

/// The size of pictures of the following worlds.
inline constexpr int edge_columns = 6, edge_rows = 4;

/// Makes a world of edges. The ray through the middle of each pixel of a small picture is at one, up to rounding: it
/// touches a ball or a rod, or meets a rim, an end whose plane holds the lamp, or an edge of another body or of a
/// pattern's pieces; or the ray mirrored by the floor, or the shadow ray from there, does.
inline Scene world_of_edges(std::uint64_t seed) {
    constexpr double degree = std::numbers::pi / 180;
    Dice dice(seed);
    Scene scene;
    scene.background.color = dice.vector(.1, .9);
    scene.settings.max_trace_level = 3;
    const double size = std::pow(10, dice.in(-3, 4)), far = dice.chance(.5) ? 0 : size * std::pow(10, dice.in(0, 3));
    const DVec3 shift = dice.vector(-far, far), eye = shift + size * dice.vector(-1, 1) + size * DVec3(0, -8, 5);
    const DVec3 lamp = shift + size * DVec3(dice.in(-6, 6), dice.in(-6, 2), 9);
    scene.camera.position = eye, scene.camera.look_at = shift, scene.camera.up = {dice.in(-.2, .2), 0, -1};
    scene.camera.fov = dice.in(10, 25);
    scene.lights.push_back({.position = lamp, .color = Color(.8)});
    const auto dull = [&](double reflection) {
        Material m = random_material(dice, false);
        m.reflection = reflection;
        scene.materials.push_back(m);
        return static_cast<int>(scene.materials.size()) - 1;
    };
    const double level = shift.z;
    const DVec3 on_floor{shift.x, shift.y, level};
    scene.primitives.push_back(
        {Plane{on_floor, on_floor + size * DVec3(1, 0, 0), on_floor + size * DVec3(0, 1, 0)}, dull(.5), {}});
    const CameraFrame frame = frame_of(scene.camera, double(edge_columns) / edge_rows);
    Dice others = dice_of_others(seed);
    const bool has_others = others.chance(.67);
    if (has_others && others.chance(.3)) {  // a spot whose border passes through a point of the floor, but for rounding
        const double u = (2. * others.upto(edge_columns - 1) + 1) / edge_columns - 1;
        const double v = (2. * (edge_rows - 1) + 1) / edge_rows - 1;
        const DVec3 way = unit(frame.forward + u * frame.tan_x * frame.right + v * frame.tan_y * frame.down);
        const DVec3 to_point = unit(eye + (level - eye.z) / way.z * way - lamp), axis = unit(shift - lamp);
        const DVec3 off = to_point - axis;
        const double angle = 2 * std::asin(std::sqrt(off.x * off.x + off.y * off.y + off.z * off.z) / 2) / degree;
        const bool hard = others.chance(.5);
        scene.lights[0].spot = Spot{shift, hard ? angle : angle * others.in(.5, 1), angle};
    }
    Dice paint = dice_of_paint(seed);
    const bool painted = has_others && paint.chance(.5);
    if (painted && paint.chance(.5)) scene.materials[0].rgb = random_paint(paint, size, shift);
    for (int y = 0; y < edge_rows; ++y)
        for (int x = 0; x < edge_columns; ++x) {
            const double u = (2. * x + 1) / edge_columns - 1, v = (2. * y + 1) / edge_rows - 1;
            DVec3 from = eye, way = unit(frame.forward + u * frame.tan_x * frame.right + v * frame.tan_y * frame.down);
            const double floor = (level - eye.z) / way.z;
            const int which = floor > 0 ? dice.upto(2) : 0;
            double t = floor * dice.in(.5, .9);
            if (which > 0) {
                from = eye + floor * way, t = size * dice.in(1, 3);
                way = which == 1 ? unit(lamp - from) : DVec3(way.x, way.y, -way.z);
            }
            if (!(floor > 0)) t = size * dice.in(3, 6);
            const DVec3 across = unit(cross(way, dice.direction())), along = unit(cross(across, dice.direction()));
            const double radius = size * dice.in(.02, .08);
            const DVec3 centre = from + t * way + radius * across;
            const double kind = dice.in(0, 1);
            if (painted && paint.chance(.4)) {
                scene.primitives.push_back({body_through(paint, from + t * way, way, radius), dull(0), {}});
                scene.materials.back().rgb = edge_paint(paint, radius, from + t * way);
                if (!paint.chance(.2)) continue;
                auto [mesh, pigment] = edge_paint_by_uv(paint, radius, from + t * way);
                scene.primitives.back().shape = mesh, scene.materials.back().rgb = pigment;
            } else if (has_others && others.chance(.6)) {
                if (others.chance(.4))
                    for (const auto& [shape, steps] : uneven_edge_bodies(others, from + t * way, way, radius))
                        scene.primitives.push_back({shape, dull(0), steps});
                else
                    for (const Shape& shape : edge_bodies(others, from + t * way, way, radius))
                        scene.primitives.push_back({shape, dull(0), {}});
            } else if (kind < .2) {  // where an end and the side meet, both of which face the ray
                const DVec3 out = unit(across - way), axis = unit(cross(cross(out, across - 2. * way), out));
                const DVec3 cap = from + t * way - radius * out;
                scene.primitives.push_back({Cylinder{cap - 6 * radius * axis, cap, radius}, dull(0), {}});
            } else if (kind < .3) {  // the middle of an end, where a highlight begins at once
                const DVec3 cap = from + t * way, axis = unit(cross(lamp - cap, dice.direction()));
                const double towards = axis.x * way.x + axis.y * way.y + axis.z * way.z;
                const DVec3 base = cap + (towards < 0 ? -6 : 6) * radius * axis;
                scene.primitives.push_back({Cylinder{base, cap, radius}, dull(0), {}});
                scene.materials.back().specular = .8, scene.materials.back().pow = 1;
            } else if (kind < .7)
                scene.primitives.push_back({Sphere{centre, radius}, dull(0), {}});
            else
                scene.primitives.push_back(
                    {Cylinder{centre - 3 * radius * along, centre + 3 * radius * along, radius}, dull(0), {}});
        }
    return scene;
}

}  // namespace strahl::proof
