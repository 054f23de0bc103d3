// Attenuation of rays by fog.
#pragma once
#include <cmath>

#include "num/memory.h"
#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns the weights of rays that fog leaves after a distance `t`: weight * exp(-t / the fog's distance). In nested
/// worlds only rays outside all transparent bodies (medium 0) are dimmed. The fog's own light gets the weight that they
/// lose.
template <class S>
[[gnu::noinline]] S left_by_fog(const World<Element<S>>& world, const S& weight, const S& medium, const S& t) {
    alignas(64) Element<S> share[width<S>];
    store_lanes(share, t * S(-world.fog.per));
    for (auto& value : share) value = std::exp(value);
    const S left = weight * load_lanes<S>(share);
    return world.nested ? select(medium == S(0), left, weight) : left;
}

}  // namespace strahl::inline STRAHL_LEVEL
