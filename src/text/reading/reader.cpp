#include "text/reading/reader.h"

#include "num/decimal.h"

namespace strahl {
namespace {

constexpr std::array<std::string_view, 1> track_word{"track"};

}  // namespace

/// Reads `track "NAME"`, if that comes next, and the value for a track without keys: 0 if none is given.
bool BlockReader::follow(double& value, const NumberRange& range, std::string_view name, Block& block) {
    if (lexer.peek() != 't') return false;
    const std::string_view word = lexer.word();
    if (word != track_word[0]) {
        if (lexer.peek() != '"') return lexer.rewind(word), false;
        diagnostics.add(word, unknown_word(word, track_word, " before a name in quotes"));
        throw ParseAbort{};
    }
    const std::string_view track = lexer.quotation("the name of a track");
    const std::string what = quoted(name) + " of " + quoted(block.name);
    if (track.empty())
        fault(block, word, "this track has no name");
    else if (track.size() > 255)
        fault(block, word, "the name of this track is longer than 255 bytes");
    else if (!block.follows)
        fault(block, word,
              what +
                  " cannot follow a track; numbers of lights, materials, the camera, the fog, the background's "
                  "colour and the transformations of bodies can");
    else
        block.follows->push_back({std::string(track), std::string(name), block.component, 1, range.low, range.high});
    any_track = true;
    const char next = lexer.peek();
    if (next != ',' && next != '<' && lexer.at_value()) return read(value, range, name, block), true;
    value = 0;
    if (!range.contains(0))
        fault(block, word,
              what + " cannot be 0: give its value for a track without keys, as in 'track \"" + std::string(track) +
                  "\" " + text_of(range.contains(1) ? 1 : range.low) + "'");
    return true;
}

void BlockReader::read(double& value, const NumberRange& range, std::string_view name, Block& block) {
    if (follow(value, range, name, block)) return;
    const Number number = lexer.number(name, block.name);
    value = number.value;
    if (range.contains(value)) return;
    fault(block, number.at,
          quoted(name) + " of " + quoted(block.name) + " must be " + range.words + ", not " + quoted(number.at));
}

void BlockReader::read_three(DVec3& value, const NumberRange& range, std::string_view name, Block& block) {
    if (!lexer.accept('<')) lexer.fail("a vector <x, y, z> expected for " + quoted(name) + " of " + quoted(block.name));
    for (int i = 0; i < 3; ++i) {
        if (i > 0 && !lexer.accept(',')) lexer.fail("',' expected between the three numbers of a vector");
        block.component = i;
        read(value[i], range, name, block);
    }
    block.component = 0;
}

void BlockReader::read_clear(Color& color, double& filter, double& transmit, const NumberRange& range,
                             std::string_view name, Block& block) {
    read_three(color, range, name, block);
    if (lexer.accept(',')) {
        Block shares_of{block.name};  // they follow no tracks
        read(filter, shares, name, shares_of);
        if (!lexer.accept(',')) lexer.fail("',' and the share that is transmitted expected after the filter");
        read(transmit, shares, name, shares_of);
        block.absorb(shares_of);
    }
    if (!lexer.accept('>')) lexer.fail("'>' expected after the three or five numbers of a colour");
}

void BlockReader::read(DVec3& value, const NumberRange& range, std::string_view name, Block& block) {
    read_three(value, range, name, block);
    if (!lexer.accept('>')) lexer.fail("'>' expected after the three numbers of a vector");
}

void BlockReader::read(std::array<double, 2>& value, const NumberRange& range, std::string_view name, Block& block) {
    if (!lexer.accept('<')) lexer.fail("two numbers <u, v> expected for " + quoted(name) + " of " + quoted(block.name));
    read(value[0], range, name, block);
    if (!lexer.accept(',')) lexer.fail("',' expected between the two numbers");
    read(value[1], range, name, block);
    if (!lexer.accept('>')) lexer.fail("'>' expected after the two numbers");
}

void BlockReader::read(Scale& value, const NumberRange& range, std::string_view name, Block& block) {
    DVec3& by = value.by;
    const bool vector = lexer.peek() == '<';
    const std::string_view at = lexer.token();
    if (vector)
        read(by, range, name, block);
    else
        read(by.x, range, name, block), by.y = by.z = by.x;
    if (!vector && block.follows && !block.follows->empty())
        for (const int component : {1, 2}) {
            block.follows->push_back(block.follows->front());
            block.follows->back().component = component;
        }
    if (by.x != 0 && by.y != 0 && by.z != 0) return;
    fault(block, at, "'scale' of " + quoted(block.name) + " is 0, which would leave nothing of it; 1 changes nothing");
}

void BlockReader::read(Parameter& parameter, std::string_view word, Block& block) {
    const bool first = once(parameter.at, word);
    if (!first) block.bad = true;
    const auto read_as = [&](auto value, auto& target) {
        read(value, parameter.range, parameter.name, block);
        if (first) target = value;
    };
    const auto visitor = [&]<class T>(T* target) {
        if constexpr (std::is_same_v<T, bool>)
            *target = true;
        else if constexpr (requires { target->has_value(); })
            read_as(typename T::value_type(), *target);
        else
            read_as(*target, *target);
    };
    std::visit(visitor, parameter.value);
}

void BlockReader::set_time(double& time, const std::optional<double>& beat, std::string_view at, Block& block) {
    if (!beat || !block.good()) return;
    if (music) time = music->offset + *beat * 60 / music->bpm;
    if (music && seconds.contains(time)) return;
    fault(block, at,
          music ? "this beat is later than 1e9 seconds"
                : "the length of a beat is unknown: put 'music { bpm 120 }' above");
}

void BlockReader::require(Block& block, std::span<const Parameter> parameters, std::initializer_list<Need> needs) {
    std::vector<std::string> lacking;
    for (const Parameter& parameter : parameters) {
        const auto other = std::ranges::find(parameters, parameter.alternative, &Parameter::name);
        const bool has_other = other != parameters.end(), other_given = has_other && other->given();
        if (parameter.given() && other_given) repeats(block, parameter, *other);
        if (parameter.otherwise == required && !parameter.given() && !other_given)
            lacking.push_back(quoted(parameter.name) + (has_other ? " (or " + quoted(other->name) + ")" : ""));
    }
    for (const Need& need : needs)
        if (!need.given) lacking.emplace_back(need.name);
    if (lacking.empty()) return;
    block.bad = true;
    if (!block.lost) diagnostics.add(block.name, quoted(block.name) + " lacks " + listed(lacking));
}

void BlockReader::repeats(Block& block, const Parameter& a, const Parameter& b) {
    const auto& [first, second] =
        std::minmax(a, b, [](const Parameter& p, const Parameter& q) { return p.at.data() < q.at.data(); });
    fault(block, second.at,
          quoted(second.name) + " repeats " + quoted(first.name) + " of " + diagnostics.line(first.at) +
              "; give only one of them");
}

void BlockReader::open(const Block& block) {
    if (!lexer.accept('{')) lexer.fail("'{' expected after " + quoted(block.name));
}

/// Is the block at its end? If not, `word` is the next word in it, or empty if something else came, which is reported.
bool BlockReader::closed(Block& block, std::span<const std::string_view> words, std::string_view& word) {
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
    // A top-level block inside another block: a closing brace is missing.
    if (contains(words, word) || !contains(blocks, word) || lexer.peek() != '{') return false;
    if (!block.lost)
        diagnostics.add(
            word, "'}' missing: the " + quoted(block.name) + " of " + diagnostics.line(block.name) + " is still open");
    lexer.rewind(word);
    return block.lost = true;
}

void BlockReader::unknown(Block& block, std::span<const std::string_view> words, std::string_view word) {
    diagnostics.add(word, unknown_word(word, words, " in " + quoted(block.name)));
    block.lost = true;
    lexer.skip_to({}, blocks);
}

}  // namespace strahl
