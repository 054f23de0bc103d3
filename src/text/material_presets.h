// Materials that the window gives a body with one click.
#pragma once
#include <array>
#include <string>

#include "text/body_text.h"

namespace strahl {

/// A material: its name for the user, and its values as scene text. `color` is a colour, as text, which some keep;
/// `size` is the length of a pattern's largest features, as text.
struct MaterialPreset {
    const char* name;
    std::string (*values)(const std::string& color, const std::string& size);
};
extern const std::array<MaterialPreset, 6> material_presets;

/// Returns the text in which a body with a place for its material has this one in place of its own. It keeps its colour
/// if the material has none. `size` is about half the body's size.
std::string with_material(const std::string& text, const BodyText& body, const MaterialPreset& preset, double size);

}  // namespace strahl
