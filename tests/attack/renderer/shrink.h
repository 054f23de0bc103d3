// Makes a scene that shows a fault as small and plain as possible.
#pragma once
#include <functional>

#include "tests/attack/renderer/wild_scene.h"

namespace strahl {

/// Removes and rounds whatever can go while `faulty` stays true.
WildScene shrunk(WildScene wild, const std::function<bool(const WildScene&)>& faulty);

}  // namespace strahl
