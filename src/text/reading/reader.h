// Reads values and blocks.
#pragma once
#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/motion/track.h"
#include "text/reading/lexer.h"
#include "text/reading/parameter.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// A block being read, and its name where it stands. `lost`: part of it could not be parsed, so missing parameters are
/// not reported. `bad`: some value is wrong, so errors that follow from it are not reported.
struct Block {
    std::string_view name;
    bool lost = false, bad = false;
    std::vector<Follow>* follows = nullptr;  // where numbers that follow tracks are noted; null if none may
    int component = 0;                       // of the vector that is being read
    bool good() const { return !lost && !bad; }
    /// Takes over the state of a block inside this one.
    void absorb(const Block& inner) { lost |= inner.lost, bad |= inner.bad; }
};

class Reader {
  public:
    Reader(std::string_view text, Diagnostics& diagnostics, std::span<const std::string_view> blocks, SceneFiles& files)
        : lexer(text, diagnostics), diagnostics(diagnostics), blocks(blocks), files(files) {}

    /// Values out of bounds are reported, and reading continues.
    void read(double& value, const Bounds& bounds, std::string_view name, Block& block);
    void read(DVec3& value, const Bounds& bounds, std::string_view name, Block& block);
    /// Two numbers, <u, v>.
    void read(std::array<double, 2>& value, const Bounds& bounds, std::string_view name, Block& block);
    /// A number is that factor in all directions.
    void read(Scale& value, const Bounds& bounds, std::string_view name, Block& block);
    void read(Pigment& value, const Bounds& bounds, std::string_view name, Block& block);
    void read(Bump& value, const Bounds& bounds, std::string_view name, Block& block);
    void read(NormalMap& value, const Bounds& bounds, std::string_view name, Block& block);

    /// Reads `{ ... }`: first `arguments()`, then words. `item(word)` reads the value of a word and returns whether it
    /// knows the word; `words` are all words that it knows.
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
    /// Reads a block of arguments, then parameters, and other words by `item`.
    template <std::size_t count, std::size_t others, class Arguments, class Item>
    void block(Block& block, std::array<Parameter, count>& parameters,
               const std::array<std::string_view, others>& other_words, Arguments arguments, Item item) {
        std::array<std::string_view, count + others> words;
        const auto rest = std::transform(parameters.begin(), parameters.end(), words.begin(),
                                         [](const Parameter& parameter) { return parameter.name; });
        std::copy(other_words.begin(), other_words.end(), rest);
        const auto named = [&](std::string_view word) {
            for (Parameter& parameter : parameters)
                if (word == parameter.name) return read(parameter, word, block), true;
            return item(word);
        };
        this->block(block, words, arguments, named);
    }
    template <std::size_t count>
    void block(Block& block, std::array<Parameter, count>& parameters) {
        this->block(
            block, parameters, std::array<std::string_view, 0>{}, [] {}, [](std::string_view) { return false; });
    }

    struct Need {
        bool given;
        const char* name;
    };
    /// Reports missing parameters, and pairs of which only one may be given.
    void require(Block& block, std::span<const Parameter> parameters, std::initializer_list<Need> needs = {});
    /// The seconds of a `beat` that stands at `at`, where one is given. It is an error if there is no music yet.
    void set_time(double& time, const std::optional<double>& beat, std::string_view at, Block& block);
    /// Reports a word that is given a second time. `first` is the place of the first time, and is set then.
    bool once(std::string_view& first, std::string_view word) {
        if (!first.data()) return first = word, true;
        diagnostics.add(word, "a second " + quoted(word) + "; the first is in " + diagnostics.line(first));
        return false;
    }

    Lexer lexer;
    Diagnostics& diagnostics;
    const std::span<const std::string_view> blocks;  // words that open a top-level block
    SceneFiles& files;
    bool any_track = false;      // Does some number follow one?
    std::optional<Music> music;  // as soon as it is read

  private:
    bool follow(double& value, const Bounds& bounds, std::string_view name, Block& block);
    void open(const Block& block);
    bool closed(Block& block, std::span<const std::string_view> words, std::string_view& word);
    void unknown(Block& block, std::span<const std::string_view> words, std::string_view word);
    void read(Parameter& parameter, std::string_view word, Block& block);
    void repeats(Block& block, const Parameter& a, const Parameter& b);

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
