// Recognises and checks UTF-8, finds the start of characters, and makes text safe for a terminal.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace strahl {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Returns a text without the byte order mark that it may begin with. Throws FileError if the text is in UTF-16 or
/// UTF-32, with a mark of these or without one. `file` is for the message.
std::string_view utf8_text(std::string_view bytes, std::string_view file);

/// Is this a byte of a character other than the first?
inline bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// The position of the first byte that is not valid UTF-8 or is 0; npos if there is none.
std::size_t find_invalid(std::string_view text);

/// The position `count` characters before or after `i`, but not past `end`.
std::size_t back(std::string_view text, std::size_t i, std::size_t end, int count);
std::size_t forth(std::string_view text, std::size_t i, std::size_t end, int count);

/// A part of a line that is safe to print (tabs become four spaces), and its width in columns.
struct Shown {
    std::string text;
    int width = 0;
};
Shown show(std::string_view slice);

/// Makes a text of several lines safe to print.
std::string printable(std::string_view text);

}  // namespace strahl
