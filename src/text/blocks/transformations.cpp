#include "text/blocks/transformations.h"

#include "num/decimal.h"
#include "scene/moving_scene.h"
#include "text/blocks/follow_text.h"

namespace strahl {

Transformation read_transformation(BlockReader& reader, std::string_view word, Block& outer, bool follows) {
    MotionKey key;
    Block block{outer.name};
    if (follows) block.follows = &key.follows;
    Scale scale;
    if (word == "rotate") reader.read(key.rotate, anything, word, block);
    if (word == "translate") reader.read(key.translate, coordinates, word, block);
    if (word == "scale") reader.read(scale, anything, word, block);
    outer.absorb(block);
    key.scale = scale.by;
    if (!key.follows.empty()) return Motion{{std::move(key)}};
    if (word == "rotate") return Rotate{key.rotate};
    if (word == "translate") return Translate{key.translate};
    return scale;
}

std::string text_of(const Motion& motion, const std::string& new_line) {
    if (motion.keys.size() == 1) return step_text(motion.keys.front());
    const std::string inner = new_line + (new_line == " " ? "" : "  ");
    std::string text = "motion {";
    for (const MotionKey& key : motion.keys) {
        text.append(inner).append("key { time ").append(text_of(key.time));
        for (const Transformation& step : steps_of(key)) text.append("  ").append(text_of(step));
        text += (key.ease == 0 ? "" : "  ease " + text_of(key.ease)) + " }";
    }
    return text.append(new_line).append("}");
}

std::string text_of(const Transformation& step) {
    struct {
        std::string operator()(const Rotate& r) const { return "rotate " + text_of(r.degrees); }
        std::string operator()(const Translate& t) const { return "translate " + text_of(t.by); }
        std::string operator()(const Scale& s) const {
            return "scale " + (s.by.x == s.by.y && s.by.y == s.by.z ? text_of(s.by.x) : text_of(s.by));
        }
        std::string operator()(const Motion& motion) const { return text_of(motion, " "); }
    } words;
    return std::visit(words, step);
}

}  // namespace strahl
