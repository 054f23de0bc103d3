#include <algorithm>
#include <cctype>

#include "files/shell.h"
#include "files/streams.h"
#include "main/reference/reference.h"

namespace strahl {
namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
    return all;
}

bool takes_file(const OptionText& option) { return option.form == "FILE" || option.form == "DIR"; }

/// Returns the endings of files that a help text names: ".bmp", ".png" and ".exr" of "The picture: .bmp, .png or .exr".
std::vector<std::string> endings_in(const std::string& help) {
    std::vector<std::string> endings;
    for (std::size_t dot = help.find('.'); dot != help.npos; dot = help.find('.', dot + 1)) {
        std::size_t end = dot + 1;
        while (end < help.size() && std::isalnum(static_cast<unsigned char>(help[end]))) ++end;
        if (end > dot + 1 && dot > 0 && help[dot - 1] == ' ') endings.push_back(help.substr(dot, end - dot));
    }
    return endings;
}
/// Returns the endings of the files that a command takes as arguments.
std::vector<std::string> endings_of(const CommandText& command) {
    std::vector<std::string> endings;
    for (const OptionText& argument : command.arguments)
        for (const std::string& ending : endings_in(argument.help))
            if (std::ranges::find(endings, ending) == endings.end()) endings.push_back(ending);
    return endings;
}

/// "-o|--output"
std::string alternatives(const OptionText& option) {
    std::string all;
    for (const std::string& name : option.names) all += (all.empty() ? "" : "|") + name;
    return all;
}

/// Cuts a help text off at the end of its first clause, so that it fits on a line.
std::string brief(const std::string& help) { return help.substr(0, help.find_first_of(";:,(")); }

std::vector<std::string> names_of(const std::vector<CommandText>& commands) {
    std::vector<std::string> names;
    for (const CommandText& command : commands) names.push_back(command.name);
    return names;
}

}  // namespace

std::string bash_completion(const ProgramText& program) {
    TextStream script;
    const auto cases = [&](const std::vector<OptionText>& options, const char* indent) {
        for (const OptionText& option : options) {
            if (option.form.empty()) continue;
            script << indent << alternatives(option) << ") ";
            if (!option.words.empty())
                script << "_strahl_words " << joined(option.words) << "; ";
            else if (option.form == "DIR")
                script << "mapfile -t COMPREPLY < <(compgen -d -- \"$word\"); ";
            else if (takes_file(option))
                script << "_strahl_files " << joined(endings_in(option.help)) << "; ";
            script << "return ;;\n";
        }
    };
    const auto all_options = [](const std::vector<OptionText>& options) {
        std::string all;
        for (const OptionText& option : options) all += " " + joined(option.names);
        return all;
    };
    script << "# Completion of strahl's commands and options for bash.\n"
              "_strahl_words() { mapfile -t COMPREPLY < <(compgen -W \"$*\" -- \"$word\"); }\n"
              "# Files that end in one of these, or any file, and folders.\n"
              "_strahl_files() {\n    local ending\n"
              "    (($#)) || { mapfile -t COMPREPLY < <(compgen -f -- \"$word\"); return; }\n"
              "    mapfile -t COMPREPLY < <(compgen -d -- \"$word\"\n"
              "        for ending; do compgen -f -X \"!*$ending\" -- \"$word\"; done)\n}\n"
              "_strahl() {\n"
              "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}\n    COMPREPLY=()\n"
              "    # bash takes the = of --option=value for a word.\n"
              "    if [[ $word == = ]]; then\n        word=''\n    elif [[ $before == = ]]; then\n"
              "        before=${COMP_WORDS[COMP_CWORD - 2]}\n    fi\n"
              "    case $before in\n";
    cases(program.self.options, "    ");
    script << "    esac\n    if ((COMP_CWORD == 1)); then\n        local files commands=(";
    script << joined(names_of(program.commands)) << all_options(program.self.options)
           << ")\n        _strahl_files .rt\n        files=(\"${COMPREPLY[@]}\")\n"
              "        _strahl_words \"${commands[@]}\"\n        COMPREPLY+=(\"${files[@]}\")\n        return\n    fi\n"
              "    case ${COMP_WORDS[1]} in\n";
    for (const CommandText& command : program.commands) {
        script << "    " << command.name << ")\n        case $before in\n";
        cases(command.options, "        ");
        script << "        esac\n        if [[ $word == -* ]]; then\n            _strahl_words"
               << all_options(command.options) << "\n        else\n            _strahl_files "
               << joined(endings_of(command)) << "\n        fi ;;\n";
    }
    script << "    *.*) [[ $word != -* ]] || _strahl_words";  // `strahl SCENE`, which is `strahl view SCENE`
    for (const CommandText& command : program.commands)
        if (command.name == "view") script << all_options(command.options);
    script << " ;;\n    esac\n}\ncomplete -o filenames -F _strahl strahl\n";
    return script.str();
}

