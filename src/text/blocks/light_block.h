// Reads the block `light`.
#pragma once
#include <string_view>

#include "scene/light.h"
#include "text/reading/reader.h"
#include "text/reading/text_limits.h"

namespace strahl {

Light read_light(BlockReader& reader, const TextLimits& limits, std::string_view word);

}  // namespace strahl
