// Describes the program to other programs: a manual page, and completions for shells.
#pragma once
#include <string>
#include <vector>

namespace strahl {

struct OptionText {
    std::vector<std::string> names;  // "-o", "--output"; of an argument, its name
    std::string form;                // of its value: "FILE"; empty if it has none
    std::string help;
    std::vector<std::string> words{};  // the values that it accepts, if there is a list of them
};

struct CommandText {
    std::string name, help, footer;
    std::vector<OptionText> arguments{}, options{};
};

struct ProgramText {
    std::string version;  // "0.1.0"
    CommandText self;     // its description, and the options before any command
    std::vector<CommandText> commands;
};

/// Returns the page in the language of man (see man-pages(7)), section 1.
std::string manual_page(const ProgramText& program);

/// Return scripts that complete commands, options, their values and file names.
std::string bash_completion(const ProgramText& program);
std::string zsh_completion(const ProgramText& program);
std::string fish_completion(const ProgramText& program);

}  // namespace strahl
