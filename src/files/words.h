// Words and lines of files, for readers and for messages.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace strahl {

/// The white space of the C locale.
inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
/// The small letter of an ASCII letter; other characters stay as they are.
inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
/// Does a word of a scene begin with this character: an ASCII letter or an underscore?
inline bool is_letter(char c) { return (lower(c) >= 'a' && lower(c) <= 'z') || c == '_'; }
/// Are these the same, regardless of case?
bool same_word(std::string_view a, std::string_view b);

/// Watches a reader, whose every function calls moves() with its place in the text. So no fault of a reader can make it
/// read for ever.
class ForwardGuard {
  public:
    /// False if the reader was called 10,000 times and never came further than before.
    bool moves(const char* place) {
        if (place > furthest) return furthest = place, calls = 0, true;
        return ++calls < 10'000;
    }

  private:
    const char* furthest = nullptr;
    int calls = 0;
};

/// Reads a whole word as a number; false if it is not one, or too large or too small for a double. "inf" and "nan" are
/// numbers, and a "+" may come first.
bool read_number(std::string_view word, double& number);

/// The line of a position in a text, counted from 1. Lines end in a line feed, a carriage return, or both.
std::size_t line_number(std::string_view text, std::size_t at);

/// A slice in quotes, shortened if long, safe to print.
std::string quoted(std::string_view slice);

/// Words in a row, with `between` between each two.
template <class Words>
std::string listed(const Words& words, const char* between = ", ") {
    std::string list;
    bool first = true;
    for (const std::string_view word : words) list.append(first ? "" : between).append(word), first = false;
    return list;
}

}  // namespace strahl
