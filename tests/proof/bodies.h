// What random worlds for proofs have besides balls and rods.
#pragma once
#include <cmath>
#include <vector>

#include "scene/scene.h"
#include "tests/referee/dice.h"

namespace strahl::proof {

inline DVec3 unit(const DVec3& v) { return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
inline DVec3 cross(const DVec3& a, const DVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// One or several bodies around a centre. What touches something does so there, towards `out`.
inline std::vector<Shape> random_bodies(Dice& dice, const DVec3& centre, double radius, bool touches,
                                        const DVec3& out) {
    if (dice.chance(.5)) {
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

/// Bodies of about this size that a ray from afar along `way` meets at `target` on an edge, but for rounding.
inline std::vector<Shape> edge_bodies(Dice& dice, const DVec3& target, const DVec3& way, double size) {
    if (dice.chance(.5)) {  // a corner or an edge of a box, or its middle
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

}  // namespace strahl::proof
