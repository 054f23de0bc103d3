#include "pov/ini_file.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "files/error.h"
#include "files/read_file.h"
#include "files/utf8.h"
#include "files/words.h"

namespace strahl::pov {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_ini_text = 1 << 20;

/// The switches that stand for options. A longer one comes before its beginning.
constexpr std::array switches{std::pair{"KFI", "Initial_Frame"},
                              std::pair{"KFF", "Final_Frame"},
                              std::pair{"KC", "Cyclic_Animation"},
                              std::pair{"KI", "Initial_Clock"},
                              std::pair{"KF", "Final_Clock"},
                              std::pair{"K", "Clock"},
                              std::pair{"EF", "Subset_End_Frame"},
                              std::pair{"SF", "Subset_Start_Frame"},
                              std::pair{"W", "Width"},
                              std::pair{"H", "Height"},
                              std::pair{"I", "Input_File_Name"},
                              std::pair{"L", "Library_Path"}};

bool has_prefix(std::string_view text, std::string_view beginning) {
    return same_word(text.substr(0, beginning.size()), beginning);
}

std::optional<bool> flag_of(std::string_view value) {
    for (const char* word : {"on", "true", "yes", "1"})
        if (same_word(value, word)) return true;
    for (const char* word : {"off", "false", "no", "0"})
        if (same_word(value, word)) return false;
    return std::nullopt;
}

class IniReader {
  public:
    IniReader(std::string_view text, const std::string& path, std::string_view section) : text(text), wanted(section) {
        ini.path = path;
    }

    IniFile run() {
        while (at < text.size()) line();
        std::string said;
        if (!over.empty()) said = ini.path + ": read over: " + listed(over);
        if (!commands.empty())
            said += (said.empty() ? ini.path + ": " : "; ") + listed(commands) + ": commands are never run";
        if (!said.empty()) ini.notes.push_back(said);
        return std::move(ini);
    }
    bool found_section() const { return wanted.empty() || found; }

  private:
    bool at_end() const { return at == text.size() || text[at] == '\n' || text[at] == '\r'; }
    bool at_comment() const { return text[at] == ';' || text[at] == '#'; }
    void skip_blanks() {
        while (!at_end() && is_space(text[at])) ++at;
    }
    /// Takes what stands up to one of these characters, or to the end of the line.
    std::string_view until(std::string_view ends) {
        const std::size_t begin = at;
        while (!at_end() && ends.find(text[at]) == ends.npos) ++at;
        return text.substr(begin, at - begin);
    }
    /// Takes a value: what stands in quotes, or up to a comment or, unless it is one with blanks, a blank.
    std::string_view value(bool blanks) {
        skip_blanks();
        if (at_end()) return {};
        if (const char quote = text[at]; quote == '"' || quote == '\'') {
            ++at;
            const std::string_view inside = until({&quote, 1});
            if (!at_end()) ++at;
            return inside;
        }
        std::string_view plain = until(blanks ? ";#" : ";#, \t");
        while (!plain.empty() && is_space(plain.back())) plain.remove_suffix(1);
        return plain;
    }

    void line() {
        skip_blanks();
        if (at_end()) return void(++at);
        if (text[at] == '[') {
            ++at;
            const std::string_view name = until("]");
            own = same_word(name, wanted) && !wanted.empty();
            found |= own;
        } else if (own && !at_comment()) {
            if (text[at] == '+' || text[at] == '-') return one_switch();
            const std::string_view name = until("=;# \t\"'");
            skip_blanks();
            if (!at_end() && text[at] == '=') {
                ++at;
                option(name, value(takes_blanks(name)));
            } else if (fs::path(name).has_extension() && ini.scene.empty()) {
                ini.scene = name;  // a name alone is that of the scene
            } else {
                over_read(name.empty() ? until(" \t") : name);
            }
        }
        until("");
    }
    /// Reads a switch: several may stand in a line.
    void one_switch() {
        const bool on = text[at++] == '+';
        const std::string_view word = until(";# \t\"'");
        const auto known =
            std::ranges::find_if(switches, [&](const auto& each) { return has_prefix(word, each.first); });
        if (known != switches.end() && (on || same_word(known->second, "Cyclic_Animation"))) {
            std::string_view rest = word.substr(std::string_view(known->first).size());
            if (rest.empty() && !at_end() && (text[at] == '"' || text[at] == '\'')) rest = value(false);
            option(known->second, same_word(known->second, "Cyclic_Animation") ? (on ? "on" : "off") : rest);
        } else if (has_prefix(word, "A") && (word.size() == 1 || std::string_view(".0123456789").find(word[1]) < 11)) {
            ini.antialias = on;
        } else if (same_word(word, "UA")) {
            ini.alpha = on;
        } else {
            over_read(word);
        }
    }
    static bool takes_blanks(std::string_view name) {
        return has_prefix(name, "Pre_") || has_prefix(name, "Post_") || name.ends_with("_Command") ||
               same_word(name, "Input_File_Name") || same_word(name, "Library_Path");
    }
    void over_read(std::string_view name) {
        const std::string shown = strahl::quoted(name), word = shown.substr(1, shown.size() - 2);
        std::vector<std::string>& list =
            name.size() > 8 && same_word(name.substr(name.size() - 8), "_Command") ? commands : over;
        if (list.size() < 100 && std::ranges::find(list, word) == list.end()) list.push_back(word);
    }

