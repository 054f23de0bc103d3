// Reads words, numbers and comments.
#include "text/reading/lexer.h"

#include <algorithm>
#include <charconv>

#include "text/reading/advice.h"

namespace strahl {
bool contains(std::span<const std::string_view> words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool Lexer::skip_comment() {
    if (end - next < 2) return false;
    if (next[1] == '/') {
        next = std::find_if(next, end, [](char c) { return c == '\n' || c == '\r'; });
        return true;
    }
    if (next[1] != '*') return false;
    const std::string_view rest(next + 2, end - next - 2);
    const std::size_t close = rest.find("*/");
    if (close == rest.npos) {
        const std::string_view opening(next, 2);
        next = end;
        diagnostics.add(opening, "this comment is never closed: '*/' missing");
        diagnostics.check();  // all that follows is part of the comment
    }
    next += 2 + close + 2;
    return true;
}

void Lexer::stop() {
    diagnostics.add({next, 0}, "this text cannot be read further than here");
    diagnostics.check();
    throw ParseAbort{};  // check() has thrown
}

std::string_view Lexer::word() {
    skip_space();
    const char* p = next;
    if (p < end && is_letter(*p)) do
            ++p;
        while (p < end && (is_letter(*p) || is_digit(*p)));
    const std::string_view result(next, p - next);
    next = p;
    return result;
}

bool Lexer::read_number(Number& number) {
    skip_space();
    const char* p = next;
    if (p < end && *p == '+') ++p;
    // from_chars also accepts "inf" and "nan", and a second sign.
    const char* const digits = p < end && *p == '-' && p == next ? p + 1 : p;
    if (digits == end || !(is_digit(*digits) || (*digits == '.' && digits + 1 < end && is_digit(digits[1]))))
        return false;
    auto [stop, range] = std::from_chars(p, end, number.value);
    number.at = {next, static_cast<std::size_t>(stop - next)};
    if (stop < end && (is_letter(*stop) || is_digit(*stop) || *stop == '.')) {
        while (stop < end && (is_letter(*stop) || is_digit(*stop) || *stop == '.')) ++stop;
        const std::string_view whole(next, stop - next);
        next = stop;
        diagnostics.add(whole, quoted(whole) + " is not a number");
        throw ParseAbort{};
    }
    if (range == std::errc::result_out_of_range) {
        diagnostics.add(number.at, quoted(number.at) + " is out of the range of numbers (4.9e-324 to 1.8e308)");
        number.value = 1;
    }
    next = stop;
    return true;
}

std::string_view Lexer::quotation(const std::string& what) {
    if (peek() != '"') fail(what + " in quotes expected");
    const char* const close = std::find_if(next + 1, end, [](char c) { return c == '"' || c == '\n' || c == '\r'; });
    if (close == end || *close != '"') {
        diagnostics.add({next, 1}, "these quotes are not closed on the same line");
        throw ParseAbort{};
    }
    const std::string_view text(next + 1, close - next - 1);
    next = close + 1;
    return text;
}

std::string_view Lexer::token() {
    skip_space();
    const char* p = next;
    if (p < end && (*p == '-' || *p == '+')) ++p;
    while (p < end && (is_letter(*p) || is_digit(*p) || *p == '.')) ++p;
    if (p == next && p < end) do
            ++p;
        while (p < end && (static_cast<unsigned char>(*p) & 0xC0) == 0x80);
    return {next, static_cast<std::size_t>(p - next)};
}

void Lexer::fail(const std::string& message) {
    const std::string_view here = token();
    const std::string sign = here == "\u00A0" ? "a no-break space" : quoted(here);
    std::string found = here.empty() ? ", but the text ends" : ", but found " + sign;
    const auto size = static_cast<std::size_t>(end - begin), at = static_cast<std::size_t>(here.data() - begin);
    if (const std::string advice = advice_on_sign({begin, size}, at); !advice.empty()) found += "; " + advice;
    diagnostics.add(here, message + found);
    throw ParseAbort{};
}

void Lexer::skip_to(std::span<const std::string_view> words, std::span<const std::string_view> blocks) {
    for (std::size_t depth = 0;;) {
        const char c = peek();
        if (next == end || (c == '}' && depth == 0)) return;
        if (const std::string_view w = word(); !w.empty()) {
            if ((depth == 0 && (words.empty() || contains(words, w))) ||
                (contains(blocks, w) && !contains(words, w) && peek() == '{'))
                return rewind(w);
            continue;
        }
        if (c == '{') ++depth;
        if (c == '}') --depth;
        ++next;
    }
}

}  // namespace strahl
