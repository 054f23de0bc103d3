#include "main/lsp/scene_names.h"

#include <utility>

namespace strahl {
SceneCursor cursor_at(std::string_view text, std::size_t at) {
    SceneTokens tokens(text);
    SceneCursor cursor;
    SceneToken previous;  // the token before `cursor.before`
    for (SceneToken token; (token = tokens.next(true)).kind != SceneToken::none;) {
        const auto begin = static_cast<std::size_t>(token.text.data() - text.data());
        if (begin > at) break;
        // A sign, or a comment of more than a line, does not go on at its end.
        const bool goes_on = token.kind == SceneToken::word || token.text.starts_with("//");
        if (at < begin + token.text.size() + (goes_on ? 1 : 0)) {
            cursor.at = token;
            break;
        }
        if (token.kind == SceneToken::comment) continue;
        if (token.text == "{") {
            const bool named = previous.text == "material" || previous.text == "defaultmaterial";
            cursor.blocks.push_back(named ? previous.text : cursor.before.text);
        } else if (token.text == "}" && !cursor.blocks.empty()) {
            cursor.blocks.pop_back();
        }
        previous = cursor.before, cursor.before = token;
    }
    return cursor;
}

std::vector<SceneName> names_in(std::string_view text) {
    SceneTokens tokens(text);
    std::vector<SceneName> names;
    const auto add = [&](SceneName::NameKind kind, const SceneToken& token) {
        if (token.kind == SceneToken::word) names.push_back({kind, token.text});
    };
    for (SceneToken token; (token = tokens.next()).kind != SceneToken::none;) {
        if (token.text == "define") {
            const SceneToken name = tokens.next();
            add(tokens.next().text == "material" ? SceneName::material : SceneName::body, name);
        } else if (token.text == "#declare" || token.text == "#local") {
            add(SceneName::value, tokens.next());
        } else if (token.text == "#for") {
            tokens.next(), add(SceneName::value, tokens.next());
        } else if (token.text == "#macro") {
            add(SceneName::value, tokens.next());
            while ((token = tokens.next()).kind == SceneToken::word || token.text == "(" || token.text == ",")
                add(SceneName::value, token);
        } else if (token.text == "track") {
            const SceneToken name = tokens.next();
            if (name.kind == SceneToken::quotation) names.push_back({SceneName::track, name.text});
        }
    }
    return names;
}

std::vector<SceneBlock> blocks_in(std::string_view text) {
    SceneTokens tokens(text);
    std::vector<SceneBlock> blocks;
    SceneToken before;
    int depth = 0;
    bool declares = false;  // the next block belongs to the last declaration
    const auto from_to = [](std::string_view first, std::string_view last) {
        return std::string_view(first.data(), static_cast<std::size_t>(last.data() + last.size() - first.data()));
    };
    for (SceneToken token; (token = tokens.next()).kind != SceneToken::none; before = token) {
        const std::string_view word = token.text;
        if (word == "{" && depth++ == 0) {
            if (!std::exchange(declares, false)) blocks.push_back({before.text, before.text});
        } else if (word == "}" && depth > 0 && --depth == 0) {
            blocks.back().whole = from_to(blocks.back().whole, word);
        } else if (depth == 0 && (word == "define" || word == "#declare" || word == "#local" || word == "#macro")) {
            const SceneToken name = tokens.next();
            declares = name.kind == SceneToken::word;
            if (declares) blocks.push_back({name.text, from_to(word, name.text), true});
        } else if (word == ";") {
            declares = false;
        }
    }
    return blocks;
}

}  // namespace strahl
