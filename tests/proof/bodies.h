// Bodies of random worlds for proofs besides balls and rods.
#pragma once
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "scene/scene.h"
#include "tests/referee/dice.h"

namespace strahl::proof {

inline DVec3 unit(const DVec3& v) { return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
inline DVec3 cross(const DVec3& a, const DVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Triangles that share a corner and sides, by themselves or as a mesh, flat ones or smooth.
inline std::vector<Shape> fan(Dice& dice, const DVec3& centre, double radius) {
    const int count = 1 + dice.upto(4);
    const bool flat = dice.chance(.2), closes = count > 2 && dice.chance(.5);
    const DVec3 x = dice.direction(), y = dice.direction();
    const double bent = dice.chance(.4) ? dice.in(.1, 1) : 0;
    const auto normal = [&] { return dice.in(.5, 2) * (unit(cross(x, y)) + bent * dice.direction()); };
    MeshData data;
    data.points.push_back(centre);
    for (int i = 0; i <= count; ++i) {
        const double angle = 1.2 * i;
        const DVec3 out = std::cos(angle) * x + std::sin(angle) * y;
        data.points.push_back(centre + dice.in(.5, 1.5) * radius * (flat ? out : unit(out + .5 * dice.direction())));
    }
    for (int i = 1; i <= count; ++i) data.triangles.push_back({0, i, i == count && closes ? 1 : i + 1});
    if (bent > 0) {
        data.corner_normals = data.triangles;
        for (std::size_t i = 0; i < data.points.size(); ++i) data.normals.push_back(normal());
    }
    if (dice.chance(.5)) return {Mesh{std::make_shared<const MeshData>(data), ""}};
    std::vector<Shape> triangles;
    const auto &p = data.points, &n = data.normals;
    for (const auto& [a, b, c] : data.triangles) {
        if (bent > 0)
            triangles.push_back(SmoothTriangle{p[a], p[b], p[c], n[a], n[b], n[c]});
        else
            triangles.push_back(Triangle{p[a], p[b], p[c]});
    }
    return triangles;
}
/// Scales what is around a place, or around 0, each axis by another factor.
inline std::vector<Transformation> uneven_steps(Dice& dice, const DVec3& around) {
    const Scale scale{dice.vector(.5, 2)};
    if (dice.chance(.3)) return {scale};
    std::vector<Transformation> steps{Translate{DVec3(0) - around}};
    if (dice.chance(.5)) steps.push_back(Rotate{dice.vector(-200, 200)});
    steps.push_back(scale);
    if (dice.chance(.5)) steps.push_back(Rotate{dice.vector(-200, 200)});
    steps.push_back(Translate{around});
    return steps;
}

/// A part of a composite: near its middle, through it, or half of space.
inline Shape random_part(Dice& dice, const DVec3& centre, double radius, bool may_be_half) {
    const DVec3 beside = centre + dice.in(0, .8) * radius * dice.direction();
    const double size = dice.in(.4, 1) * radius;
    const int kind = dice.upto(may_be_half ? 5 : 4);
    if (kind == 4) return Torus{beside, dice.direction(), .7 * size, .25 * size};
    if (kind == 0) return Sphere{beside, size};
    if (kind == 1) {
        Cuboid box{centre - size * dice.vector(.2, 1), centre + size * dice.vector(.2, 1)};
        if (dice.chance(.3)) box.corner.x = centre.x;  // a plane that others of these have, too
        return box;
    }
    const DVec3 along = dice.arrow(.3, 2) * radius;
    if (kind == 2) return Cylinder{beside - along, beside + along, .5 * size};
    if (kind == 3) return Cone{beside - along, size, beside + along, dice.chance(.5) ? 0 : .3 * size};
    return Plane{beside, beside + dice.direction() * radius, beside + dice.direction() * radius};
}
/// Makes a composite whose parts have this material or the next one.
inline Shape random_composite(Dice& dice, const DVec3& centre, double radius, int material, bool transformed,
                              bool inner = false) {
    const int operation = dice.upto(2);
    auto parts = std::make_shared<std::vector<Primitive>>();
    for (int i = 0; i <= 1 + dice.upto(inner ? 0 : 2); ++i) {
        const bool composite = !inner && dice.chance(.15);
        Primitive part{composite ? random_composite(dice, centre, radius, material, transformed, true)
                                 : random_part(dice, centre, radius, i > 0 && operation > 0),
                       material + dice.chance(.3),
                       {}};
        if (transformed && dice.chance(.3)) {
            part.transformations = {Translate{-centre}, Rotate{dice.vector(-200, 200)}, Scale{DVec3(dice.in(.7, 1.4))},
                                    Translate{centre}};
        }
        parts->push_back(part);
    }
    if (operation == 0) return Union{parts};
    if (operation == 1) return Intersection{parts};
    return Difference{parts};
}

/// One or several bodies around a centre. What touches something does so there, towards `out`.
inline std::vector<Shape> random_bodies(Dice& dice, const DVec3& centre, double radius, bool touches,
                                        const DVec3& out) {
    const int kind = dice.upto(4);
    if (kind == 0) return fan(dice, centre, radius);
    if (kind == 4) {
        const double minor = radius * (dice.chance(.2) ? dice.in(.5, .9) : dice.in(.1, .4)), major = radius - minor;
        return {Torus{centre + (touches ? radius : 0) * out, touches ? cross(out, dice.direction()) : dice.direction(),
                      major, minor}};
    }
    if (kind == 2) {
        const DVec3 cap = centre + radius * (touches ? dice.in(.3, 3) * out : dice.arrow(.3, 3));
        const double other = dice.chance(.5) ? 0 : dice.in(.1, 1) * radius;
        return {dice.chance(.5) ? Cone{centre, other, cap, radius} : Cone{centre, radius, cap, other}};
    }
    if (kind == 1) {
        const DVec3 size = radius * dice.vector(.1, 1);
        const Cuboid box{centre - size, centre + size};
        if (!touches) return {box};
        DVec3 beside = centre;  // another, with a face in the plane of one of its faces
        beside.x = box.opposite.x;
        return {box, Cuboid{beside, beside + radius * dice.vector(.1, 1)}};
    }
    const DVec3 normal = touches ? out : dice.direction();
    return {Disc{centre, normal, radius, dice.chance(.5) ? 0 : radius * dice.in(.1, .9)}};
}

/// Bodies of about this size that a ray from afar along `way` meets at `target` on an edge, up to rounding.
inline std::vector<Shape> edge_bodies(Dice& dice, const DVec3& target, const DVec3& way, double size) {
    const int kind = dice.upto(5);
    if (kind == 5) {  // where the surfaces of two parts cross
        const auto part = [&] { return Primitive{Sphere{target + size * dice.direction(), size}, 0, {}}; };
        const auto parts = std::make_shared<const std::vector<Primitive>>(std::vector<Primitive>{part(), part()});
        if (dice.chance(.5)) return {Difference{parts}};
        return {Intersection{parts}};
    }
    if (kind == 4) {  // its outermost circle, or where a plane touches it
        const DVec3 out = unit(cross(way, dice.direction())), beside = unit(cross(out, dice.direction()));
        const double minor = size * dice.in(.2, .8);
        if (dice.chance(.5)) return {Torus{target - size * out, beside, size - minor, minor}};
        const double far = size - minor;
        return {Torus{target - minor * out - far * beside, out, far, minor}};
    }
    if (kind == 2) {  // a cone that the ray meets at its apex or its rim, or along a line of its side
        const DVec3 axis = dice.direction(), rise = dice.in(.5, 3) * size * axis;
        const DVec3 out = size * unit(cross(axis, dice.direction()));
        if (dice.chance(.3)) return {Cone{target + rise, size, target, 0}};
        if (dice.chance(.5)) return {Cone{target - out, size, target - out + rise, dice.in(0, 2) * size}};
        const DVec3 along = dice.in(1, 3) * size * way, apex = target + along;
        const DVec3 aside = size * unit(cross(way, dice.direction()));
        const DVec3 tilted = unit(target - along + aside - apex);  // from the apex, half the angle away from the ray
        const double slant = dice.in(1, 4) * size, cosine = -(tilted.x * way.x + tilted.y * way.y + tilted.z * way.z);
        return {Cone{apex, 0, apex + slant * cosine * tilted, slant * std::sqrt(1 - cosine * cosine)}};
    }
    if (kind == 0) {  // a side of a triangle or of two, or a corner
        const DVec3 along = dice.chance(.2) ? way : dice.direction();
        const DVec3 a = target + dice.in(.2, 2) * size * along;
        const DVec3 b = dice.chance(.3) ? target : target - dice.in(.2, 2) * size * along;
        const Triangle one{a, b, target + dice.in(.2, 2) * size * dice.direction()};
        if (dice.chance(.2))
            return {SmoothTriangle{one.a, one.b, one.c, dice.direction(), dice.direction(), dice.direction()}};
        if (dice.chance(.5)) return {one};
        return {one, Triangle{b, a, target + dice.in(.2, 2) * size * dice.direction()}};
    }
    if (kind == 1) {  // a corner or an edge of a box, or its middle
        DVec3 from = target, to = target;
        for (int i = 0; i < 3; ++i) {
            const double way_to = dice.in(.2, 2) * size;
            const int where = dice.upto(3);
            if (where != 0) to[i] += way_to;
            if (where == 0 || where == 3) from[i] -= way_to;
        }
        return {Cuboid{from, to}};
    }
    const bool edge_on = dice.chance(.2);  // the ray is in its plane
    const DVec3 normal = edge_on ? unit(cross(way, dice.direction())) : dice.direction();
    const DVec3 out = edge_on ? way : unit(cross(normal, dice.direction()));
    const double hole = dice.chance(.5) ? 0 : dice.in(.1, .9) * size;
    return {Disc{target - (hole > 0 && dice.chance(.5) ? hole : size) * out, normal, size, hole}};
}

/// A body and the transformations that it is under.
struct Transformed {
    Shape shape;
    std::vector<Transformation> steps;
};
/// Returns such bodies, and balls and rods, scaled unevenly and turned: a ray that meets an edge still does so.
inline std::vector<Transformed> uneven_edge_bodies(Dice& dice, const DVec3& target, const DVec3& way, double size) {
    const Scale scale{dice.vector(.4, 2.5)};
    const Rotate rotate{{0, 0, dice.chance(.5) ? 0 : dice.in(-180, 180)}};
    const double angle = rotate.degrees.z * (std::numbers::pi / 180), c = std::cos(angle), s = std::sin(angle);
    const auto back = [&](const DVec3& v) { return DVec3{c * v.x + s * v.y, c * v.y - s * v.x, v.z} / scale.by; };
    const DVec3 own_target = back(target), own_way = unit(back(way));
    const DVec3 across = unit(cross(own_way, dice.direction())), along = unit(cross(across, dice.direction()));
    const double kind = dice.in(0, 1);
    std::vector<Shape> shapes;
    if (kind < .25) {
        shapes = {Sphere{own_target + size * across, size}};
    } else if (kind < .4) {
        const DVec3 centre = own_target + size * across;
        shapes = {Cylinder{centre - 3 * size * along, centre + 3 * size * along, size}};
    } else if (kind < .5) {  // its rim
        const DVec3 cap = own_target - size * across;
        shapes = {Cylinder{cap - 3 * size * along, cap, size}};
    } else {
        shapes = edge_bodies(dice, own_target, own_way, size);
    }
    std::vector<Transformed> bodies;
    for (const Shape& shape : shapes) bodies.push_back({shape, {scale, rotate}});
    return bodies;
}

}  // namespace strahl::proof
