#include "files/utf8.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "files/error.h"

namespace strahl {
namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";  // U+FFFD

struct Character {
    std::uint32_t code;
    int bytes;
    bool valid;
};

/// Decodes the character that starts at text[i], strictly as in the Unicode standard, table 3-7.
Character decode(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
        return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0;
    };
    const std::uint32_t first = byte(0);
    if (first < 0x80) return {first, 1, first != 0};
    const int bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    std::uint32_t code = first & (0xFF >> (bytes + 1));
    for (int k = 1; k < bytes; ++k) {
        if ((byte(k) & 0xC0) != 0x80) return {0, 1, false};
        code = code << 6 | (byte(k) & 0x3F);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    const bool valid = first >= 0xC2 && first <= 0xF4 && code >= least[bytes] && code <= 0x10FFFF &&
                       !(code >= 0xD800 && code <= 0xDFFF);
    return valid ? Character{code, bytes, true} : Character{0, 1, false};
}

/// Is it a character that controls a terminal or the direction of writing?
bool steers(std::uint32_t c) {
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x200E && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) ||
           (c >= 0x2066 && c <= 0x2069);
}

/// Columns a character takes on a terminal: 0 for marks that combine, 2 for East Asian and pictorial ones.
int columns(std::uint32_t c) {
    const auto in = [c](std::uint32_t low, std::uint32_t high) { return c >= low && c <= high; };
    if (in(0x300, 0x36F) || in(0x200B, 0x200D) || in(0x20D0, 0x20FF) || in(0xFE00, 0xFE0F)) return 0;
    return in(0x1100, 0x115F) || in(0x2E80, 0xA4CF) || in(0xAC00, 0xD7A3) || in(0xF900, 0xFAFF) || in(0xFE30, 0xFE6F) ||
                   in(0xFF00, 0xFF60) || in(0xFFE0, 0xFFE6) || in(0x1F300, 0x1FAFF) || in(0x20000, 0x3FFFD)
               ? 2
               : 1;
}

/// The name of an encoding whose units have two bytes or four, or "". Without a mark such a text is recognised by the
/// bytes 0 of its first characters, if these are ASCII.
std::string wide_encoding(std::string_view bytes) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv)) return "UTF-32";
    if (bytes.starts_with("\xFF\xFE"sv) || bytes.starts_with("\xFE\xFF"sv)) return "UTF-16";
    const auto zeros = [&](std::string_view pattern) {  // of which x is any other byte
        return bytes.size() >= pattern.size() && std::ranges::equal(bytes.substr(0, pattern.size()), pattern, {},
                                                                    [](char c) { return c == '\0' ? '0' : 'x'; });
    };
    if (zeros("x000x000") || zeros("000x000x")) return "UTF-32";
    return zeros("x0x0") || zeros("0x0x") ? "UTF-16" : "";
}

}  // namespace

std::string_view utf8_text(std::string_view bytes, std::string_view file) {
    if (const std::string encoding = wide_encoding(bytes); !encoding.empty())
        throw FileError(show(file).text + ": this text is in " + encoding + "; save the file as UTF-8");
    while (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
    return bytes;
}

Shown show(std::string_view slice) {
    Shown shown;
    for (std::size_t i = 0; i < slice.size();) {
        const Character c = decode(slice, i);
        if (slice[i] == '\t') {
            shown.text += "    ";
            shown.width += 4;
        } else if (!c.valid || steers(c.code)) {
            shown.text += replacement;
            shown.width += 1;
        } else {
            shown.text += slice.substr(i, c.bytes);
            shown.width += columns(c.code);
        }
        i += c.bytes;
    }
    return shown;
}

std::string printable(std::string_view text) {
    std::string result;
    while (true) {
        const std::size_t end = text.find('\n');
        result += show(text.substr(0, end)).text;
        if (end == text.npos) return result;
        result += '\n';
        text.remove_prefix(end + 1);
    }
}

std::size_t back(std::string_view text, std::size_t i, std::size_t end, int count) {
    while (count-- > 0 && i > end) do
            --i;
        while (i > end && continues(text[i]));
    return i;
}
std::size_t forth(std::string_view text, std::size_t i, std::size_t end, int count) {
    while (count-- > 0 && i < end) do
            ++i;
        while (i < end && continues(text[i]));
    return i;
}

std::size_t find_invalid(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        if (static_cast<signed char>(text[i]) > 0) {  // ASCII; on some processors char has no sign
            ++i;
            continue;
        }
        const Character c = decode(text, i);
        if (!c.valid) return i;
        i += c.bytes;
    }
    return text.npos;
}

}  // namespace strahl
