// The dictionary of the attack on the parser: every word of the language is in it.
#include <doctest/doctest.h>

#include <fstream>
#include <set>

#include "text/manual/syntax.h"

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
    const LanguageWords language = words_of_language();
    for (const auto* const some : {&language.blocks, &language.patterns, &language.others})
        for (const std::string& word : *some) look(word);
}
