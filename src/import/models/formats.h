// The readers of models, by format.
#pragma once
#include "import/models/model.h"

namespace strahl {

Model read_mesh_model(const std::string& path, const ReadPixels& read_pixels);
/// Reads glTF 2.0, as text with files beside it or as one binary file, with meshes as they are at a time.
Model read_gltf(const std::string& path, const ReadPixels& read_pixels, double time);

/// Does the path have this ending, in capitals or not?
bool ends_with_word(std::string_view path, std::string_view ending);

}  // namespace strahl
