// Executes the directives of scene text: #declare, #for, #macro, #if, #include and the others of POV-Ray's language.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pov/language/interpreter_options.h"
#include "text/reading/messages.h"

namespace strahl::pov {

/// Does scene text have a directive?
bool has_directives(std::string_view text);

/// Scene text without directives, and where its parts come from.
struct ExpandedText {
    std::string text;
    std::vector<TextOrigin> origins;
    std::vector<std::string> files;                     // all that were read, the scene's first
    std::vector<std::unique_ptr<std::string>> sources;  // their texts and names, to which the origins refer
};

/// Executes the directives of scene text, and replaces expressions by their values. Throws FileError.
ExpandedText expand(std::string text, const InterpreterOptions& options);

}  // namespace strahl::pov
