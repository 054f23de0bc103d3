// Writes the manual page in roff.
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

std::string as_is(const std::string& text) { return text.empty() ? "" : ".PP\n.nf\n" + roff(text) + "\n.fi\n"; }

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
        page << as_is(command.footer);
    }
    page << ".SH EXIT STATUS\n" << as_is(program.self.footer) << ".SH SEE ALSO\n.BR povray (1)\n";
    return page.str();
}

}  // namespace strahl
