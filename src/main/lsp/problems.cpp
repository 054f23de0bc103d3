#include "main/lsp/problems.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <utility>

#include "files/utf8.h"
#include "image/pixels.h"
#include "pov/open_scene.h"
#include "text/scene_warnings.h"

namespace strahl {
namespace {

/// Reads ":7" at the start of a text and removes it; returns 0 if there is no number.
std::size_t take_number(std::string_view& text) {
    std::size_t number = 0;
    if (!text.starts_with(':')) return 0;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
    if (error != std::errc()) return 0;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

/// Makes a problem of the line that begins a message.
Problem problem_in(std::string_view line, const std::string& scene, bool warning) {
    std::size_t colon = line.starts_with(scene + ":") ? scene.size() : line.find(':');
    for (; colon != line.npos; colon = line.find(':', colon + 1)) {
        std::string_view rest = line.substr(colon);
        const std::size_t number = take_number(rest), column = take_number(rest);
        if (number > 0 && rest.starts_with(": "))
            return {warning, std::string(line.substr(0, colon)), number, column, 0, std::string(rest.substr(2))};
    }
    return {warning, "", 0, 0, 0, std::string(line)};
}

}  // namespace

std::vector<Problem> problems_in(std::string_view messages, const std::string& scene, bool warning) {
    std::vector<Problem> problems;
    while (!messages.empty()) {
        const std::size_t end = std::min(messages.find('\n'), messages.size());
        const std::string_view line = messages.substr(0, end);
        messages.remove_prefix(std::min(end + 1, messages.size()));
        if (!line.starts_with("  ") || problems.empty()) {
            problems.push_back(problem_in(line, show(scene).text, warning));
            continue;
        }
        Problem& problem = problems.back();
        const std::string_view behind = line.substr(std::min(line.find_first_not_of(' '), line.size()));
        if (!line.starts_with("    ")) {  // "  included from scene.rt:2"
            problem.message.append("\n").append(behind);
            const std::size_t at = behind.rfind(" " + scene + ":");
            if (at == behind.npos) continue;
            std::string_view number = behind.substr(at + 1 + scene.size());
            problem.caller = take_number(number);
        } else if (behind.starts_with('^') && behind.find_first_not_of('~', 1) == behind.npos) {
            problem.length = behind.size();
        }
    }
    return problems;
}

std::vector<Problem> check_scene(const std::string& text, const std::string& path, std::vector<std::string>& files) {
    try {
        OpenedScene opened = open_scene(text, path, {}, read_pixels);
        std::vector<Problem> problems;
        for (const std::string& note : opened.notes)
            for (Problem& problem : problems_in(note, path, true)) problems.push_back(std::move(problem));
        for (const std::string& warning : opened.warnings)
            for (Problem& problem : problems_in(warning, path, true)) problems.push_back(std::move(problem));
        for (std::string& warning : scene_warnings(opened.scene))
            problems.push_back({true, "", 0, 0, 0, std::move(warning)});
        files = std::move(opened.files);
        return problems;
    } catch (const std::exception& error) {
        return problems_in(error.what(), path, false);
    }
}

}  // namespace strahl
