// Pictures of models as patterns.
#pragma once
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scene/material.h"
#include "text/reading/opacity.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// How a picture lies on a mesh: the place p = (u, v) of the mesh is where scale * p, turned by `degrees` from u to v,
/// plus `offset` is in the picture.
struct TexturePlace {
    DVec3 scale{1}, offset{0};
    double degrees = 0;
    bool clamped = false;  // it is there once, and `around` is the colour beside it
    Color around{0};
    std::array<ImageWrap, 2> wrap{};  // what is beyond its edges, if it is not `clamped`
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

/// Returns a picture by uv. `file` is its name in scenes, which it keeps if its colours are multiplied by 1 and it is
/// opaque or `clear` says that partly_clear() is to make it so.
Pattern picture_by_uv(const std::shared_ptr<const FilePixels>& pixels, const std::string& file,
                      const TexturePlace& place, const Color& factor = Color(1), bool clear = false);

/// Returns a pigment that lets light through where the picture of `opacity` at this place is not opaque.
Pigment partly_clear(const Pigment& opaque, Opacity opacity, const TexturePlace& place);

}  // namespace strahl
