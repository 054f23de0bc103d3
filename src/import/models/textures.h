// Pictures of models as patterns.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scene/material.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// How a picture lies on a mesh: the place p = (u, v) of the mesh is where scale * p, turned by `degrees` from u to v,
/// plus `offset` is in the picture.
struct TexturePlace {
    DVec3 scale{1}, offset{0};
    double degrees = 0;
    bool clamped = false;  // it is there once, and `around` is the colour beside it
    Color around{0};
};

/// Reads pictures once each.
class Textures {
  public:
    Textures(ReadPixels read_pixels, std::vector<std::string>& warnings)
        : read_pixels(std::move(read_pixels)), warnings(warnings) {}

    /// Reads a picture; null, with a warning that begins with `where`, if it cannot be read.
    std::shared_ptr<const FilePixels> read(const std::string& path, const std::string& where);

    std::vector<std::string> files;  // that were read

  private:
    const ReadPixels read_pixels;
    std::vector<std::string>& warnings;
    std::map<std::string, std::shared_ptr<const FilePixels>> known;
};

/// Returns a picture by uv. `file` is its name in scenes. Colours are multiplied by `factor` unless it is 1.
Pattern picture_by_uv(const std::shared_ptr<const FilePixels>& pixels, const std::string& file,
                      const TexturePlace& place, const Color& factor = Color(1));

/// How opaque a surface is by a picture: value * factor or, with a limit above 0, wholly where that is at least the
/// limit and not at all elsewhere.
struct Opacity {
    std::shared_ptr<const FilePixels> pixels;
    bool of_colors = false;  // the brightness of the colours counts, not the alpha channel
    double factor = 1, limit = 0;
};
/// Returns a pigment that lets light through where it is not opaque.
Pigment partly_clear(const Pigment& opaque, const Opacity& opacity, const TexturePlace& place);

/// Makes a pigment of partly_clear() the opaque one again. Returns false if it is none.
bool make_opaque(Pigment& pigment);

}  // namespace strahl
