#include "text/blocks/follow_text.h"

#include <algorithm>

#include "num/decimal.h"
#include "scene/motion/transformation.h"

namespace strahl {

std::string text_of(double value, const std::vector<Follow>& follows, std::string_view parameter, int component) {
    const auto own = std::ranges::find_if(
        follows, [&](const Follow& f) { return f.parameter == parameter && f.component == component; });
    return own == follows.end() ? text_of(value) : "track \"" + own->track + "\" " + text_of(value);
}

std::string text_of(const DVec3& value, const std::vector<Follow>& follows, std::string_view parameter) {
    std::string text = "<";
    for (int c = 0; c < 3; ++c) text += (c > 0 ? ", " : "") + text_of(value[c], follows, parameter, c);
    return text + ">";
}

std::string step_text(const MotionKey& key) {
    const std::string& parameter = key.follows.front().parameter;
    const DVec3& value = parameter == "rotate" ? key.rotate : parameter == "scale" ? key.scale : key.translate;
    const auto same = [&](const Follow& f) { return f.track == key.follows[0].track && value[f.component] == value.x; };
    if (parameter == "scale" && key.follows.size() == 3 && std::ranges::all_of(key.follows, same))
        return "scale " + text_of(value.x, key.follows, parameter);
    return parameter + " " + text_of(value, key.follows, parameter);
}

}  // namespace strahl
