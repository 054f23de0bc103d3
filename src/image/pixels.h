// Pictures as patterns of a scene.
#pragma once
#include <string>

#include "scene/error.h"
#include "scene/image_pattern.h"

namespace strahl {

/// A .bmp, .png or .exr file, of grey values or colours. Throws FileError, also if it is wider or higher than 32768
/// pixels, if it has pixels that let what is behind them through, or values that no colour has.
Pixels read_pixels(const std::string& path);

}  // namespace strahl
