// Imports scenes of other programs: E. Haines' Neutral File Format (NFF), and the format of J. Stone's Tachyon.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/picture_size.h"
#include "scene/scene.h"

namespace strahl {

struct Imported {
    Scene scene;
    std::optional<PictureSize> size;  // that the file asks for
    /// Features that the scene language lacks, as "file:line: feature; substitute", in the order of lines.
    std::vector<std::string> warnings;
};

/// Limits for one file; more than these is an error. Everything else is limited by the size of the text.
struct ImportLimits {
    std::size_t primitives = 5'000'000;  // triangles too; as many as scene text may hold
    std::size_t lights = 1 << 16;
};

/// Reads a scene; its first word decides the format. `file` is only the name used in messages. The scene can be written
/// as text and read again. Throws FileError, whose message says where the file is wrong.
Imported import_scene(std::string_view text, std::string_view file, const ImportLimits& limits = {});

}  // namespace strahl
