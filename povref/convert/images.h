// Converts the pictures of a scene to POV-Ray image maps.
#pragma once
#include <string>

#include "image/picture.h"
#include "scene/scene.h"

namespace strahl {

/// A picture file beside the .pov.
struct PovPicture {
    std::string name;
    Picture picture;
};
/// Returns the pictures that the scene's patterns name: as 16-bit .png with unchanged values, or as .exr if they are
/// floats (POV-Ray reads floats rounded to 11 bits).
std::vector<PovPicture> pictures_of(const Scene& scene);

/// Returns the content of `pigment { }` without transformations. `more` follows each colour, such as " transmit 0.5".
/// With `as_it_is` pixels are values instead of colours, and get no transfer curve.
std::string image_text(const ImagePattern& image, const std::string& more, bool as_it_is = false);

/// Returns the macro that the result of image_text() calls.
std::string image_macro(double gamma);
/// Returns the word for a scene's `assumed_gamma`: srgb for values that are shown as they are.
std::string gamma_word(double gamma);

}  // namespace strahl
