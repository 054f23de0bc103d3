#include "import/warnings.h"

#include <algorithm>

namespace strahl {

void Warnings::add(std::size_t line, const std::string& message) {
    const auto [place, is_new] = places.try_emplace(message, list.size());
    if (is_new) list.push_back({.message = message, .lines = {}});
    Warning& warning = list[place->second];
    if (warning.last == line && warning.count > 0) return;
    warning.last = line;
    if (++warning.count <= most_lines) warning.lines.push_back(line);
}

std::vector<std::string> Warnings::messages(std::string_view file) const {
    std::vector<const Warning*> sorted;
    for (const Warning& warning : list) sorted.push_back(&warning);
    std::ranges::stable_sort(sorted, {}, [](const Warning* warning) { return warning->lines[0]; });
    std::vector<std::string> messages;
    for (const Warning* warning : sorted) {
        std::string text = std::string(file) + ":" + std::to_string(warning->lines[0]) + ": " + warning->message;
        for (std::size_t i = 1; i < warning->lines.size(); ++i)
            text += (i > 1                ? ", "
                     : warning->count > 2 ? " (and in lines "
                                          : " (and in line ") +
                    std::to_string(warning->lines[i]);
        if (warning->count > warning->lines.size())
            text += " and " + std::to_string(warning->count - warning->lines.size()) + " more, the last in line " +
                    std::to_string(warning->last);
        messages.push_back(text + (warning->count > 1 ? ")" : ""));
    }
    return messages;
}

}  // namespace strahl
