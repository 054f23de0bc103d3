#include "text/text_changes.h"

#include <algorithm>

namespace strahl {

TextSlice with_space(const std::string& text, TextSlice slice) {
    const auto blank = [&](std::size_t i) { return text[i - 1] == ' ' || text[i - 1] == '\t'; };
    while (slice.begin > 0 && blank(slice.begin)) --slice.begin;
    const bool alone = slice.end == text.size() || text[slice.end] == '\n' || text[slice.end] == '\r';
    if (alone && slice.begin > 0 && text[slice.begin - 1] == '\n') --slice.begin;
    return slice;
}

std::string with_changes(const std::string& text, std::vector<TextChange> changes) {
    std::ranges::stable_sort(changes, {}, [](const TextChange& change) { return change.at.begin; });
    std::string result;
    std::size_t done = 0;
    for (const TextChange& change : changes) {
        const std::size_t from = std::max(done, change.at.begin);
        result.append(text, done, from - done).append(change.text);
        done = std::max(from, change.at.end);
    }
    return result.append(text, done);
}

std::string indentation(const std::string& text, std::size_t at) {
    const std::size_t line = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    const std::size_t first = std::min(text.find_first_not_of(" \t", line), text.size());
    return text.substr(line, std::min(first, at) - line);
}

std::size_t rest_of_line(const std::string& text, std::size_t at) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    std::size_t next = at;
    while (next < text.size() && blank(text[next])) ++next;
    if (text.compare(next, 2, "//") == 0) next = std::min(text.find('\n', next), text.size());
    return next == text.size() || text[next] == '\n' ? next : at;
}

}  // namespace strahl
