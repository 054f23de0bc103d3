// Small scenes made by hand, each for one possible error of a ray tracer.
#pragma once
#include <vector>

#include "scene/scene.h"

namespace strahl {

struct Example {
    const char* name;
    Scene scene;
    int depth;
};
std::vector<Example> examples();

/// Two mirrors that face each other with a ball between them, so that every generation of rays is visible.
Scene facing_mirrors();

}  // namespace strahl
