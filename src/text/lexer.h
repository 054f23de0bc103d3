// The letters of scene text: words, numbers, signs, and what stands between them.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "text/messages.h"

namespace strahl {

/// Thrown after a fault was noted at which the text can't be followed; caught where parsing can go on.
struct ParseAbort {};

/// A number and the slice of text it was read from.
struct Number {
    double value;
    std::string_view at;
};

/// Walks over a text. Every function first steps over white space and comments.
class Lexer {
  public:
    Lexer(std::string_view text, Diagnostics& diagnostics)
        : next(text.data()), end(text.data() + text.size()), diagnostics(diagnostics) {}

    /// The next character, 0 at the end of the text.
    char peek() {
        skip_space();
        return next < end ? *next : '\0';
    }
    bool accept(char c) {
        if (peek() != c) return false;
        ++next;
        return true;
    }
    bool at_end() {
        skip_space();
        return next == end;
    }
    /// A word, or an empty slice if none comes.
    std::string_view word();
    /// `name` and `block` say in messages what the number is for.
    Number number(std::string_view name, std::string_view block) {
        Number result;
        if (!read_number(result)) fail("a number expected for " + quoted(name) + " of " + quoted(block));
        return result;
    }
    /// What comes next, for messages: a word, a number, or one sign.
    std::string_view token();
    /// Back to a slice that was read.
    void rewind(std::string_view to) { next = to.data(); }

    /// Notes "`message`, but here comes ..." at the next token, and throws ParseAbort.
    [[noreturn]] void fail(const std::string& message);

    /// Goes on to the next of `words` (to any word, if there are none) or to the closing brace of the block we are in,
    /// over whole blocks that stand in between, but not over the start of a block of the top level.
    void skip_to(std::span<const std::string_view> words, std::span<const std::string_view> blocks);

  private:
    void skip_space() {
        while (next < end) {
            const char c = *next;
            if (c == ' ' || (c >= '\t' && c <= '\r'))
                ++next;
            else if (c != '/' || !skip_comment())
                return;
        }
    }
    bool skip_comment();
    bool read_number(Number& number);

    const char* next;
    const char* end;
    Diagnostics& diagnostics;
};

bool contains(std::span<const std::string_view> words, std::string_view word);

}  // namespace strahl
