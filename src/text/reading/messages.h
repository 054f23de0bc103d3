// Collects the errors of a text and writes messages about them.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/error.h"
#include "files/words.h"

namespace strahl {

/// Says that a text was made of others: from `at` on, up to the next origin, it is that of a file from `source_at` on.
struct TextOrigin {
    std::size_t at;
    std::string_view file, source;
    std::size_t source_at;
};

/// Collects the errors of one text. Each stands at a slice of that text, which is empty at its end.
class Diagnostics {
  public:
    static constexpr std::size_t most = 10;

    /// If the text was made of others, its `origins` are in messages, in ascending order.
    Diagnostics(std::string_view text, std::string_view file, std::span<const TextOrigin> origins = {})
        : text(text), file(file), origins(origins) {}

    /// Adds an error, unless one begins at the same place. Throws FileError with all errors once there are `most`.
    void add(std::string_view at, std::string message);
    /// Throws FileError if there are any.
    void check() const;
    /// Throws FileError if the text is not UTF-8, or has a byte 0 in it.
    void check_encoding();
    bool any() const { return !faults.empty(); }

    /// "line 7", for a message that refers to another line.
    std::string line(std::string_view at) const;

  private:
    struct Fault {
        std::string_view at;
        std::string message;
    };
    Message message_of(const Fault& fault) const;
    /// Returns where a slice of the text comes from.
    TextOrigin origin(std::string_view at) const;

    std::string_view text, file;
    std::span<const TextOrigin> origins;
    std::vector<Fault> faults;
};

/// The known word most similar to `word`, or an empty one if none is similar enough.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

/// "unknown word 'x'; did you mean 'y'?", or, if no known word is similar, a list of them.
std::string unknown_word(std::string_view word, std::span<const std::string_view> known, const std::string& where);

}  // namespace strahl
