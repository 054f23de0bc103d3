// What is wrong with a text: faults with their places, told so that a person finds and mends them.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strahl {

/// Collects the faults of one text. A place is a slice of that text (empty at its end).
class Diagnostics {
  public:
    static constexpr std::size_t most = 10;

    Diagnostics(std::string_view text, std::string_view file) : text(text), file(file) {}

    /// Throws FileError with all faults once there are `most`. Of several faults at one place only the first counts.
    void add(std::string_view at, std::string message);
    /// Throws FileError if there are any.
    void check() const;
    bool any() const { return !faults.empty(); }

    /// "line 7", for a message that points to a second place.
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

/// The word most like `word`, or an empty one if none is much like it.
std::string_view nearest(std::string_view word, std::span<const std::string_view> known);

/// "unknown word 'x'; did you mean 'y'?", or, if no known word is near, a list of them.
std::string unknown_word(std::string_view word, std::span<const std::string_view> known, const std::string& where);

/// A slice in quotes, shortened if it is long, safe to print.
std::string quoted(std::string_view slice);

}  // namespace strahl
