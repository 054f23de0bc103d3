// Reads a text word by word: what NFF and Tachyon's format have in common. White space separates words, and a word that
// starts with # starts a comment to the end of the line.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "num/vec.h"

namespace strahl {

/// Are these the same, regardless of case?
bool same_word(std::string_view a, std::string_view b);

class WordReader {
  public:
    WordReader(std::string_view text, std::string_view file) : text(text), file(file) {}

    /// The next word, which stays the next; empty at the end of the text.
    std::string_view peek();
    /// Takes the next word, whatever it is; `what` is for the message if there is none.
    std::string_view take(const char* what);
    /// Takes the next word if it is this one.
    bool accept(std::string_view word);
    /// Takes the next word if it is one of these, and returns which; it is an error if it is none.
    std::string_view choose(std::initializer_list<std::string_view> words);
    void expect(std::string_view word) { choose({word}); }

    double number(const char* what);
    DVec3 vector(const char* what);
    /// Three numbers, none of them negative.
    Color color(const char* what);
    /// A whole number.
    long whole(const char* what, long low, long high);
    /// Does a number come next, on the line of the word taken last?
    bool number_in_line();

    /// The line of the word taken last, counted from 1.
    std::size_t line() const { return taken_line; }
    /// Throws FileError at the word taken last, or at the next one.
    [[noreturn]] void fail(const std::string& message);
    [[noreturn]] void fail_ahead(const std::string& message);

  private:
    /// Skips white space and comments.
    void skip();
    [[noreturn]] void fail_at(std::string_view at, const std::string& message) const;

    std::string_view text, file, taken;
    std::size_t next = 0, next_line = 1, taken_line = 1;
};

}  // namespace strahl
