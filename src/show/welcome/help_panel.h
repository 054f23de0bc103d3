// The help on keys: one page, which typing searches.
#pragma once
#include <string>

#include "show/keys/key_map.h"

namespace strahl {

/// Draws the help on those keys that the typed words find, in as many columns as let its letters be largest. To be
/// called while ImGui makes a frame.
void draw_help(const KeyMap& keys, const std::string& typed);

}  // namespace strahl
