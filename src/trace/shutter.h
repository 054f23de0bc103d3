// The moments of a shutter: what is seen while it is open is the mean over the scene as it is at each of them.
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// Returns the moments of a shutter that is open for `seconds` around a time: 128, or where bodies move in scenes of
/// many surfaces as few as 16. With n of them the share of the time for which a pixel shows something, once, is off by
/// at most 1 / 2n. Null if the shutter is closed or nothing moves.
std::shared_ptr<const std::vector<Shot>> shutter_moments(const Scene& scene, double time, double seconds,
                                                         const std::function<Camera(double time)>& camera);

}  // namespace strahl