std::string zsh_completion(const ProgramText& program) {
    // zsh ends a description at brackets and divides it at colons.
    const auto plain = [](std::string text) {
        std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == ':'; });
        return text;
    };
    const auto files = [](const std::vector<std::string>& endings) {
        std::string some;
        for (const std::string& ending : endings) some += (some.empty() ? "" : "|") + ending.substr(1);
        return some.empty() ? std::string("_files") : "_files -g \"*.(" + some + ")\"";
    };
    const auto spec = [&](const OptionText& option, const std::string& name) {
        std::string text = name + "[" + plain(brief(option.help)) + "]";
        if (!option.words.empty())
            text += ":" + option.form + ":(" + joined(option.words) + ")";
        else if (!option.form.empty())
            text += ":" + option.form + ":" +
                    (option.form == "DIR" ? "_files -/"
                     : takes_file(option) ? files(endings_in(option.help))
                                          : "");
        return in_shell_quotes(text);
    };
    TextStream script;
    script << "#compdef strahl\n# Completion of strahl's commands and options for zsh.\n_strahl() {\n"
              "    local -a commands=(\n";
    for (const CommandText& command : program.commands)
        script << "        " << in_shell_quotes(command.name + ":" + plain(command.help)) << '\n';
    script << "    )\n    if ((CURRENT == 2)); then\n        _describe command commands\n"
              "        _files -g '*.rt'\n        return\n    fi\n    local command=${words[2]}\n    shift words\n"
              "    ((CURRENT--))\n    case $command in\n";
    for (const CommandText& command : program.commands) {
        script << "    " << command.name << ")\n        _arguments";
        for (const OptionText& option : command.options)
            for (const std::string& name : option.names) script << " \\\n            " << spec(option, name);
        script << " \\\n            " << in_shell_quotes("*:file:" + files(endings_of(command))) << " ;;\n";
    }
    for (const OptionText& option : program.self.options)
        if (!option.words.empty())
            script << "    " << alternatives(option) << ") compadd " << joined(option.words) << " ;;\n";
    script << "    esac\n}\n_strahl \"$@\"\n";
    return script.str();
}

std::string fish_completion(const ProgramText& program) {
    const auto quote = [](const std::string& text) { return in_shell_quotes(text, "\\'"); };
    const std::string names = joined(names_of(program.commands));
    TextStream script;
    script << "# Completion of strahl's commands and options for fish.\n";
    const auto files = [](const std::vector<std::string>& endings) {
        std::string some;
        for (const std::string& ending : endings) some += "(__fish_complete_suffix " + ending + ") ";
        return some.substr(0, some.size() - 1);
    };
    const auto add = [&](const std::string& condition, const OptionText& option) {
        script << "complete -c strahl -n " << quote(condition);
        for (const std::string& name : option.names)
            script << (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
        if (!option.words.empty())
            script << " -x -a " << quote(joined(option.words));
        else if (option.form == "DIR")
            script << " -x -a '(__fish_complete_directories)'";
        else if (takes_file(option) && !endings_in(option.help).empty())
            script << " -x -k -a " << quote(files(endings_in(option.help)));
        else if (!option.form.empty())
            script << (takes_file(option) ? " -r" : " -x");
        script << " -d " << quote(brief(option.help)) << '\n';
    };
    for (const OptionText& option : program.self.options) add("not __fish_seen_subcommand_from " + names, option);
    for (const CommandText& command : program.commands) {
        script << "complete -c strahl -n " << quote("not __fish_seen_subcommand_from " + names) << " -a "
               << command.name << " -d " << quote(command.help) << '\n';
        const std::string chosen = "__fish_seen_subcommand_from " + command.name;
        for (const OptionText& option : command.options) add(chosen, option);
        if (const auto endings = endings_of(command); !endings.empty())
            script << "complete -c strahl -n " << quote(chosen) << " -x -k -a " << quote(files(endings)) << '\n';
    }
    return script.str();
}

}  // namespace strahl
