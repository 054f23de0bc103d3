// What the options say about themselves, as plain text. Only main.cpp may include this, as options.h.
#pragma once
#include "main/options/options.h"
#include "main/reference/reference.h"
#include "text/manual/syntax.h"

namespace strahl {

inline CommandText text_of(const CLI::App& command) {
    CommandText text{command.get_name(), command.get_description(), command.get_footer()};
    for (const CLI::Option* option : command.get_options()) {
        OptionText own{{}, option->get_type_name(), option->get_description()};
        if (option->get_items_expected_max() == 0 || own.form == " ") own.form.clear();
        if (option->get_positional()) {
            own.names = {option->get_name(true)};
            text.arguments.push_back(own);
            continue;
        }
        for (const std::string& name : option->get_snames()) own.names.push_back("-" + name);
        for (const std::string& name : option->get_lnames()) own.names.push_back("--" + name);
        if (const auto words = words_of(*option)) own.words = *words;
        text.options.push_back(own);
    }
    return text;
}

/// `--reference KIND`: prints what other programs read, and ends.
inline void add_reference(CLI::App& app, const char* version) {
    const auto print = [&app, version](const std::string& kind) {
        ProgramText program{version, text_of(app), {}};
        for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
            program.commands.push_back(text_of(*command));
        const std::string text = kind == "man"    ? manual_page(program)
                                 : kind == "bash" ? bash_completion(program)
                                 : kind == "zsh"  ? zsh_completion(program)
                                 : kind == "fish" ? fish_completion(program)
                                 : kind == "vim"  ? vim_syntax()
                                                  : textmate_grammar();
        std::fputs(text.c_str(), stdout);
        throw CLI::Success();
    };
    app.add_option_function<std::string>(
           "--reference", print,
           "Print the manual page (man), completions (bash, zsh, fish) or syntax highlighting (vim, textmate)")
        ->check(one_of({"man", "bash", "zsh", "fish", "vim", "textmate"}))
        ->type_name("KIND")
        ->trigger_on_parse();
}

}  // namespace strahl
