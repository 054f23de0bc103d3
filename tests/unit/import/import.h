// Shared by the tests of imported scenes.
#pragma once
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "import/import.h"
#include "tests/unit/faults.h"
#include "text/parse.h"
#include "text/write.h"

namespace strahl::importing {

inline const std::string view = "v\nfrom 2 1 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 0\nresolution 512 256\n";
inline const std::string eye =
    "BEGIN_SCENE RESOLUTION 400 200\nCAMERA ZOOM 2 ASPECTRATIO 1 ANTIALIASING 0 RAYDEPTH 7\n"
    "CENTER 1 2 -9 VIEWDIR 0 0 1 UPDIR 0 1 0 END_CAMERA\n";
inline const std::string white = "TEXTURE AMBIENT 0 DIFFUSE 1 SPECULAR 0 OPACITY 1 COLOR 1 1 1 TEXFUNC 0\n";

/// Imports a scene, and checks that it can be written and is the same when read again.
inline Imported imported(const std::string& text, const ImportLimits& limits = {}) {
    const Imported result = import_scene(text, "x", limits);
    CHECK(parse_scene(write_scene(result.scene), "x.rt") == result.scene);
    return result;
}

inline std::string message(const std::string& text, const ImportLimits& limits = {}) {
    return fault_of([&] { import_scene(text, "x", limits); }, "no error");
}
/// The first line of the message.
inline std::string fault(const std::string& text, const ImportLimits& limits = {}) {
    const std::string all = message(text, limits);
    return all.substr(0, all.find('\n'));
}

using Told = std::vector<std::string>;

template <class Kind>
Kind body(const Imported& scene, std::size_t i = 0) {
    REQUIRE(scene.scene.primitives.size() > i);
    REQUIRE(std::holds_alternative<Kind>(scene.scene.primitives[i].shape));
    return std::get<Kind>(scene.scene.primitives[i].shape);
}
inline Material material(const Imported& scene, std::size_t i = 0) {
    return scene.scene.materials.at(scene.scene.primitives.at(i).material);
}

}  // namespace strahl::importing
