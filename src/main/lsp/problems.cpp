#include "main/lsp/problems.h"

#include <algorithm>
#include <ctime>
#include <exception>
#include <set>
#include <string_view>
#include <utility>

#include "image/pixels.h"
#include "main/lsp/document.h"
#include "main/lsp/scene_names.h"
#include "pov/open_scene.h"
#include "text/scene_warnings.h"

namespace strahl {
namespace {

constexpr std::size_t most_errors = 10;

/// Replaces by spaces the block of the top level, or the line outside of blocks, that an error of a .pov is in, so that
/// the rest can be checked. Adds what the block declares to `lost`. False if the rest would have no meaning.
bool blank(std::string& text, const std::string& path, const Message& error, std::set<std::string>& lost) {
    const std::size_t line = error.file == path ? error.line : error.caller;
    if (line == 0) return false;
    const Document document(path, text);
    const std::size_t column = error.file == path ? std::max<std::size_t>(error.column, 1) : 1;
    const std::size_t at = document.offset({line - 1, column - 1});
    std::size_t begin = std::min(document.line_start(line - 1), text.size()), end = document.line_end(line - 1);
    const std::vector<SceneBlock> blocks = blocks_in(text);
    const auto behind = std::ranges::find_if(
        blocks, [&](const SceneBlock& block) { return std::size_t(block.whole.data() - text.data()) > at; });
    if (behind != blocks.begin()) {
        const SceneBlock& block = behind[-1];
        const std::size_t from = std::size_t(block.whole.data() - text.data()), to = from + block.whole.size();
        if (at < to || from >= begin) {
            begin = from, end = at < to ? to : end;
            if (block.declared) lost.emplace(block.name);
        }
    }
    // A condition or a loop is more than its line.
    if (const std::size_t first = text.find_first_not_of(" \t", begin); first < end && text[first] == '#')
        if (const auto word = text.substr(first, 8); !word.starts_with("#declare") && !word.starts_with("#local") &&
                                                     !word.starts_with("#macro") && !word.starts_with("#include"))
            return false;
    const std::string before = text;
    for (std::size_t i = begin; i < end; ++i)
        if (text[i] != '\n' && text[i] != '\r') text[i] = ' ';
    return text != before;
}

}  // namespace

std::vector<Problem> check_scene(const std::string& text, const std::string& path, std::vector<std::string>& files) {
    std::vector<Problem> problems;
    const auto add = [&](bool warning, const std::vector<Message>& messages) {
        for (const Message& message : messages) problems.push_back({warning, message});
    };
    std::string rest = text;
    std::set<std::string> lost;
    const std::clock_t began = std::clock();
    do {
        try {
            OpenedScene opened = open_scene(rest, path, {}, read_pixels);
            files = std::move(opened.files);
            if (!problems.empty()) break;
            add(true, opened.notes);
            add(true, opened.warnings);
            for (std::string& warning : scene_warnings(opened.scene)) add(true, {{std::move(warning)}});
            break;
        } catch (const FileError& error) {
            const std::vector<Message>& messages = *error.messages;
            const bool follows = std::ranges::any_of(lost, [&](const std::string& name) {
                return messages[0].text.find("'" + name + "'") != std::string::npos;
            });
            if (!follows) add(false, messages);
            if (!is_pov(path) || !blank(rest, path, messages[0], lost)) break;
        } catch (const std::exception& error) {
            add(false, {{error.what()}});
            break;
        }
    } while (problems.size() < most_errors && std::clock() - began < CLOCKS_PER_SEC / 2);
    return problems;
}

}  // namespace strahl
