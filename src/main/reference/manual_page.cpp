// Writes the manual page in roff.
#include <array>

#include "files/streams.h"
#include "main/reference/reference.h"

namespace strahl {
namespace {

/// Escapes text for roff: no character has a special meaning, and no line begins with a request.
std::string roff(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
        if (c == '\n') result += "\\&";
    }
    return "\\&" + result;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string listed(const OptionText& option) {
    std::string names;
    for (const std::string& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
    if (!option.form.empty()) names += " " + italic(option.form);
    return ".TP\n" + names + "\n" + roff(option.help) + ".\n";
}

/// Returns the lines of a footer: those with columns, which two blanks divide, as they are, others as paragraphs.
std::string footer(const std::string& text) {
    std::string result;
    bool columns = false;
    WordStream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool now = line.find("  ") != line.npos;
        if (result.empty() || now != columns) result += columns ? ".fi\n.PP\n" : ".PP\n";
        if (now && (result.ends_with(".PP\n"))) result += ".nf\n";
        columns = now;
        result += roff(line) + "\n";
    }
    return result + (columns ? ".fi\n" : "");
}

/// Files and variables that no option names.
struct Mention {
    const char *name, *text;
};
constexpr std::array files{
    Mention{"SCENE.tracks", "The keys of the tracks of SCENE.rt, beside it"},
    Mention{"FILE.checkpoint", "The finished part of a picture that is being rendered; --resume continues from it"},
    Mention{"NAME.part.ENDING", "The finished part of a picture or a film that was interrupted"},
    Mention{"FILE.part-K-of-N", "What --part K/N makes, for strahl join"},
    Mention{".strahl-*", "A file that is being written, in the folder of its final name"},
    Mention{"~/.local/state/strahl/window", "Place and size of the window"},
    Mention{"~/.config/strahl/keys", "Keys of the window, as strahl view --list-keys prints them"},
    Mention{"~/.local/state/strahl/recent", "The scenes that were opened last"},
    Mention{"share/strahl/scenes", "Example scenes, beside the bin folder of the program"},
    Mention{"share/doc/strahl/language.md", "The language of scenes"},
};
constexpr std::array variables{
    Mention{"PATH", "Where ffmpeg, for films, and povray, for crosscheck, are found"},
    Mention{"TMPDIR", "Folder for the temporary files of crosscheck, /tmp by default"},
    Mention{"XDG_CONFIG_HOME", "Folder for strahl/keys, ~/.config by default"},
    Mention{"XDG_STATE_HOME", "Folder for what the window remembers, ~/.local/state by default"},
};
template <class Mentions>
std::string listed(const char* heading, const Mentions& mentions) {
    std::string text = std::string(".SH ") + heading + "\n";
    for (const auto& [name, meaning] : mentions) text += ".TP\n" + italic(name) + "\n" + roff(meaning) + ".\n";
    return text;
}

}  // namespace

std::string manual_page(const ProgramText& program) {
    TextStream page;
    page << ".TH STRAHL 1 \"\" \"strahl " << program.version << "\" \"User Commands\"\n.SH NAME\nstrahl \\- "
         << "render and fly through scenes, fast and exactly\n.SH SYNOPSIS\n.B strahl\n"
         << italic("SCENE") << '\n';
    for (const CommandText& command : program.commands) {
        page << ".br\n" << bold("strahl " + command.name);
        for (const OptionText& argument : command.arguments) page << ' ' << italic(argument.names[0]);
        page << " [" << italic("OPTION") << "...]\n";
    }
    page << ".SH DESCRIPTION\n" << roff(program.self.help) << '\n' << ".SH OPTIONS\n";
    for (const OptionText& option : program.self.options) page << listed(option);
    page << ".SH COMMANDS\n";
    for (const CommandText& command : program.commands) {
        page << ".SS " << bold(command.name) << '\n' << roff(command.help) << ".\n";
        for (const OptionText& argument : command.arguments)
            page << ".TP\n" << italic(argument.names[0]) << '\n' << roff(argument.help) << ".\n";
        for (const OptionText& option : command.options) page << listed(option);
        page << footer(command.footer);
    }
    page << ".SH EXIT STATUS\n"
         << footer(program.self.footer) << listed("FILES", files) << listed("ENVIRONMENT", variables)
         << ".SH SEE ALSO\n.BR povray (1)\n";
    return page.str();
}

}  // namespace strahl
