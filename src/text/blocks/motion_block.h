// Reads the block `motion`.
#pragma once
#include "text/reading/reader.h"
#include "text/reading/text_limits.h"

namespace strahl {

/// Words of a key in the text. Those of the time are empty slices if it is not given, and so on.
struct KeyWords {
    std::string_view key, time, scale{};
    bool up = false, sky = false;  // whether these are given
};

/// Reads `{ key { ... } ... }`.
Motion read_motion(BlockReader& reader, const TextLimits& limits, std::string_view word, Block& outer);

/// Reports a key that is not later than the one before; `before_at` and `at` are their times in the text.
void require_rising(Diagnostics& diagnostics, double before, double time, std::string_view before_at,
                    std::string_view at);

}  // namespace strahl
