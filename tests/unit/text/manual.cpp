// The manual's tables are those of the field tables and parameter lists that the parser reads by.
#include "text/manual/manual.h"

#include <doctest/doctest.h>

#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>

#include "files/read_file.h"
#include "scene/scene.h"
#include "text/manual/syntax.h"
#include "text/manual/word_help.h"

using namespace strahl;

namespace {

const std::string page = read_text(STRAHL_SOURCE "/src/text/README.md");

std::string with_changed(std::string text, const std::string& old, const std::string& by) {
    const std::size_t at = text.find(old);
    REQUIRE(at != text.npos);
    return text.replace(at, old.size(), by);
}

}  // namespace

TEST_CASE("the manual's tables are current") {
    CHECK_MESSAGE(with_current_tables(page) == page,
                  "stale: run `cmake --build --preset release --target manual` and commit src/text/README.md");
}

TEST_CASE("every body has its rows, and a stale table is made anew") {
    const auto check = [&]<class... Kinds>(std::type_identity<std::variant<Kinds...>>) {
        const auto row = [&](const char* body, const auto& field) {
            CHECK_MESSAGE(page.find("| `" + std::string(body) + "` | " + field.name + " |") != page.npos, body);
        };
        const auto first_row = [&]<class Kind>(Kind) {
            if constexpr (std::is_same_v<Kind, Mesh>)
                CHECK(page.find("| `mesh` | file") != page.npos);
            else if constexpr (is_composite<Kind>)
                CHECK(page.find("| `" + std::string(Kind::name) + "` | bodies |") != page.npos);
            else if constexpr (std::is_same_v<Kind, Lathe>)
                CHECK(page.find("| `lathe` | contour |") != page.npos);
            else if constexpr (std::is_same_v<Kind, SphereSweep>)
                CHECK(page.find("| `sphere_sweep` | through or towards: centre |") != page.npos);
            else
                row(Kind::name, std::get<0>(Kind::fields));
        };
        (first_row(Kinds{}), ...);
    };
    check(std::type_identity<Shape>{});
    CHECK(with_current_tables(with_changed(page, "| `ior` | `1` |", "| `ior` | `2` |")) == page);
    CHECK(with_current_tables(with_changed(page, "| `sphere` | centre", "| `ball` | middle")) == page);
    CHECK(with_current_tables(with_changed(page, "`fov` | required", "`fov` | `25`")) == page);
}

TEST_CASE("a page with a missing, unknown, doubled or open table is refused") {
    CHECK_THROWS_AS(with_current_tables(""), std::runtime_error);
    CHECK_THROWS_AS(with_current_tables(with_changed(page, "<!-- table: light -->", "")), std::runtime_error);
    CHECK_THROWS_AS(with_current_tables(with_changed(page, "table: light", "table: lamp")), std::runtime_error);
    CHECK_THROWS_AS(with_current_tables(page + "<!-- table: light -->\n<!-- end of table -->"), std::runtime_error);
    CHECK_THROWS_AS(with_current_tables(page + "<!-- table: light -->\n"), std::runtime_error);
}

TEST_CASE("every word has help where it may stand, and editors offer every word") {
    const LanguageWords words = words_of_language();
    std::set<std::string> blocks = words.blocks, offered{"define", "track", "none"};
    blocks.merge(std::set(words.patterns)), blocks.merge(std::set(words.others));
    blocks.insert("");
    for (const std::string& block : blocks) {
        for (const std::string& word : words_after(block)) offered.insert(word);
        for (const std::string outer : {"", "flythrough", "motion", "mesh"})
            for (const std::string& word : words_in(block, outer)) {
                offered.insert(word);
                CHECK_MESSAGE(help_on_word(word, block, outer) != "", word << " in '" << block << "' has no help");
            }
    }
    for (const auto* list : {&words.blocks, &words.patterns, &words.others})
        for (const std::string& word : *list) CHECK_MESSAGE(offered.contains(word), word << " is offered nowhere");
    CHECK(help_on_word("pow", "material", "sphere").find("default `50`") != std::string::npos);
    CHECK(help_on_word("time", "key", "motion") != help_on_word("time", "key", "flythrough"));
    CHECK(help_on_word("shpere", "", "") == "");
}
