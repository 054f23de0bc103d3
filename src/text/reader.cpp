// Values, and the frame of a block: braces, words, what to do when they are wrong.
#include "text/reader.h"

namespace strahl {

void Reader::read(double& value, const Bounds& bounds, std::string_view name, Block& block) {
    const Number number = lexer.number(name, block.name);
    value = number.value;
    if (bounds.contains(value)) return;
    block.bad = true;
    diagnostics.add(number.at, quoted(name) + " of " + quoted(block.name) + " must be " + bounds.words + ", not " +
                                   quoted(number.at));
}

void Reader::read(DVec3& value, const Bounds& bounds, std::string_view name, Block& block) {
    if (!lexer.accept('<')) lexer.fail("a vector <x, y, z> expected for " + quoted(name) + " of " + quoted(block.name));
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && !lexer.accept(',')) lexer.fail("',' expected between the three numbers of a vector");
        read(value[i], bounds, name, block);
    }
    if (!lexer.accept('>')) lexer.fail("'>' expected after the three numbers of a vector");
}

void Reader::read(Parameter& parameter, std::string_view word, Block& block) {
    const bool first = once(parameter.at, word);
    if (!first) block.bad = true;
    std::visit(
        [&](auto* target) {
            if constexpr (std::is_same_v<decltype(target), bool*>) {
                *target = true;
            } else {
                auto value = *target;
                read(value, parameter.bounds, parameter.name, block);
                if (first) *target = value;
            }
        },
        parameter.value);
}

void Reader::require(Block& block, std::initializer_list<Need> needs) {
    std::string lacking;
    for (const Need& need : needs)
        if (!need.given) lacking += (lacking.empty() ? "" : ", ") + std::string(need.name);
    if (lacking.empty()) return;
    block.bad = true;
    if (!block.lost) diagnostics.add(block.name, quoted(block.name) + " lacks " + lacking);
}

void Reader::open(const Block& block) {
    if (!lexer.accept('{')) lexer.fail("'{' expected after " + quoted(block.name));
}

/// Is the block at its end? Else `word` is the next word in it, or empty if something else came and was noted.
bool Reader::closed(Block& block, std::span<const std::string_view> words, std::string_view& word) {
    if (lexer.accept('}')) return true;
    if (lexer.at_end()) {
        if (!block.lost) diagnostics.add(block.name, "'}' missing: this " + quoted(block.name) + " is never closed");
        return block.lost = true;
    }
    word = lexer.word();
    if (word.empty()) {
        guard(block, words, [&] { lexer.fail("a word or '}' expected in " + quoted(block.name)); });
        return false;
    }
    // A block of the top level inside of another: its closing brace is missing.
    if (contains(words, word) || !contains(blocks, word) || lexer.peek() != '{') return false;
    if (!block.lost)
        diagnostics.add(
            word, "'}' missing: the " + quoted(block.name) + " of " + diagnostics.line(block.name) + " is still open");
    lexer.rewind(word);
    return block.lost = true;
}

void Reader::unknown(Block& block, std::span<const std::string_view> words, std::string_view word) {
    diagnostics.add(word, unknown_word(word, words, " in " + quoted(block.name)));
    block.lost = true;
    lexer.skip_to({}, blocks);
}

}  // namespace strahl
