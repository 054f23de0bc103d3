// The interface of the kernels that bound errors: what they want to know besides the plain ones, and where they are.
#pragma once
#include <limits>

#include "trace/kernel/kernel.h"
#include "trace/world/eye.h"

namespace strahl {

/// By how much a world's numbers may be off those of the scene, which are exact: proving kernels count it as an error
/// of the ray. Infinite: nothing is known.
template <class T>
struct Slack {
    T share = 0;                   // places and lengths of bodies, in their sizes and their distances from 0
    T turn = 0;                    // directions: normals, axes, angles, rows of boxes and of spaces of their own
    T plane = 0;                   // distances of planes from 0
    T eye_away = 0, eye_turn = 0;  // of camera rays: where they start; what is not measured of their directions
    Eye<T> eye_lacks{};            // what the eye's numbers lack, which is measured: see camera_turn
    T gain = 1;                    // most by which bodies on its way multiply a light
    T reach = 0;                   // the largest coordinate of a bounded body
    T culled = 0;                  // share of a world in double: culling takes bodies to be where that has them
    bool medium = false;           // it is certain in what the eye is
    bool fits() const { return culled <= 8 * std::numeric_limits<double>::epsilon(); }  // into the margins of culling
};

/// The limits and pixels of a proving kernel, which takes those of a plain one to be these.
template <class T>
struct ProvingLimits : Limits<T> {
    Slack<T> slack{};
};
template <class T>
struct ProvingBatch : PixelBatch<T> {
    T* bounds = nullptr;  // no pixel's sum is further than this from that of exact arithmetic
};

/// The purpose of proving kernels. There are none for float.
struct ForProofs;

}  // namespace strahl
