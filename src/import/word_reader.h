// Reads texts in NFF or Tachyon's format word by word. White space separates words; a word that starts with # begins a
// comment to the end of the line.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "files/words.h"
#include "num/vec.h"

namespace strahl {

class WordReader {
  public:
    WordReader(std::string_view text, std::string_view file) : text(text), file(file) {}

    /// The next word, which stays the next; empty at the end of the text.
    std::string_view peek();
    /// Takes the next word; `what` is for the message if there is none.
    std::string_view take(const char* what);
    /// Takes the next word if it is this one.
    bool accept(std::string_view word);
    /// Takes the next word, which must be one of these, and returns which.
    std::string_view choose(std::initializer_list<std::string_view> words);
    /// Takes the next word, which must be this one.
    void expect(std::string_view word) { choose({word}); }

    /// Read numbers; `what` is for the message if they are not there.
    double number(const char* what);
    DVec3 vector(const char* what);
    /// Reads three numbers, none of them negative.
    Color color(const char* what);
    /// Reads a whole number.
    long whole(const char* what, long low, long high);
    /// Read what follows this word, which must come next.
    double number_after(const char* word) { return expect(word), number(word); }
    DVec3 vector_after(const char* word) { return expect(word), vector(word); }
    Color color_after(const char* word) { return expect(word), color(word); }
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
    ForwardGuard guard;
};

}  // namespace strahl
