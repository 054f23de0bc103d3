// Reads the values and blocks of scene text, and goes on after errors.
#pragma once
#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/error.h"
#include "scene/motion/track.h"
#include "text/reading/lexer.h"
#include "text/reading/parameter.h"
#include "text/reading/scene_files.h"

namespace strahl {

/// A block that is being read.
struct Block {
    std::string_view name;                   // its first word, where it stands in the text
    bool lost = false;                       // part of it could not be parsed: missing parameters are not reported
    bool bad = false;                        // a value is wrong: errors that follow from it are not reported
    std::vector<Follow>* follows = nullptr;  // takes the numbers that follow tracks; null if none may
    int component = 0;                       // of the vector that is being read
    bool good() const { return !lost && !bad; }
    /// Takes over the state of a block inside this one.
    void absorb(const Block& inner) { lost |= inner.lost, bad |= inner.bad; }
};

class BlockReader {
  public:
    /// `blocks` are the words that open a block of the top level.
    BlockReader(std::string_view text, Diagnostics& diagnostics, std::span<const std::string_view> blocks,
                SceneFiles& files)
        : lexer(text, diagnostics), diagnostics(diagnostics), blocks(blocks), files(files) {}

    /// Read a value. One out of range is reported, and reading continues.
    void read(double& value, const NumberRange& range, std::string_view name, Block& block);
    void read(DVec3& value, const NumberRange& range, std::string_view name, Block& block);
    /// Reads two numbers, <u, v>.
    void read(std::array<double, 2>& value, const NumberRange& range, std::string_view name, Block& block);
    /// Reads a vector of factors, or one number for all three.
    void read(Scale& value, const NumberRange& range, std::string_view name, Block& block);
    /// Reads a colour <r, g, b>, or <r, g, b, filter, transmit>.
    void read_clear(Color& color, double& filter, double& transmit, const NumberRange& range, std::string_view name,
                    Block& block);
    void read(Pigment& value, const NumberRange& range, std::string_view name, Block& block);
    int patterns_around = 0;  // the one that is read
    void read(Bump& value, const NumberRange& range, std::string_view name, Block& block);
    void read(NormalMap& value, const NumberRange& range, std::string_view name, Block& block);

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
    /// Reads a block of arguments, then parameters, and `other_words` by `item`.
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

    /// Reads blocks to the end of the text: read_block(word) reads what follows the word. `example` is for a message.
    template <class ReadBlock>
    void blocks_to_end(const char* example, ReadBlock read_block) {
        while (!lexer.at_end()) {
            const std::string_view word = lexer.word();
            try {
                if (!word.empty())
                    read_block(word);
                else if (!(diagnostics.any() && lexer.accept('}')))  // one too many may follow from an earlier error
                    lexer.fail("a block expected, such as '" + std::string(example) + "'");
            } catch (const ParseAbort&) {
                const bool inside = lexer.accept('{');
                lexer.skip_to(blocks, blocks);
                if (inside) lexer.accept('}');
            }
        }
    }

    /// Something that a block must have: was it given, and its name in messages.
    struct Need {
        bool given;
        const char* name;
    };
    /// Reports parameters and needs that are missing, and pairs of parameters of which only one may be given.
    void require(Block& block, std::span<const Parameter> parameters, std::initializer_list<Need> needs = {});
    /// Sets `time` to the seconds of the beat, if one is given. Reports an error at `at` if no music was read before.
    void set_time(double& time, const std::optional<double>& beat, std::string_view at, Block& block);
    /// True the first time, which sets `first` to the word. Reports an error at the word the second time.
    bool once(std::string_view& first, std::string_view word) {
        if (!first.data()) return first = word, true;
        diagnostics.add(word, "a second " + quoted(word) + "; the first is in " + diagnostics.line(first));
        return false;
    }
    /// Reports an error at a slice of the text, which makes the block bad.
    void fault(Block& block, std::string_view at, const std::string& message) {
        diagnostics.add(at, message);
        block.bad = true;
    }
    /// Ends parsing with an error if there are `most` of `what` already.
    void limit(std::size_t count, std::size_t most, std::string_view at, const char* what) {
        if (count < most) return;
        diagnostics.add(at, "more than " + std::to_string(most) + " " + what);
        diagnostics.check();
    }
    /// Calls read_file(name) with a name that is read next, in quotes; its FileErrors are reported at the name. `what`
    /// is for messages.
    template <class ReadFile>
    void file(Block& block, const char* what, ReadFile read_file) {
        const std::string_view name = lexer.quotation("the name of a " + std::string(what));
        try {
            read_file(name);
        } catch (const FileError& error) {
            fault(block, name, error.what());
        }
    }

    Lexer lexer;
    Diagnostics& diagnostics;
    const std::span<const std::string_view> blocks;
    SceneFiles& files;
    bool any_track = false;      // some number follows a track
    std::optional<Music> music;  // once it is read
    /// Reports that of two parameters that exclude each other the later one is too much.
    void repeats(Block& block, const Parameter& a, const Parameter& b);

  private:
    void read_three(DVec3& value, const NumberRange& range, std::string_view name, Block& block);
    bool follow(double& value, const NumberRange& range, std::string_view name, Block& block);
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
