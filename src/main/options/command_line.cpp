// Parses the command line with CLI11; explains wrong ones; prints the reference that other programs read.
#include "main/options/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/error.h"
#include "files/os/system.h"
#include "files/shell.h"
#include "files/streams.h"
#include "main/commands/command_view.h"
#include "main/options/options.h"
#include "main/reference/reference.h"
#include "text/manual/syntax.h"
#include "text/reading/messages.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

/// "strahl 0.1.0 for Linux (x86-64-v4, 16 float lanes, 8 double)"
std::string version() {
    const Simd simd = best_simd();
    TextStream text;
    text << "strahl " STRAHL_VERSION " for " << os::system_name() << " (" << name(simd) << ", "
         << lanes(Precision::float32, simd) << " float lanes, " << lanes(Precision::float64, simd) << " double)";
    return text.str();
}

/// Breaks the lines of --help where the terminal ends.
class WrappedHelp : public CLI::Formatter {
  public:
    std::string make_option_desc(const CLI::Option* option) const override {
        const std::string text = CLI::Formatter::make_option_desc(option);
        const std::size_t names = get_column_width(), columns = static_cast<std::size_t>(os::terminal_columns());
        if (columns < names + 20) return text;  // no terminal, or one that is too narrow
        return wrapped(text, columns - names);
    }

  private:
    /// Breaks `text` between words into lines of up to `width` bytes.
    static std::string wrapped(std::string text, std::size_t width) {
        for (std::size_t start = 0; text.size() - start > width;) {
            std::size_t space = text.rfind(' ', start + width);
            if (space == text.npos || space <= start) space = text.find(' ', start);  // a long word
            if (space == text.npos) break;
            text[space] = '\n';
            start = space + 1;
        }
        return text;
    }
};

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

