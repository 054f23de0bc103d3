#include <algorithm>

#include "files/streams.h"
#include "main/process/shell.h"
#include "main/reference/reference.h"

namespace strahl {
namespace {

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
    return all;
}

bool takes_file(const OptionText& option) { return option.form == "FILE" || option.form == "DIR"; }

/// "-o|--output"
std::string alternatives(const OptionText& option) {
    std::string all;
    for (const std::string& name : option.names) all += (all.empty() ? "" : "|") + name;
    return all;
}

/// Up to the first end of a clause, so that it fits on a line.
std::string brief(const std::string& help) { return help.substr(0, help.find_first_of(";:,(")); }

std::vector<std::string> names_of(const std::vector<CommandText>& commands) {
    std::vector<std::string> names;
    for (const CommandText& command : commands) names.push_back(command.name);
    return names;
}

}  // namespace

std::string bash_completion(const ProgramText& program) {
    TextStream script;
    script << "# Completion of strahl's commands and options for bash.\n_strahl() {\n"
              "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options\n"
              "    COMPREPLY=()\n    if ((COMP_CWORD == 1)); then\n        options=\""
           << joined(names_of(program.commands)) << ' ';
    for (const OptionText& option : program.self.options) script << joined(option.names) << ' ';
    script << "\"\n        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\"; compgen -f -X '!*.rt' -- "
              "\"$word\"; compgen -d -- \"$word\")\n        return\n    fi\n    case ${COMP_WORDS[1]} in\n";
    for (const CommandText& command : program.commands) {
        script << "    " << command.name << ")\n        case $before in\n";
        std::string options;
        for (const OptionText& option : command.options) {
            options += joined(option.names) + ' ';
            if (!option.words.empty())
                script << "        " << alternatives(option) << ") mapfile -t COMPREPLY < <(compgen -W \""
                       << joined(option.words) << "\" -- \"$word\"); return ;;\n";
            else if (!option.form.empty() && !takes_file(option))
                script << "        " << alternatives(option) << ") return ;;\n";
        }
        script << "        esac\n        options=\"" << options << "\" ;;\n";
    }
    script << "    esac\n    if [[ $word == -* ]]; then\n        mapfile -t COMPREPLY < <(compgen -W \"$options\" -- "
              "\"$word\")\n    else\n        mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n    fi\n}\n"
              "complete -o filenames -F _strahl strahl\n";
    return script.str();
}

std::string zsh_completion(const ProgramText& program) {
    // zsh ends a description at brackets and divides it at colons.
    const auto plain = [](std::string text) {
        std::erase_if(text, [](char c) { return c == '[' || c == ']' || c == ':'; });
        return text;
    };
    const auto spec = [&](const OptionText& option, const std::string& name) {
        std::string text = name + "[" + plain(brief(option.help)) + "]";
        if (!option.words.empty())
            text += ":" + option.form + ":(" + joined(option.words) + ")";
        else if (!option.form.empty())
            text += ":" + option.form + ":" + (takes_file(option) ? "_files" : "");
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
        script << " \\\n            '*:file:_files' ;;\n";
    }
    script << "    esac\n}\n_strahl \"$@\"\n";
    return script.str();
}

std::string fish_completion(const ProgramText& program) {
    const auto quote = [](const std::string& text) { return in_shell_quotes(text, "\\'"); };
    const std::string names = joined(names_of(program.commands));
    TextStream script;
    script << "# Completion of strahl's commands and options for fish.\n";
    const auto add = [&](const std::string& condition, const OptionText& option) {
        script << "complete -c strahl -n " << quote(condition);
        for (const std::string& name : option.names)
            script << (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
        if (!option.words.empty())
            script << " -x -a " << quote(joined(option.words));
        else if (!option.form.empty())
            script << (takes_file(option) ? " -r" : " -x");
        script << " -d " << quote(brief(option.help)) << '\n';
    };
    for (const OptionText& option : program.self.options) add("not __fish_seen_subcommand_from " + names, option);
    for (const CommandText& command : program.commands) {
        script << "complete -c strahl -n " << quote("not __fish_seen_subcommand_from " + names) << " -a "
               << command.name << " -d " << quote(command.help) << '\n';
        for (const OptionText& option : command.options) add("__fish_seen_subcommand_from " + command.name, option);
    }
    return script.str();
}

}  // namespace strahl
