// The interface of proving kernels, which bound the errors of pictures: what they are given besides plain kernels'
// data.
#pragma once
#include <limits>

#include "trace/kernel/kernel.h"
#include "trace/world/eye.h"

namespace strahl {

/// Bounds how far a world's numbers are off those of the scene, which count as exact. Proving kernels count it as an
/// error of the ray. Infinite where nothing is known.
template <class T>
struct Slack {
    T share = 0;                   // of positions and lengths of bodies, relative to their sizes and distances from 0
    T turn = 0;                    // of directions: normals, axes, angles, rows of boxes and of spaces of their own
    T plane = 0;                   // of planes' distances from 0
    T eye_away = 0, eye_turn = 0;  // of camera rays: of their origin; of their direction, what is not measured
    Eye<T> eye_lacks{};            // exact numbers of the eye less computed ones, see camera_turn
    T gain = 1;                    // most by which bodies on its way multiply a light
    T reach = 0;                   // the largest coordinate of a bounded body
    T culled = 0;                  // `share` of the world in double, by whose positions culling goes
    bool medium = false;           // it is certain which bodies the eye is in
    bool fits() const { return culled <= 8 * std::numeric_limits<double>::epsilon(); }  // within the margins of culling
};

/// The limits and pixels that a proving kernel is given as those of a plain one, and casts back.
template <class T>
struct ProvingLimits : Limits<T> {
    Slack<T> slack{};
};
template <class T>
struct ProvingBatch : PixelBatch<T> {
    T* bounds = nullptr;  // by pixel: its sum is no further than this from that of exact arithmetic
};

/// Tag of proving kernels. There are none for float.
struct ForProofs;

}  // namespace strahl