    void option(std::string_view name, std::string_view word) {
        double number = 0;
        const bool is_number = read_number(word, number) && number >= -1e9 && number <= 1e9;
        const auto is = [&](const char* known) { return same_word(name, known); };
        const auto take = [&](auto& field, double least) {
            if (!is_number || number < least) return over_read(name);
            field = static_cast<typename std::remove_reference_t<decltype(field)>::value_type>(number);
        };
        if (is("Input_File_Name")) {
            ini.scene = word;
        } else if (is("Library_Path")) {
            ini.library.emplace_back(word);
        } else if (is("Width")) {
            take(ini.width, 1);
        } else if (is("Height")) {
            take(ini.height, 1);
        } else if (is("Antialias")) {
            ini.antialias = flag_of(word);
        } else if (is("Output_Alpha")) {
            ini.alpha = flag_of(word);
        } else if (is("Initial_Frame")) {
            take(ini.initial_frame, 0);
        } else if (is("Final_Frame")) {
            take(ini.final_frame, 0);
        } else if (is("Subset_Start_Frame")) {
            take(ini.subset_start, 0);
        } else if (is("Subset_End_Frame")) {
            take(ini.subset_end, 0);
        } else if (is("Clock")) {
            take(ini.clock, -1e9);
        } else if (is("Initial_Clock")) {
            take(ini.initial_clock, -1e9);
        } else if (is("Final_Clock")) {
            take(ini.final_clock, -1e9);
        } else if (is("Cyclic_Animation")) {
            ini.cyclic = flag_of(word).value_or(false);
        } else if (is("Declare")) {
            const std::size_t equal = word.find('=');
            const std::string_view value = equal == word.npos ? std::string_view() : word.substr(equal + 1);
            if (read_number(value, number) && ini.declared.size() < 1000)
                ini.declared.emplace_back(word.substr(0, equal), number);
            else
                over_read(name);
        } else {
            over_read(name);
        }
    }

    std::string_view text, wanted;
    IniFile ini;
    std::vector<std::string> over, commands;  // options that are read over
    std::size_t at = 0;
    bool own = true, found = false;  // `own`: in the wanted section, or before all of them
};

/// Cuts "film.ini[fast]" into the path and the name of the section.
std::pair<std::string, std::string> cut(const std::string& path) {
    const std::size_t open = path.rfind('[');
    if (!path.ends_with(']') || open == path.npos) return {path, ""};
    return {path.substr(0, open), path.substr(open + 1, path.size() - open - 2)};
}

/// Returns the path of the scene that a file names, which lies in the file's folder or below; empty if there is none.
std::string scene_of(const IniFile& ini) {
    std::string name = ini.scene;
    std::ranges::replace(name, '\\', '/');
    const fs::path own(name);
    if (own.is_absolute() || std::ranges::find(own, fs::path("..")) != own.end()) return "";
    for (const std::string& each : {name, name + ".pov", name + ".POV"}) {
        const fs::path path = fs::path(ini.path).parent_path() / each;
        std::error_code error;
        if (fs::is_regular_file(path, error)) return path.string();
    }
    return "";
}

}  // namespace

bool is_ini(std::string_view path) {
    if (path.ends_with(']')) path = path.substr(0, path.rfind('['));
    return path.ends_with(".ini") || path.ends_with(".INI");
}

IniFile parse_ini(std::string_view text, const std::string& path, std::string_view section) {
    IniReader reader(utf8_text(text, path), path, section);
    IniFile ini = reader.run();
    if (!reader.found_section()) throw FileError(path + ": there is no section " + strahl::quoted(section));
    return ini;
}

IniFile read_ini(const std::string& path) {
    const auto [file, section] = cut(path);
    IniFile ini = parse_ini(read_text(file, most_ini_text), file, section);
    if (ini.scene.empty()) throw FileError(file + ": no scene: 'Input_File_Name=FILE.pov' expected");
    const std::string found = scene_of(ini);
    if (found.empty())
        throw FileError(file + ": there is no scene " + strahl::quoted(ini.scene) +
                        " in this file's folder, to which .ini files are restricted");
    ini.scene = found;
    return ini;
}

std::optional<IniFile> ini_beside(const std::string& scene) {
    const std::string path = beside(scene, ".ini");
    std::error_code error;
    if (scene == "-" || !fs::is_regular_file(path, error) || fs::file_size(path, error) > most_ini_text || error)
        return std::nullopt;
    IniFile ini = parse_ini(read_text(path, most_ini_text), path);
    if (ini.scene.empty()) ini.scene = scene;
    if (const std::string named = scene_of(ini); ini.scene != scene && !fs::equivalent(named, scene, error))
        return std::nullopt;
    ini.scene = scene;
    return ini;
}

std::string beside(const std::string& scene, const char* ending) {
    return fs::path(scene).replace_extension(ending).string();
}

}  // namespace strahl::pov
