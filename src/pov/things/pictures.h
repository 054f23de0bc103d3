// The colours that POV-Ray finds in pictures.
#pragma once
#include <memory>

#include "pov/things/textures.h"

namespace strahl::pov {

/// Returns the light that an encoded value is, by a gamma, or 0 for sRGB.
double decoded(double value, double encoding);

/// Returns the colour of a picture at a point, in five results: red, green, blue, filter and transmit, as values of the
/// scene. Null if the picture could not be read.
std::shared_ptr<const FunctionThing> colors_of(const ImageThing& image);

/// Returns the values of a grey .png file as POV-Ray keeps them: as values of the scene, computed in single precision,
/// of which each is rounded down to a whole 255th.
std::shared_ptr<const FilePixels> grey_values_of(const ImageThing& image);

/// Returns the pixels that a scene with this assumed_gamma, or 0, decodes to the picture's values of the scene.
std::shared_ptr<const Pixels> shown_pixels(const ImageThing& image, double gamma);

/// Returns what bump_map adds to normals.
std::shared_ptr<const SolidFunction> bends_of(const ImageThing& image, double amount);

/// Returns the values of image_pattern: brightness or, with use_alpha, transparency.
std::shared_ptr<const SolidFunction> values_of(const ImageThing& image);

}  // namespace strahl::pov
