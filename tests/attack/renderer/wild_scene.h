// Random scenes over the whole range of values that the language allows, each determined by its seed.
#pragma once
#include <cstdint>

#include "trace/tracer.h"

namespace strahl {

/// A valid scene, and how to look at it. Its bodies may be of any kind, touch, coincide, lie in one another, be tiny or
/// huge; there are one or hundreds of them.
struct WildScene {
    Scene scene;
    View view;
};
WildScene wild_scene(std::uint64_t seed);

}  // namespace strahl
