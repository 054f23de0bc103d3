#include "text/reading/scene_files.h"

#include <algorithm>
#include <filesystem>

#include "files/read_file.h"
#include "files/regular_file.h"
#include "mesh/read_mesh.h"
#include "text/reading/tracks_file.h"

namespace strahl {

std::string path_beside(const std::string& scene, const std::string& name) {
    // An absolute path replaces the folder.
    return (std::filesystem::path(scene).parent_path() / name).generic_string();
}

SceneFiles::SceneFiles(std::string_view scene, ReadPixels read_pixels)
    : scene(scene), read_pixels(std::move(read_pixels)) {}

std::shared_ptr<const MeshData> SceneFiles::mesh(std::string_view name) {
    const std::string path = path_beside(scene, *read.meshes.emplace(name).first);
    std::shared_ptr<const MeshData>& data = meshes[path];
    if (!data) data = std::make_shared<const MeshData>(read_mesh(path, {}, &read.warnings));
    return data;
}

std::shared_ptr<const FilePixels> SceneFiles::pixels(std::string_view name) {
    const std::string path = path_beside(scene, *read.pictures.emplace(name).first);
    if (!read_pixels) throw FileError("cannot read '" + path + "': pictures are not read here");
    std::shared_ptr<const FilePixels>& data = pictures[path];
    if (!data) data = std::make_shared<const FilePixels>(read_pixels(path));
    return data;
}

void SceneFiles::sound(std::string_view name) {
    const std::string path = path_beside(scene, *read.sounds.emplace(name).first);
    // The first page of Ogg, and in it the first header of Vorbis (xiph.org/vorbis/doc/Vorbis_I_spec.html, 4.2.1).
    const std::string head = RegularFile(path).bytes(0, 35);
    if (!head.starts_with("OggS") || head.substr(std::min<std::size_t>(28, head.size())) != "\1vorbis")
        throw FileError("'" + path + "' is not an Ogg Vorbis file");
}

std::vector<Track> SceneFiles::tracks() const {
    const std::string path = tracks_path(scene);
    std::error_code error;
    if (scene.empty() || !std::filesystem::exists(path, error)) return {};
    constexpr std::size_t limit = std::size_t(1) << 26;
    const RegularFile regular(path);  // throws for a pipe, which might never end
    return parse_tracks(read_text(path, limit), path);
}

}  // namespace strahl
