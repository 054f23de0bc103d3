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
    bool own_shadow = false;           // needs that copy
    std::vector<std::string> hides{};  // the words for where the body is not shown
    std::string ior{};                 // ior of a transparent material, and how light fades in it
    std::string weight{};      // of the finish keyword `refraction`, about which POV-Ray warns; empty if it is not used
    bool layered = false;      // has two layers of texture
    bool patterned = false;    // has a pattern, which moves with the body
    bool grouped = false;      // has lights of its own, or is not lit by all
    bool lost_shares = false;  // mixes materials by several patterns, of which one is written
    bool near_one = false;     // an ior of 1 is written as the next larger number
};

/// Returns the materials in the order of scene.materials. `depth` is the number of generations of rays; `scaled` says
/// that lengths are multiplied by Unit.
std::vector<PovMaterial> pov_materials(const Scene& scene, int depth, bool scaled);

/// Returns the texture of a part of a transparent body that has one interior. POV-Ray takes the weight of the keyword
/// `refraction` for the interior's, so all parts have the same, or none.
std::string part_texture(const Material& material, const std::string& weight, const std::string& indent);
/// Returns the texture of a copy that only casts a transparent shadow.
std::string shadow_texture(const Material& material, const std::string& indent);

}  // namespace strahl
