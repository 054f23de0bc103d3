#include "text/reading/scene_tokens.h"

#include <algorithm>

#include "files/utf8.h"
#include "files/words.h"

namespace strahl {
namespace {

bool in_word(char c) { return is_letter(c) || is_digit(c); }

/// Returns the length of the comment that a text begins with; 0 if it begins with none.
std::size_t comment_length(std::string_view text) {
    if (text.starts_with("//")) return std::min(text.find_first_of("\r\n"), text.size());
    if (!text.starts_with("/*")) return 0;
    const std::size_t close = text.find("*/", 2);
    return close == text.npos ? text.size() : close + 2;
}
/// Does so for a text in quotes, which ends with its line if the quotes are not closed.
std::size_t quotation_length(std::string_view text) {
    if (!text.starts_with('"')) return 0;
    const std::size_t close = text.find_first_of("\"\r\n", 1);
    return close == text.npos ? text.size() : close + 1;
}

}  // namespace

SceneToken SceneTokens::next(bool comments) {
    SceneToken token = any();
    while (!comments && token.kind == SceneToken::comment) token = any();
    return token;
}

SceneToken SceneTokens::any() {
    while (at < text.size() && is_space(text[at])) ++at;
    const std::string_view rest = text.substr(at);
    if (rest.empty()) return {};
    if (const std::size_t length = comment_length(rest); length > 0) return {SceneToken::comment, take(length)};
    if (const std::size_t length = quotation_length(rest); length > 0) return {SceneToken::quotation, take(length)};
    std::size_t length = rest[0] == '#' ? 1 : 0;
    while (length < rest.size() && in_word(rest[length])) ++length;
    if (length > 0) return {SceneToken::word, take(length)};
    return {SceneToken::sign, take(forth(rest, 0, rest.size(), 1))};
}

std::string_view SceneTokens::end_block() {
    for (int depth = 1; at < text.size();) {
        const char c = text[at];
        if (c == '}' && --depth == 0) return take(1);
        if (c == '{') ++depth;
        const std::size_t length = c == '/'   ? comment_length(text.substr(at))
                                   : c == '"' ? quotation_length(text.substr(at))
                                              : 0;
        at += std::max<std::size_t>(length, 1);
    }
    return text.substr(at);
}

std::string_view SceneTokens::take(std::size_t length) {
    const std::string_view taken = text.substr(at, length);
    at += length;
    return taken;
}

}  // namespace strahl
