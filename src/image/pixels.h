// Reads pictures as patterns of a scene.
#pragma once
#include <string>

#include "files/error.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// Reads a picture file (see read_picture) of grey values or colours. Throws FileError, also if it is wider or higher
/// than 32768 pixels, or has values below 0 or above 1e9.
FilePixels read_pixels(const std::string& path);

}  // namespace strahl
