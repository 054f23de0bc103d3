// The blocks `global_settings`, `fog` and `music`.
#pragma once
#include <string_view>

#include "scene/scene.h"
#include "text/reading/reader.h"

namespace strahl {

Settings read_settings(Reader& reader, std::string_view word);
Fog read_fog(Reader& reader, std::string_view word);
Music read_music(Reader& reader, std::string_view word);

}  // namespace strahl
