// Bodies, lights and materials that the window adds to a scene's text.
#pragma once
#include <array>
#include <string>

#include "num/vec.h"
#include "text/body_text.h"
#include "text/place_body.h"

namespace strahl {

/// A body or a light that can be added: its name for the user, which of the two it is, and how its block is written
/// where it stands on a surface at a point. The normal has length 1, and the size is that of half the body.
struct NewBlock {
    const char* name;
    TopBlock what;
    std::string (*block)(const DVec3& point, const DVec3& normal, double size, int decimals);
};
extern const std::array<NewBlock, 10> new_blocks;

/// Returns the text with the block of a new thing, which becomes the last body or light of the scene. `count` is how
/// many of these the text has. Numbers are rounded to so many decimals, see rounded().
std::string with_new_block(const std::string& text, const NewBlock& added, int count, const DVec3& point,
                           const DVec3& normal, double size, int decimals);

/// A material: its name for the user, and its values as scene text. Some take the body's `color`; `size` is the length
/// of a pattern's largest features. Both are scene text.
struct MaterialPreset {
    const char* name;
    std::string (*values)(const std::string& color, const std::string& size);
};
extern const std::array<MaterialPreset, 6> material_presets;

/// Returns the text in which a body with a place for its material has this one in place of its own. It keeps its colour
/// if the material has none. `size` is about half the body's size.
std::string with_material(const std::string& text, const BodyText& body, const MaterialPreset& preset, double size);

}  // namespace strahl
