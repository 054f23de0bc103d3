// Converts the coefficients of the illumination equation to POV-Ray textures.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// A material as POV-Ray statements. An opaque one is a `texture` of that name, a transparent one a `material`. If its
/// shadow is coloured while the view through it is not, there is also a texture NAME_Shadow, for a copy of the body
/// that only casts the shadow: POV-Ray has one colour for both.
struct PovMaterial {
    std::string name;
    std::string declaration{};
    bool transparent = false;
    bool own_shadow = false;  // needs that copy
    bool keyword = false;     // uses the finish keyword `refraction`, about which POV-Ray warns
    bool layered = false;     // has two layers of texture
    bool patterned = false;   // has a pattern, which moves with the body
    bool near_one = false;    // an ior of 1 is written as the next larger number
};

/// Returns the materials in the order of scene.materials. `depth` is the number of generations of rays.
std::vector<PovMaterial> pov_materials(const Scene& scene, int depth);

}  // namespace strahl
