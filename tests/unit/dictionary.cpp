// The dictionary of the attack on the parser: every word of the language is in it.
#include <doctest/doctest.h>

#include <fstream>
#include <set>

#include "text/blocks.h"

using namespace strahl;

namespace {

std::set<std::string, std::less<>> dictionary() {
    std::ifstream file(STRAHL_SOURCE "/tests/attack/language.dict");
    std::set<std::string, std::less<>> words;
    for (std::string line; std::getline(file, line);)
        if (line.size() > 2 && line.front() == '"') words.insert(line.substr(1, line.size() - 2));
    return words;
}

}  // namespace

TEST_CASE("every word of the language is in the dictionary") {
    const auto words = dictionary();
    const auto look = [&](std::string_view word) {
        CAPTURE(std::string(word));
        CHECK(words.contains(word));
    };
    for (const std::string_view word : block_words) look(word);
    for (const std::string_view word : shape_words) look(word);
    for (const std::string_view word : mesh_words) look(word);
    for (const std::string_view word : triangle_words) look(word);
    for (const std::string_view word : pattern_words) look(word);
    for (const std::string_view word : {"colors", "map", "once", "height", "none"}) look(word);
    for (const std::string_view word : image_maps) look(word);
    std::apply(
        [&](const auto&... kind) {
            const auto look_in = [&]<class Kind>(const Kind&) {
                std::apply([&](const auto&... field) { (look(field.name), ...); }, Kind::fields);
            };
            (look_in(kind), ...);
        },
        std::tuple<Checker, Gradient, Brick, Noise, Marble, Wood>());
    each_block([&](const char* word, const auto& parameters) {
        look(word);
        for (const Parameter& parameter : parameters) look(parameter.name);
    });
}
