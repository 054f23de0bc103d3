#include "text/text_items.h"

#include <algorithm>
#include <utility>

#include "files/error.h"
#include "text/blocks/blocks.h"
#include "text/reading/lexer.h"
#include "text/reading/scene_tokens.h"

namespace strahl {
namespace {

constexpr int most_depth = 64;  // of blocks in blocks; more than any text without errors has

/// Reads numbers, vectors, names in quotes and the word `track` into an item, until something else comes.
void read_values(Lexer& lexer, TextItem& item) {
    while (true) {
        const char c = lexer.peek();
        if (c == '"') {
            lexer.quotation("a name");
        } else if (c == '<' || c == '>' || c == ',') {
            lexer.accept(c);
        } else if (lexer.at_value()) {
            item.numbers.push_back(lexer.number("", "").at);
        } else if (c == 't') {
            const std::string_view word = lexer.word();
            if (word != "track") return lexer.rewind(word);
            const std::string_view name = lexer.quotation("a name");
            item.tracks.emplace_back(word.data(), std::size_t(name.data() + name.size() + 1 - word.data()));
        } else {
            return;
        }
    }
}

/// Reads the next item. Throws ParseAbort or FileError where no item can be.
TextItem read_item(Lexer& lexer, int depth) {
    TextItem item;
    item.word = lexer.word();
    if (item.word.empty() || depth > most_depth) throw ParseAbort{};
    const bool defines = item.word == "define";
    if (defines || item.word == "material" || item.word == "defaultmaterial") item.name = lexer.word();
    if (defines) {
        item.items.push_back(read_item(lexer, depth + 1));
        return item;
    }
    read_values(lexer, item);
    if (!lexer.accept('{')) return item;
    read_values(lexer, item);
    while (lexer.peek() != '}') item.items.push_back(read_item(lexer, depth + 1));
    item.end = lexer.token();
    lexer.accept('}');
    return item;
}

/// Returns the first item of the top level that is the one looked for, and adds the definitions and defaults before it.
/// An item without a word if there is none, or it has an error.
template <class Sought>
TextItem find_item(std::string_view text, BodyItems& before, const Sought& sought) try {
    Diagnostics diagnostics(text, "");
    Lexer lexer(text, diagnostics);
    SceneTokens tokens(text);
    for (SceneToken token; (token = tokens.next()).kind != SceneToken::none;) {
        if (token.text == "{") tokens.end_block();
        if (token.kind != SceneToken::word) continue;
        const bool found = sought(token.text);
        if (!found && token.text != "define" && token.text != "defaultmaterial") continue;
        lexer.rewind(token.text);
        TextItem item = read_item(lexer, 0);
        if (found) return item;
        if (token.text == "define") before.definitions.emplace(item.name, std::move(item));
        if (token.text == "defaultmaterial") before.defaults.push_back(std::move(item));
        tokens.go_on_at(lexer.token());
    }
    return {};
} catch (const ParseAbort&) {
    return {};
} catch (const FileError&) {
    return {};
}

/// Throws ParseAbort at a directive: behind one, bodies and lights of the text are not those of the scene.
void refuse_directive(std::string_view word) {
    if (word.starts_with('#')) throw ParseAbort{};
}

}  // namespace

const TextItem* TextItem::item(std::string_view item_word) const {
    const auto found = std::ranges::find(items, item_word, &TextItem::word);
    return found == items.end() ? nullptr : &*found;
}

std::string_view whole_block(const TextItem& item) {
    const char* end = item.word.data() + item.word.size();
    if (!item.end.empty())
        end = item.end.data() + item.end.size();
    else if (item.word == "define" && !item.items.empty())
        end = whole_block(item.items[0]).data() + whole_block(item.items[0]).size();
    else if (!item.name.empty())
        end = item.name.data() + item.name.size();
    return {item.word.data(), std::size_t(end - item.word.data())};
}

bool is_body_word(std::string_view word) { return contains(body_words, word); }

BodyItems items_of_body(std::string_view text, int number) {
    BodyItems found;
    found.body = find_item(text, found, [&](std::string_view word) {
        refuse_directive(word);
        return (is_body_word(word) || found.definitions.contains(word)) && number-- == 0;
    });
    return found;
}

TextItem item_of_light(std::string_view text, int number) {
    BodyItems before;
    return find_item(text, before, [&](std::string_view word) {
        refuse_directive(word);
        return word == "light" && number-- == 0;
    });
}

TextItem item_of_block(std::string_view text, std::string_view word) {
    BodyItems before;
    return find_item(text, before, [&](std::string_view found) { return found == word; });
}

std::string_view block_of(std::string_view text, std::string_view word) {
    SceneTokens tokens(text);
    for (SceneToken token, before; (token = tokens.next()).kind != SceneToken::none; before = token) {
        if (token.text != "{") continue;
        const std::string_view end = tokens.end_block();
        if (before.text == word && !end.empty()) return {before.text.data(), end.data() + end.size()};
    }
    return {};
}

}  // namespace strahl
