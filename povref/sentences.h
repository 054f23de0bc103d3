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
    const auto words = [&](const auto& kind) {
        std::string text = std::apply(join, kind.pov());
        if constexpr (requires { kind.pov_more; }) text += kind.pov_more;
        if constexpr (requires { kind.pov_axes(); }) {
            std::string rows;
            for (const DVec3& row : kind.pov_axes())
                for (int i = 0; i < 3; ++i) rows += (rows.empty() ? "" : ", ") + text_of(row[i]);
            text += " matrix <" + rows + ">";
        }
        return text;
    };
    return std::visit(words, shape);
}

}  // namespace strahl
