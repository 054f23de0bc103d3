// From scene text to Scene.
#pragma once
#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "scene/error.h"
#include "scene/scene.h"

namespace strahl {

/// Limits for one text; more is an error. Everything else is limited by the size of the text.
struct TextLimits {
    std::size_t primitives = 5'000'000;  // a float can number 2^24 surfaces, and a body has up to three
    std::size_t transformations = 1000;  // of one primitive
    std::size_t lights = 1 << 16;
    std::size_t keys = 1 << 20;
};

/// Reads the picture file at a path, which a scene names. Throws FileError. The program's own is in image/pixels.h.
using ReadPixels = std::function<Pixels(const std::string& path)>;

/// The files that a text names, as it names them; they are relative to the scene's folder.
struct FileNames {
    std::set<std::string> meshes, pictures, sounds;
};
std::string path_beside(const std::string& scene, const std::string& name);

/// Parses scene text (UTF-8). `file` is only the name used in messages. Throws FileError whose what() lists up to 10
/// errors, each as "file:line:column: message", the line itself, and a caret under the error. Columns count characters.
/// Without `read_pixels` it is an error to name a picture. `names` gets all that it names.
Scene parse_scene(std::string_view text, std::string_view file, const TextLimits& limits = {},
                  const ReadPixels& read_pixels = {}, FileNames* names = nullptr);

/// Reads a whole file, or standard input for "-". Throws FileError if it can't be read or is larger than `limit` bytes.
std::string read_text(const std::string& path, std::size_t limit = std::size_t(1) << 30);

}  // namespace strahl
