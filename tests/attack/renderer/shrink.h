// Makes a scene that shows a fault as small and plain as possible.
#pragma once
#include <functional>

#include "tests/attack/renderer/wild_scene.h"

namespace strahl {

/// Removes and rounds parts of the scene as long as `faulty` stays true.
WildScene shrunk(WildScene wild, const std::function<bool(const WildScene&)>& faulty);

}  // namespace strahl
