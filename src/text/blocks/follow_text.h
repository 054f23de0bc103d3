// Writes numbers that follow tracks.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "num/vec.h"
#include "scene/motion/track.h"

namespace strahl {

/// Returns a number as scene text: `track "NAME" 1.5`, or the number alone if this parameter follows no track.
std::string text_of(double value, const std::vector<Follow>& follows, std::string_view parameter, int component = 0);
/// Returns a vector as scene text, as in `<track "NAME" 1.5, 0, 0>`.
std::string text_of(const DVec3& value, const std::vector<Follow>& follows, std::string_view parameter);
/// Returns a motion of one key as scene text, as in `translate <track "NAME" 1.5, 0, 0>`.
std::string step_text(const struct MotionKey& key);

}  // namespace strahl
