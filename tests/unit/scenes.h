// The scenes of the project.
#pragma once
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "files/read_file.h"
#include "image/pixels.h"
#include "scene/scene.h"
#include "text/parse.h"

namespace strahl {

/// Every scene under scenes/ as "crosscheck/ambient", sorted.
inline std::vector<std::string> scene_names() {
    namespace fs = std::filesystem;
    const fs::path root = fs::path(STRAHL_SOURCE) / "scenes";
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(root))
        if (entry.path().extension() == ".rt")
            names.push_back(fs::relative(entry.path(), root).replace_extension().generic_string());
    std::sort(names.begin(), names.end());
    return names;
}

inline Scene read_scene(const std::string& name) {
    const std::string path = std::string(STRAHL_SOURCE) + "/scenes/" + name + ".rt";
    return parse_scene(read_text(path), path, {}, read_pixels);
}

}  // namespace strahl
