// What a body is called in POV-Ray: its kind's words and arguments.
#pragma once
#include <string>

#include "num/decimal.h"
#include "scene/kinds.h"

namespace strahl {

/// An object without its closing brace, in the shape's own space.
inline std::string sentence(const Shape& shape) {
    const auto join = [](const char* keyword, const auto& first, const auto&... more) {
        return keyword + (" { " + text_of(first)) + (... + (", " + text_of(more)));
    };
    return std::visit([&](const auto& kind) { return std::apply(join, kind.pov()); }, shape);
}

}  // namespace strahl
