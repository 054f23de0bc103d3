// Reads scene text word by word: words, numbers and signs, without white space and comments.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "files/utf8.h"
#include "text/reading/messages.h"

namespace strahl {

/// Thrown after an error at which parsing cannot continue; caught where it can.
struct ParseAbort {};

/// A number and the slice of text that it was read from.
struct Number {
    double value;
    std::string_view at;
};

/// Reads a text from start to end. Every function first skips white space and comments.
class Lexer {
  public:
    Lexer(std::string_view text, Diagnostics& diagnostics)
        : begin(text.data()), next(text.data()), end(text.data() + text.size()), diagnostics(diagnostics) {}

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
    /// Does a number or a vector come next, perhaps after a comma?
    bool at_value() {
        const char c = peek();
        return c == ',' || c == '<' || c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9');
    }
    bool at_end() {
        skip_space();
        return next == end;
    }
    /// The next word, or an empty slice if something else comes.
    std::string_view word();
    /// Reads a number; `name` and `block` are for messages.
    Number number(std::string_view name, std::string_view block) {
        Number result;
        if (!read_number(result)) fail("a number expected for " + quoted(name) + " of " + quoted(block));
        return result;
    }
    /// Reads a text in quotes, and returns it without them; `what` is for messages.
    std::string_view quotation(const std::string& what);
    /// The next token, which stays the next: a word, a number, or one sign.
    std::string_view token();
    /// Goes back to a slice that was read.
    void rewind(std::string_view to) { next = to.data(); }

    /// Adds the error "`message`, but found ...", with advice on the sign found, at the next token; throws ParseAbort.
    [[noreturn]] void fail(const std::string& message);

    /// Skips to the next of `words` (if there are none: to any word) or to the closing brace of the current block.
    /// Skips whole blocks on the way, but not the start of a top-level block.
    void skip_to(std::span<const std::string_view> words, std::span<const std::string_view> blocks);

  private:
    void skip_space() {
        if (!guard.moves(next)) stop();
        while (next < end) {
            const char c = *next;
            if (is_space(c))
                ++next;
            else if (std::string_view(next, end).starts_with(byte_order_mark))  // texts were joined
                next += byte_order_mark.size();
            else if (c != '/' || !skip_comment())
                return;
        }
    }
    bool skip_comment();
    [[noreturn]] void stop();
    bool read_number(Number& number);

    const char* const begin;
    const char* next;
    const char* end;
    ForwardGuard guard;
    Diagnostics& diagnostics;
};

bool contains(std::span<const std::string_view> words, std::string_view word);

}  // namespace strahl
