// Reads the blocks `global_settings`, `fog` and `music`.
#pragma once
#include <string_view>

#include "scene/scene.h"
#include "text/reading/reader.h"

namespace strahl {

Settings read_settings(BlockReader& reader, std::string_view word);
Fog read_fog(BlockReader& reader, std::string_view word);
Music read_music(BlockReader& reader, std::string_view word);

}  // namespace strahl
