#include "main/lsp/document.h"

#include <algorithm>
#include <utility>

#include "files/utf8.h"

namespace strahl {
namespace {

/// The UTF-16 code units of the character whose bytes one of UTF-8 belongs to; 0 for all bytes but its first.
std::size_t units(char c) { return continues(c) ? 0 : static_cast<unsigned char>(c) >= 0xF0 ? 2 : 1; }

}  // namespace

Document::Document(std::string path, std::string own) : path(std::move(path)), text(std::move(own)), starts{0} {
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\n' || (text[i] == '\r' && text.substr(i + 1, 1) != "\n")) starts.push_back(i + 1);
}

std::size_t Document::line_start(std::size_t line) const { return line < starts.size() ? starts[line] : text.size(); }

std::size_t Document::line_end(std::size_t line) const {
    return std::min(text.find_first_of("\r\n", line_start(line)), text.size());
}

EditorPosition Document::position(std::size_t at) const {
    const auto behind = std::ranges::upper_bound(starts, at);
    EditorPosition position{static_cast<std::size_t>(behind - starts.begin()) - 1, 0};
    for (std::size_t i = behind[-1]; i < std::min(at, text.size()); ++i) position.unit += units(text[i]);
    return position;
}

std::size_t Document::offset(const EditorPosition& position) const {
    std::size_t at = line_start(position.line);
    const std::size_t end = line_end(position.line);
    for (std::size_t unit = 0; at < end && unit < position.unit; at = forth(text, at, end, 1)) unit += units(text[at]);
    return at;
}

std::string_view Document::line_at(std::size_t at) const {
    const std::size_t line = position(at).line, end = line_end(line);
    const std::size_t start = std::min(text.find_first_not_of(" \t", line_start(line)), end);
    return std::string_view(text).substr(start, end - start);
}

}  // namespace strahl
