#include "text/transformations.h"

#include "num/decimal.h"
#include "scene/motion.h"

namespace strahl {

Transformation read_transformation(Reader& reader, std::string_view word, Block& block) {
    DVec3 v{0};
    if (word == "rotate") return reader.read(v, anything, word, block), Rotate{v};
    if (word == "translate") return reader.read(v, coordinates, word, block), Translate{v};
    Scale scale;
    return reader.read(scale, anything, word, block), scale;
}

std::string text_of(const Motion& motion, const std::string& new_line) {
    const std::string inner = new_line + (new_line == " " ? "" : "  ");
    std::string text = "motion {";
    for (const MotionKey& key : motion.keys) {
        text.append(inner).append("key { time ").append(text_of(key.time));
        for (const Transformation& step : steps_of(key)) text.append("  ").append(text_of(step));
        text += " }";
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
