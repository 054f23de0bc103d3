// Reads the pictures of patterns, each file once.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "pov/language/interpreter.h"
#include "pov/things/textures.h"
#include "text/reading/scene_files.h"

namespace strahl::pov {

class PictureReader {
  public:
    explicit PictureReader(ReadPixels read_pixels) : read_pixels(std::move(read_pixels)) {}
    /// Reads a picture from '{' to '}'; `of_colors`, not of heights or other values. `srgb`: assumed_gamma is srgb.
    std::shared_ptr<const ImageThing> read(Interpreter& in, bool of_colors, bool srgb);

    const ReadPixels read_pixels;  // perhaps empty

  private:
    struct LoadedPicture {
        std::shared_ptr<const FilePixels> pixels;
        std::string fault;
        std::shared_ptr<PictureFacts> facts = std::make_shared<PictureFacts>();
    };
    void load(Interpreter& in, ImageThing& image, bool of_colors, bool srgb, std::optional<double> gamma);

    std::map<std::string, LoadedPicture> files;  // so far, by their paths
    // Grey .png files by their paths, their encoding, -1 if they have none, and that of the scene.
    std::map<std::tuple<std::string, double, double>, LoadedPicture> grey_files;
};

}  // namespace strahl::pov
