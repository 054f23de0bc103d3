// The block `motion`.
#pragma once
#include "text/reading/reader.h"
#include "text/reading/text_limits.h"

namespace strahl {

/// Reads `{ key { ... } ... }`.
Motion read_motion(Reader& reader, const TextLimits& limits, std::string_view word, Block& outer);

/// Reports a key that is not later than the one before; `at` are their times in the text.
void require_rising(Diagnostics& diagnostics, double before, double time, std::string_view before_at,
                    std::string_view at);

}  // namespace strahl
