#include "main/commands/scene_file.h"

#include <filesystem>

#include "files/read_file.h"
#include "image/pixels.h"
#include "scene/error.h"
#include "text/parse.h"

namespace strahl {

std::string example_scene() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path scene = program.parent_path().parent_path() / "share/strahl/scenes/demo.rt";
    if (std::filesystem::is_regular_file(scene, error)) return scene.string();
    throw UsageError("SCENE is required\nSee: strahl view --help");
}

Scene load_scene(const std::string& path) { return parse_scene(read_text(path), shown_name(path), {}, read_pixels); }

}  // namespace strahl
