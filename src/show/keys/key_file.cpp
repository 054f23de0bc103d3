#include "show/keys/key_file.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "files/error.h"
#include "files/os/user_file.h"
#include "files/regular_file.h"
#include "files/words.h"
#include "text/reading/messages.h"

namespace strahl {
namespace {

constexpr std::size_t most_bytes = 1 << 16;

/// Takes the next word off a line; "" at its end or before a comment.
std::string_view next_word(std::string_view& line) {
    while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
    if (line.starts_with("//")) return line.substr(0, 0);
    const auto end = std::ranges::find_if(line, is_space);
    const std::string_view word = line.substr(0, static_cast<std::size_t>(end - line.begin()));
    line.remove_prefix(word.size());
    return word;
}

/// Why this command cannot have this key, or "".
std::string objection(const Command& command, const KeyPress& key) {
    const bool camera = command.action == Action::recall || command.action == Action::store;
    if (camera != (key.code == KeyPress::digits && !key.character))
        return camera ? "cameras have the keys 1-9, alone or as Ctrl+1-9 and so on"
                      : "1-9 are for the commands 'recall' and 'store'";
    if (command.action == Action::move && (key.modifiers != 0 || key.character))
        return "movements have single keys, without Ctrl and the like, that are not characters such as +";
    return "";
}

/// The keys that a line gives to a command.
struct KeyLine {
    std::size_t command;
    std::string_view word;
    std::vector<std::pair<std::string_view, KeyPress>> keys;
};

/// Reads a line. Nothing if it is empty or has an error.
std::optional<KeyLine> read_line(std::string_view line, Diagnostics& diagnostics) {
    const std::string_view word = next_word(line);
    if (word.empty()) return std::nullopt;
    const auto text = std::ranges::find_if(command_helps, [&](const CommandHelp& t) { return word == t.word; });
    if (text == command_helps.end()) {
        std::vector<std::string_view> known;
        for (const CommandHelp& t : command_helps)
            if (*t.word) known.emplace_back(t.word);
        const std::string_view meant = nearest(word, known);
        diagnostics.add(word, "unknown command " + quoted(word) +
                                  (meant.empty() ? "; strahl view --list-keys prints all"
                                                 : "; did you mean '" + std::string(meant) + "'?"));
        return std::nullopt;
    }
    if (const std::string_view sign = next_word(line); sign != "=") {
        diagnostics.add(sign, "expected '=' and keys, as in '" + std::string(text->word) + " = " + text->keys + "'");
        return std::nullopt;
    }
    KeyLine read{static_cast<std::size_t>(text - command_helps.begin()), word, {}};
    for (std::string_view name = next_word(line); !name.empty(); name = next_word(line)) {
        const auto key = key_press(name);
        const std::string why =
            key ? objection(text->command, *key)
                : "unknown key " + quoted(name) + "; keys are F, Ctrl+S, Shift+F12, PageUp, Space, + and the like";
        if (!why.empty()) return diagnostics.add(name, why), std::nullopt;
        read.keys.emplace_back(name, *key);
    }
    return read;
}

}  // namespace

std::string keys_file() { return os::user_file("XDG_CONFIG_HOME", ".config", "strahl/keys"); }

KeysRead keys_in(std::string_view text, const std::string& file) {
    KeysRead result;
    Diagnostics diagnostics(text, file);
    std::vector<KeyLine> lines;
    try {
        diagnostics.check_encoding();
        for (std::string_view rest = text; !rest.empty();) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(line.size() + 1, rest.size()));
            auto read = read_line(line, diagnostics);
            if (!read) continue;
            const auto before = std::ranges::find(lines, read->command, &KeyLine::command);
            if (before != lines.end())
                diagnostics.add(read->word, "'" + std::string(read->word) + "' has its keys in " +
                                                diagnostics.line(before->word) + "; put all into one line");
            else
                lines.push_back(std::move(*read));
        }
        for (const KeyLine& line : lines) result.keys.keys[line.command].clear();
        for (const KeyLine& line : lines)
            for (const auto& [name, key] : line.keys) {
                const auto has = [&](const auto& keys) { return std::ranges::find(keys, key) != keys.end(); };
                const auto holder = std::ranges::find_if(result.keys.keys, has);
                if (holder == result.keys.keys.end()) {
                    result.keys.keys[line.command].push_back(key);
                    continue;
                }
                const auto other = static_cast<std::size_t>(holder - result.keys.keys.begin());
                const std::string word = command_helps[other].word;
                const auto given = std::ranges::find(lines, other, &KeyLine::command);
                if (given != lines.end()) {
                    diagnostics.add(name, std::string(name) + " is the key of '" + word + "' in " +
                                              diagnostics.line(given->word) + " already");
                    continue;
                }
                std::erase(*holder, key);
                result.keys.keys[line.command].push_back(key);
                diagnostics.add(name, std::string(name) + " means '" + word +
                                          "' no longer; say which keys that has now: '" + word + " = " +
                                          text_of(*holder) + "'");
            }
        diagnostics.check();
    } catch (const FileError& error) {
        result.faults = error.what();
    }
    return result;
}

KeysRead user_keys() {
    const std::string file = keys_file();
    std::error_code error;
    if (file.empty() || !std::filesystem::exists(file, error)) return {};
    try {
        return keys_in(RegularFile(file).bytes(0, most_bytes), file);
    } catch (const FileError& fault) {
        return {{}, fault.what()};
    }
}

std::string write_keys(const KeyMap& keys) {
    std::string text =
        "// The keys of strahl's window. Lines in " + keys_file() + " change them; H in the window lists them.\n";
    for (std::size_t i = 0; i < command_helps.size(); ++i) {
        const auto& [word, usual, meaning, command] = command_helps[i];
        if (!*meaning) text += "\n// " + std::string(usual) + "\n";
        if (!*word) continue;
        std::string line = word + (" = " + text_of(keys.keys[i]));
        line.resize(std::max<std::size_t>(line.size(), 34), ' ');
        text += line + "  // " + meaning + "\n";
    }
    return text;
}

std::vector<HelpRow> help_rows(const KeyMap& keys, std::string_view words) {
    const auto small = [](std::string text) {
        std::ranges::transform(text, text.begin(), lower);
        return text;
    };
    const std::string sought = small(std::string(words));
    std::vector<HelpRow> rows;
    for (std::size_t i = 0; i < command_helps.size(); ++i) {
        const auto& [word, usual, meaning, command] = command_helps[i];
        const bool heading = !*meaning;
        HelpRow row{*word ? text_of(keys.keys[i]) : usual, meaning};
        if (row.keys.empty()) row.keys = "(none)";
        const std::string all = small(row.keys + " " + meaning + " " + word);
        bool found = !heading || sought.empty();
        std::string_view rest = sought;
        while (!rest.empty()) {
            const std::string_view next = rest.substr(0, rest.find(' '));
            found &= all.find(next) != all.npos;
            rest.remove_prefix(std::min(next.size() + 1, rest.size()));
        }
        if (found) rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace strahl
