// Numbers that follow tracks, as a scene says them.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "num/vec.h"
#include "scene/motion/track.h"

namespace strahl {

/// `track "NAME" 1.5`, or the number alone if this parameter follows no track.
std::string text_of(double value, const std::vector<Follow>& follows, std::string_view parameter, int component = 0);
/// `<track "NAME" 1.5, 0, 0>`
std::string text_of(const DVec3& value, const std::vector<Follow>& follows, std::string_view parameter);
/// What a motion of one key is: `translate <track "NAME" 1.5, 0, 0>`.
std::string step_text(const struct MotionKey& key);

}  // namespace strahl
