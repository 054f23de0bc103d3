#include "files/words.h"

#include <algorithm>
#include <charconv>

#include "files/utf8.h"

namespace strahl {

bool same_word(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

bool read_number(std::string_view word, double& number) {
    const char* start = word.data();
    const char* const end = start + word.size();
    if (word.size() > 1 && *start == '+' && start[1] != '-') ++start;
    const auto [stop, fault] = std::from_chars(start, end, number);
    return stop == end && fault == std::errc();
}

std::size_t line_number(std::string_view text, std::size_t at) {
    std::size_t line = 1;
    for (std::size_t i = 0; i < at; ++i)
        line += text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
    return line;
}

std::string quoted(std::string_view slice) {
    const std::size_t end = forth(slice, 0, slice.size(), 40);
    return std::string("'") + show(slice.substr(0, end)).text + (end < slice.size() ? "..." : "") + "'";
}

}  // namespace strahl
