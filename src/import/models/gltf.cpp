#include "import/models/formats.h"
#include "scene/error.h"
namespace strahl {
Model read_gltf(const std::string& path, const ReadPixels&) { throw FileError(path + ": glTF is not read yet"); }
}  // namespace strahl
