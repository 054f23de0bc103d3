// Pictures of a scene as POV-Ray image maps.
#pragma once
#include <string>

#include "image/picture.h"
#include "scene/scene.h"

namespace strahl {

/// A file that stands beside the .pov.
struct PovPicture {
    std::string name;
    Picture picture;
};
/// Those that the scene's patterns name, as 16-bit .png with the values as they are, or as .exr if they are floats
/// (POV-Ray reads floats rounded to 11 bits).
std::vector<PovPicture> pictures_of(const Scene& scene);

/// What stands in `pigment { }` but for transformations. `more` follows each colour, such as " transmit 0.5"; pixels
/// that are no colours are taken as they are.
std::string image_text(const ImagePattern& image, const std::string& more, bool as_it_is = false);

/// The macro that these call.
std::string image_macro(bool linear);

}  // namespace strahl