CommandText described(const CLI::App& command) {
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

/// `--reference KIND`: prints a text for other programs, and ends.
void add_reference(CLI::App& app) {
    const auto print = [&app](const std::string& kind) {
        ProgramText program{STRAHL_VERSION, described(app), {}};
        for (const CLI::App* command : commands_of(app)) program.commands.push_back(described(*command));
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

/// Makes `strahl SCENE` mean `strahl view SCENE`, and the usual words for help and the version mean these options.
std::vector<std::string> with_command(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const std::string first = arguments[0];
    const auto commands = commands_of(app);
    const bool known = std::ranges::any_of(commands, [&](auto* command) { return command->get_name() == first; });
    const auto is_file = [&] {
        std::error_code error;
        return std::filesystem::exists(first, error) && !std::filesystem::is_directory(first, error);
    };
    // The disk is asked last: it may give no answer, which the window says.
    const bool scene = first == "-" || first.ends_with(".rt") || pov::is_ini(first) ||
                       (!first.starts_with('-') && !known && is_file());
    if (!known && scene) {
        arguments.insert(arguments.begin(), "view");
    } else if (first == "help") {
        arguments.erase(arguments.begin());
        arguments.push_back("--help");
    } else if (first == "version" || first == "-v" || first == "-V") {
        arguments[0] = "--version";
    }
    return arguments;
}

/// Replaces CLI11's message about unexpected arguments by one with advice.
void require_known_command(const CLI::App& app, std::string_view word) {
    if (word.starts_with('-')) return;
    std::vector<std::string_view> known;
    for (const CLI::App* command : commands_of(app)) known.push_back(command->get_name());
    if (std::ranges::find(known, word) != known.end()) return;
    std::string advice;
    if (const std::string_view meant = nearest(word, known); !meant.empty())
        advice = "; did you mean '" + std::string(meant) + "'?";
    else
        for (const auto name : known) (advice += advice.empty() ? "; the commands are " : ", ") += name;
    throw UsageError("there is no command " + strahl::quoted(word) + advice +
                     "\nTo render a scene: strahl render SCENE -o FILE");
}

/// Returns "; did you mean '--size'?" for an argument that looks like an option of the command, or nothing.
std::string nearest_option(const CLI::App& command, const std::string& argument) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) names.push_back(option->get_name());
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string meant(argument.starts_with('-') ? nearest(argument, known) : "");
    return meant.empty() ? "" : "; did you mean '" + meant + "'?";
}

/// Returns advice on an option that other commands have: "; did you mean strahl render a.rt -o a.png?" for a window
/// that was asked for by `strahl a.rt`, else "; strahl render has it". Empty if no command has it.
std::string other_commands(const CLI::App& app, const std::string& option, const std::vector<std::string>& given) {
    std::string has;
    for (const CLI::App* command : commands_of(app)) {
        if (!command->get_option_no_throw(option)) continue;
        if (command->get_name() == "render" && !given.empty()) {
            std::string meant = "; did you mean strahl render";
            for (const std::string& word : given)
                meant += " " + (word.find_first_of(" '\"\\$*?&;<>()|`") == word.npos ? word : in_shell_quotes(word));
            return meant + "?";
        }
        has += (has.empty() ? "; strahl " : ", ") + command->get_name();
    }
    return has.empty() ? "" : has + (has.find(',') == has.npos ? " has it" : " have it");
}

/// Explains a wrong command line. `given` are the arguments as they were typed if these name no command, else none.
[[noreturn]] void report_usage(const CLI::App& app, const CLI::ParseError& error,
                               const std::vector<std::string>& given) {
    const auto chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen[0];
    std::string message = error.what();
    // CLI11 leaves over both words of `--sizes 640x480`, in any order; the option is the wrong one.
    auto left = command.remaining();
    std::ranges::stable_partition(left, [](const std::string& argument) { return argument.starts_with('-'); });
    if (!left.empty()) {
        const std::string option = left[0].substr(0, left[0].find('='));
        std::string advice = option.starts_with('-') ? other_commands(app, option, given) : "";
        if (advice.empty()) advice = nearest_option(command, option);
        message = strahl::quoted(left[0]) + " is not expected here" + advice;
    }
    throw UsageError(message + "\nSee: strahl " + (chosen.empty() ? "" : command.get_name() + " ") + "--help");
}

}  // namespace

int run_command_line(int argc, char** argv) {
    CLI::App app{"Strahl, a fast and exact ray tracer.", "strahl"};
    app.allow_windows_style_options(false);  // /x/a.rt is a path
    app.set_version_flag("--version", version, "Print the version and the SIMD level in use");
    app.set_help_flag("-h,--help", "Print this help; strahl COMMAND --help describes a command");
    add_reference(app);
    app.require_subcommand(1);
    const auto help = std::make_shared<WrappedHelp>();
    help->column_width(26);
    app.formatter(help);
    ChosenCommand chosen;
    add_commands(app, chosen);
    app.footer(
        "strahl SCENE  opens a scene in a window\n"
        "strahl        shows a gallery of scenes\n\n"
        "Exit status: 0 done, 1 failed, 2 wrong usage, 3 error in a file, 130 interrupted.\n"
        "Example: strahl render SCENE.rt -o picture.png");
    if (argc < 2 && !window_possible()) throw UsageError("no command given\n" + app.help());
    std::vector<std::string> arguments = argc < 2 ? std::vector<std::string>{"view"} : with_command(app, argc, argv);
    require_known_command(app, arguments[0]);
    const bool omitted = arguments.size() == static_cast<std::size_t>(argc);  // the word `view`
    const std::vector<std::string> given(argv + 1, omitted ? argv + argc : argv + 1);
    std::ranges::reverse(arguments);  // as CLI11 takes them
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::Success& wanted) {  // --help and --version
        return app.exit(wanted);
    } catch (const CLI::ParseError& error) {
        report_usage(app, error, given);
    }
    return chosen();
}

}  // namespace strahl
