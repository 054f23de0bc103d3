// Bounds of the differences between a world, in double or in extended precision, and the scene that it is made of.
#pragma once
#include "trace/proof/proving_kernel.h"
#include "trace/world/build_world.h"
#include "trace/world/view.h"

namespace strahl {

/// Bounds the errors of the bodies that proofs know, those for whose kernels there is a span_bounds(), by making their
/// numbers once more in long double. Infinite where a body has motions.
template <class T>
Slack<T> slack_of(const Scene& scene, const Placement& placement);

/// Adds the errors of the camera's rays, which should go through the middles of pixels: a shift is an error as well.
template <class T>
void add_eye(Slack<T>& slack, const View& view, const Placement& placement);

/// Returns true if it is certain which transparent bodies a camera is in. It is not near their surfaces nor, if they
/// are not convex, in their boxes.
bool knows_medium(const Scene& scene, const DVec3& eye);

}  // namespace strahl
