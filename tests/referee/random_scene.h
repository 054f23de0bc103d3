// Small random scenes, each determined by its seed.
#pragma once
#include <cstdint>

#include "scene/scene.h"
#include "tests/referee/dice.h"

namespace strahl {

struct RandomScene {
    bool transparent = true;     // glass bodies, which may overlap or be nested
    bool transformed = true;     // primitives rotated, moved, scaled unevenly and mirrored
    bool lights = false;         // spots, parallel light and grids beside points, in half of the scenes fog
    bool patterns = false;       // half of the materials have one in place of their colour
    bool bumps = false;          // most materials have one
    bool normals = false;        // most materials have a normal map
    bool camera_inside = false;  // the eye is in at least one transparent body
    double any_kind = .2;        // share of bodies of any kind; the others are mostly spheres and cylinders
    int levels = 1;              // of composites in composites
};

/// 2 to 9 bodies, mostly spheres, planes and cylinders, of every kind of material, 1 to 4 lights, within about 4 of the
/// origin, seen by a camera anywhere around. Two bodies never share a surface (with probability 1).
Scene random_scene(std::uint64_t seed, const RandomScene& what = {});

/// A prism whose contours are curves, straight lines and both; they may cross each other.
Prism random_prism(Dice& dice);
/// A lathe that is closed, of such contours.
Lathe random_lathe(Dice& dice);
/// A blob of balls and lines, some of them stretched, and some that take away.
Blob random_blob(Dice& dice);
/// A sweep of either sort, through balls of one radius or of several.
SphereSweep random_sweep(Dice& dice);

}  // namespace strahl
