// The errors of a text, with their places and messages.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// Collects the errors of one text. A place is a slice of that text, empty at its end.
class Diagnostics {
  public:
    static constexpr std::size_t most = 10;

    Diagnostics(std::string_view text, std::string_view file) : text(text), file(file) {}

    /// Adds an error. Throws FileError with all errors once there are `most`. Of several errors at one place only the
    /// first counts.
    void add(std::string_view at, std::string message);
    /// Throws FileError if there are any.
    void check() const;
    bool any() const { return !faults.empty(); }

    /// "line 7", for a message that refers to a second place.
    std::string line(std::string_view at) const;

  private:
    struct Fault {
        std::string_view at;
        std::string message;
    };
    std::string tell(const Fault& fault) const;

    std::string_view text, file;
    std::vector<Fault> faults;
};

/// The known word most similar to `word`, or an empty one if none is similar enough.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

/// "unknown word 'x'; did you mean 'y'?", or, if no known word is similar, a list of them.
std::string unknown_word(std::string_view word, std::span<const std::string_view> known, const std::string& where);

/// A slice in quotes, shortened if long, safe to print.
std::string quoted(std::string_view slice);

}  // namespace strahl
