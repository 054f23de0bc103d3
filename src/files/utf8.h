// UTF-8: validity, the start of characters, and display.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace strahl {

/// Is this any byte of a character but the first?
inline bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The position of the first byte that is not UTF-8, or is 0; or npos.
std::size_t find_invalid(std::string_view text);

/// Moves `i` back or forth by `count` characters, but not past `end`.
std::size_t back(std::string_view text, std::size_t i, std::size_t end, int count);
std::size_t forth(std::string_view text, std::size_t i, std::size_t end, int count);

/// Part of a line, safe to print (tabs become four spaces), and the columns it takes on a terminal.
struct Shown {
    std::string text;
    int width = 0;
};
Shown show(std::string_view slice);

/// A text of several lines, safe to print.
std::string printable(std::string_view text);

}  // namespace strahl
