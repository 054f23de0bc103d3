// Small scenes made by hand, each for one thing that a tracer can get wrong.
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

/// Two mirrors that face each other with a ball between them: every generation of rays shows.
Scene facing_mirrors();

}  // namespace strahl
