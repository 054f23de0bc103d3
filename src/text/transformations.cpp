#include "text/transformations.h"

#include "num/decimal.h"

namespace strahl {

Transformation read_transformation(Reader& reader, std::string_view word, Block& block) {
    DVec3 v{0};
    if (word == "rotate") return reader.read(v, anything, word, block), Rotate{v};
    if (word == "translate") return reader.read(v, coordinates, word, block), Translate{v};
    const std::string_view at = (reader.lexer.peek(), reader.lexer.token());
    if (reader.lexer.peek() == '<')
        reader.read(v, anything, word, block);
    else
        reader.read(v.x, anything, word, block), v.y = v.z = v.x;
    if (v.x == 0 || v.y == 0 || v.z == 0) {
        reader.diagnostics.add(
            at, "'scale' of " + quoted(block.name) + " is 0, which would leave nothing of it; 1 changes nothing");
        block.bad = true;
    }
    return Scale{v};
}

std::string text_of(const Transformation& step) {
    struct {
        std::string operator()(const Rotate& r) const { return "rotate " + text_of(r.degrees); }
        std::string operator()(const Translate& t) const { return "translate " + text_of(t.by); }
        std::string operator()(const Scale& s) const {
            return "scale " + (s.by.x == s.by.y && s.by.y == s.by.z ? text_of(s.by.x) : text_of(s.by));
        }
    } words;
    return std::visit(words, step);
}

}  // namespace strahl
