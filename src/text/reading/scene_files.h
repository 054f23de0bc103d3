// Reads the files that a scene names: meshes and pictures, each of them once.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/image_pattern.h"
#include "scene/kinds/mesh_data.h"
#include "scene/motion/track.h"

namespace strahl {

/// The pixels of a picture file, and how opaque each is, from 0 to 1. Without `opacity` all are.
struct FilePixels : Pixels {
    std::vector<float> opacity;
    std::optional<double> gamma;              // by which the file says that its values are encoded; 0 is sRGB
    bool from_right = false;                  // the file has the pixels of each row from right to left
    bool grey_png = false;                    // it is a .png file of one channel of at most 8 bits
    bool more_bits = false;                   // it has more than 8 bits a channel
    std::vector<std::array<int, 3>> palette;  // of a .png or .gif file whose pixels are numbers of colours, 0 to 255

    FilePixels() = default;
    FilePixels(Pixels pixels) : Pixels(std::move(pixels)) {}
};
/// Reads a picture file that a scene names. Throws FileError. The program's own function is in image/pixels.h.
using ReadPixels = std::function<FilePixels(const std::string& path)>;

/// The names of files as a scene gives them, relative to the scene's folder, and what of them is not read as it stands.
struct FilesRead {
    std::set<std::string> meshes, pictures, sounds;
    std::vector<std::string> warnings;
};
/// The path of a file that the scene at the path `scene` names.
std::string path_beside(const std::string& scene, const std::string& name);

/// Names are relative to the folder of the scene. All functions throw FileError.
class SceneFiles {
  public:
    SceneFiles(std::string_view scene, ReadPixels read_pixels);
    std::shared_ptr<const MeshData> mesh(std::string_view name);
    std::shared_ptr<const FilePixels> pixels(std::string_view name);
    /// Checks that it is an Ogg Vorbis file.
    void sound(std::string_view name);
    /// The tracks saved beside the scene; none if there is no such file.
    std::vector<Track> tracks() const;

    FilesRead read;  // so far

  private:
    const std::string scene;
    const ReadPixels read_pixels;
    std::map<std::string, std::shared_ptr<const MeshData>> meshes;  // by their paths
    std::map<std::string, std::shared_ptr<const FilePixels>> pictures;
};

}  // namespace strahl
