// Moves cameras off the faces that they lie on.
#pragma once
#include "scene/scene.h"

namespace strahl {

/// Returns where a camera sees a flat surface whole or not at all that it lies on, or nearer to than `reach` along its
/// view: a hair from there, on the side that it looks to, the more if numbers are rounded by this share of bodies'
/// sizes. Elsewhere rounding would decide for each ray.
DVec3 off_faces(const Scene& scene, const Camera& camera, double reach, double rounding = 0);

}  // namespace strahl
