// Reads the values and blocks that all parts of the language are made of.
#pragma once
#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "scene/field.h"
#include "text/lexer.h"

namespace strahl {

/// The values a number may have, with the words that say so.
struct Bounds {
    double low, high;
    const char* words;
    bool contains(double v) const { return v >= low && v <= high; }
};

inline constexpr double largest_number = std::numeric_limits<double>::max();
inline constexpr double smallest_positive = std::numeric_limits<double>::min();  // denormals lose digits
inline constexpr double largest_coordinate = 1e15;
inline constexpr Bounds coordinates{-largest_coordinate, largest_coordinate, "from -1e15 to 1e15"};
inline constexpr Bounds lengths{smallest_positive, largest_coordinate,
                                "greater than 0 (at least 2.3e-308) and at most 1e15"};
inline constexpr Bounds shares{0, 1, "from 0 to 1"};
// Products of three of these are numbers in float too.
inline constexpr Bounds not_negative{0, 1e9, "from 0 to 1e9"};
inline constexpr Bounds positive{1e-9, 1e9, "from 1e-9 to 1e9"};
inline constexpr Bounds anything{-largest_number, largest_number, "a number"};

/// The bounds of a coefficient.
constexpr Bounds bounds_of(Range range) {
    switch (range) {
        case Range::positive:
            return positive;
        case Range::zero_or_more:
            return not_negative;
        case Range::zero_to_one:
            return shares;
        default:
            return anything;
    }
}
/// Those of a shape's own arguments, which are points and lengths.
constexpr Bounds argument_bounds(Range range) {
    return range == Range::positive ? lengths : range == Range::any ? coordinates : bounds_of(range);
}

/// One `name value` of a block; of a bool the name alone. `at` becomes the place of the name.
struct Parameter {
    std::string_view name;
    std::variant<double*, DVec3*, bool*> value;
    Bounds bounds = anything;
    std::string_view at{};
    bool given() const { return at.data() != nullptr; }
};

/// A block being read: its name where it stands. `lost`: some of it could not be understood, so that what seems to be
/// missing is no news. `bad`: some value is wrong, so that what follows from it means nothing.
struct Block {
    std::string_view name;
    bool lost = false, bad = false;
    bool good() const { return !lost && !bad; }
    /// What was wrong in a block inside of this one.
    void absorb(const Block& inner) { lost |= inner.lost, bad |= inner.bad; }
};

class Reader {
  public:
    Reader(std::string_view text, Diagnostics& diagnostics, std::span<const std::string_view> blocks)
        : lexer(text, diagnostics), diagnostics(diagnostics), blocks(blocks) {}

    /// Values out of bounds are noted, and reading goes on.
    void read(double& value, const Bounds& bounds, std::string_view name, Block& block);
    void read(DVec3& value, const Bounds& bounds, std::string_view name, Block& block);

    /// Reads `{ ... }`: first what `arguments()` reads, then words, of which `item(word)` reads the values; it says
    /// whether it knew the word. `words` are all that it knows.
    template <class Arguments, class Item>
    void block(Block& block, std::span<const std::string_view> words, Arguments arguments, Item item) {
        open(block);
        guard(block, words, arguments);
        for (std::string_view word; !closed(block, words, word);)
            if (!word.empty())
                guard(block, words, [&] {
                    if (!item(word)) unknown(block, words, word);
                });
    }
    /// A block of parameters, and other words for `item`.
    template <std::size_t count, std::size_t others, class Item>
    void block(Block& block, std::array<Parameter, count>& parameters,
               const std::array<std::string_view, others>& other_words, Item item) {
        std::array<std::string_view, count + others> words;
        const auto rest = std::transform(parameters.begin(), parameters.end(), words.begin(),
                                         [](const Parameter& parameter) { return parameter.name; });
        std::copy(other_words.begin(), other_words.end(), rest);
        const auto named = [&](std::string_view word) {
            for (Parameter& parameter : parameters)
                if (word == parameter.name) return read(parameter, word, block), true;
            return item(word);
        };
        this->block(
            block, words, [] {}, named);
    }
    template <std::size_t count>
    void block(Block& block, std::array<Parameter, count>& parameters) {
        this->block(block, parameters, std::array<std::string_view, 0>{}, [](std::string_view) { return false; });
    }

    struct Need {
        bool given;
        const char* name;
    };
    /// Notes what a block lacks.
    void require(Block& block, std::initializer_list<Need> needs);
    /// Notes that a word stands a second time; `first` is where it stood first, or becomes it.
    bool once(std::string_view& first, std::string_view word) {
        if (!first.data()) return first = word, true;
        diagnostics.add(word, "a second " + quoted(word) + "; the first is in " + diagnostics.line(first));
        return false;
    }

    Lexer lexer;
    Diagnostics& diagnostics;
    const std::span<const std::string_view> blocks;  // words of the top level

  private:
    void open(const Block& block);
    bool closed(Block& block, std::span<const std::string_view> words, std::string_view& word);
    void unknown(Block& block, std::span<const std::string_view> words, std::string_view word);
    void read(Parameter& parameter, std::string_view word, Block& block);

    template <class Action>
    void guard(Block& block, std::span<const std::string_view> words, Action action) {
        try {
            action();
        } catch (const ParseAbort&) {
            block.lost = true;
            lexer.skip_to(words, blocks);
        }
    }
};

}  // namespace strahl
