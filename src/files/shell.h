// Quotes words for shell scripts.
#pragma once
#include <string>

namespace strahl {

/// Returns the text in single quotes. A quote inside is written as POSIX shells and zsh read it, or as `quote_inside`
/// (fish: \').
inline std::string in_shell_quotes(const std::string& text, const char* quote_inside = "'\\''") {
    std::string all = "'";
    for (const char c : text) c == '\'' ? all += quote_inside : all += c;
    return all + "'";
}

}  // namespace strahl
