#include "show/external_editor.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "files/os/process.h"

namespace strahl {
namespace {

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

}  // namespace

std::vector<std::string> editor_command(const std::string& editor, const std::string& terminal, const std::string& file,
                                        int line) {
    constexpr std::array<std::string_view, 10> in_terminals{"vi",     "vim", "nvim", "nano", "micro",
                                                            "mcedit", "joe", "ne",   "hx",   "helix"};
    constexpr std::array<std::string_view, 5> with_colon{"code", "codium", "subl", "zed", "hx"};
    std::vector<std::string> command;
    std::istringstream words(editor);
    for (std::string word; words >> word;) command.push_back(word);
    if (command.empty()) return command;
    const std::string name = std::filesystem::path(command[0]).filename().string(), at = std::to_string(line);
    const auto any_of = [&](const auto& names) { return std::ranges::find(names, name) != names.end(); };
    if (any_of(with_colon)) {
        if (name == "code" || name == "codium") command.emplace_back("--goto");
        command.push_back(file + ":" + at);
    } else {
        command.push_back("+" + at);
        command.push_back(file);
    }
    if (any_of(in_terminals)) command.insert(command.begin(), {terminal, "-e"});
    return command;
}

std::string open_in_editor(const std::string& file, int line) {
    std::string editor = variable("VISUAL"), terminal = variable("TERMINAL");
    if (editor.empty()) editor = variable("EDITOR");
    if (terminal.empty()) terminal = "x-terminal-emulator";
    const std::vector<std::string> command = editor_command(editor, terminal, file, line);
    if (command.empty())
        return "no editor is known: set EDITOR, as in EDITOR=gedit; this body is in line " + std::to_string(line);
    return os::start_apart(command) ? "" : "the editor cannot be started: there is no '" + command[0] + "'";
}

}  // namespace strahl
