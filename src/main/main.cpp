// The program: its commands and their options. Each command has one function here and one file with its work.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>

#include "files/streams.h"
#include "files/utf8.h"
#include "main/commands/command_check.h"
#include "main/commands/command_compare.h"
#include "main/commands/command_crosscheck.h"
#include "main/commands/command_stability.h"
#include "main/options/options.h"
#include "main/options/options_convert.h"
#include "main/options/options_reference.h"
#include "main/options/options_render.h"
#include "main/options/options_window.h"
#include "main/process/exit_status.h"
#include "main/process/interrupt.h"
#include "scene/error.h"

namespace strahl {
namespace {

void add_check(CLI::App& app, Action& action) {
    auto [command, o] =
        add_command(app, action, "check", "Report errors in a scene, or list what is in it", check_command);
    add_scene(command, o->scene);
    command->add_flag("--print", o->print, "Print the scene as text instead");
}

void add_compare(CLI::App& app, Action& action) {
    auto [command, o] =
        add_command(app, action, "compare", "Report how much two pictures differ; exit status 0 or 1", compare_command);
    add_argument(command, "A", o->a, "A picture file: .bmp, .png or .exr");
    add_argument(command, "B", o->b, "Another picture of the same size");
    command->add_option("--tolerance", o->tolerance, "Difference per channel that counts as equal, 0 by default")
        ->check(numbers(0, 1e9))
        ->type_name("T");
    add_file(command, "--heatmap", o->heatmap, "Write a picture of the differences");
}

int crosscheck_until_interrupted(const CrosscheckOptions& options) {
    const Interrupt interrupt;
    return crosscheck_command(options, interrupt.flag());
}

void add_crosscheck(CLI::App& app, Action& action) {
    auto [command, o] =
        add_command(app, action, "crosscheck", "Render scenes with Strahl and POV-Ray and compare; exit status 0 or 1",
                    crosscheck_until_interrupted);
    add_argument(command, "SCENE", o->scenes, "The scenes, .rt files")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_size(command, o->width, o->height);
    add_time(command, o->time);
    add_depth(command, o->depth);
    add_threads(command, o->threads);
    add_file(command, "--sheet", o->sheet, "Write both pictures and their difference side by side");
    command->footer(
        "Worst off: largest difference, in steps of 1/65535, of pixels that are not on an edge.\n"
        "Beyond off, on edges: number of pixels that differ by more than one step, off and on edges.\n"
        "Needs povray. See povref/README.md.");
}

void add_stability(CLI::App& app, Action& action) {
    auto [command, o] =
        add_command(app, action, "stability",
                    "Render a scene in float, double and long double; show where they disagree", stability_command);
    add_scene(command, o->scene);
    add_file(command, "-o,--output", o->output,
             "A map: grey where all agree, orange where float differs, red where double does too");
    add_parsed(command, "--size", o->size, parse_size, "Size of the picture in pixels, 640x480 by default", "WxH");
    add_depth(command, o->depth);
    add_threads(command, o->threads);
    command->footer(
        "Differences are those of 8-bit colours, but for rounding ties. Long double has no SIMD: this takes a while.");
}

/// "strahl 0.1.0 (x86-64-v4, 16 float lanes, 8 double)"
std::string version() {
    const Simd simd = best_simd();
    TextStream text;
    text << "strahl " STRAHL_VERSION " (" << name(simd) << ", " << lanes(Precision::float32, simd) << " float lanes, "
         << lanes(Precision::float64, simd) << " double)";
    return text.str();
}

/// `strahl SCENE` means `strahl view SCENE`.
std::vector<char*> with_command(const CLI::App& app, int argc, char** argv) {
    static char view[] = "view";
    std::vector<char*> arguments(argv, argv + argc);
    const std::string_view first = argc < 2 ? "" : argv[1];
    const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
    const bool known = std::ranges::any_of(commands, [&](auto* command) { return command->get_name() == first; });
    const bool scene = first.ends_with(".rt") || (!first.starts_with('-') && std::filesystem::is_regular_file(first));
    if (!known && scene) arguments.insert(arguments.begin() + 1, view);
    return arguments;
}

/// Better than CLI11's message about unexpected arguments.
void require_known_command(const CLI::App& app, std::string_view word) {
    if (word.starts_with('-')) return;
    std::vector<std::string_view> known;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        known.push_back(command->get_name());
    if (std::ranges::find(known, word) != known.end()) return;
    std::string advice;
    if (const std::string_view meant = nearest(word, known); !meant.empty())
        advice = "; did you mean '" + std::string(meant) + "'?";
    else
        for (const auto name : known) (advice += advice.empty() ? "; the commands are " : ", ") += name;
    throw UsageError("there is no command " + strahl::quoted(word) + advice +
                     "\nTo render a scene: strahl render SCENE -o FILE");
}

/// "; did you mean '--size'?" for an argument that looks like an option of the command, or nothing.
std::string nearest_option(const CLI::App& command, const std::string& argument) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) names.push_back(option->get_name());
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string meant(argument.starts_with('-') ? nearest(argument, known) : "");
    return meant.empty() ? "" : "; did you mean '" + meant + "'?";
}

[[noreturn]] void report_usage(const CLI::App& app, const CLI::ParseError& error) {
    const auto chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen[0];
    std::string message = error.what();
    // Of leftovers such as `--sizes 640x480`, in any order, the option is what is wrong.
    auto left = command.remaining();
    std::ranges::stable_partition(left, [](const std::string& argument) { return argument.starts_with('-'); });
    if (!left.empty()) message = strahl::quoted(left[0]) + " is not expected here" + nearest_option(command, left[0]);
    throw UsageError(message + "\nSee: strahl " + (chosen.empty() ? "" : command.get_name() + " ") + "--help");
}

int run(int argc, char** argv) {
    CLI::App app{"Strahl, a fast and exact ray tracer.", "strahl"};
    app.set_version_flag("--version", version, "Print the version and the SIMD level in use");
    app.set_help_flag("-h,--help", "Print this help; strahl COMMAND --help describes a command");
    add_reference(app, STRAHL_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->column_width(26);
    Action action;
    add_view(app, action);
    add_play(app, action);
    add_render(app, action);
    add_join(app, action);
    add_check(app, action);
    add_compare(app, action);
    add_bundle(app, action, STRAHL_VERSION);
    add_import(app, action);
    add_pov(app, action);
    add_crosscheck(app, action);
    add_stability(app, action);
    app.footer(
        "Exit status: 0 done, 1 failed, 2 wrong usage, 3 error in a file, 130 interrupted.\n"
        "Example: strahl render scenes/article.rt -o article.bmp");
    if (argc < 2) throw UsageError("no command given\n" + app.help());
    std::vector<char*> arguments = with_command(app, argc, argv);
    require_known_command(app, arguments[1]);
    try {
        app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::Success& wanted) {  // --help and --version
        return app.exit(wanted);
    } catch (const CLI::ParseError& error) {
        report_usage(app, error);
    }
    return action();
}

int fail(const std::exception& error, int status, const char* prefix = "strahl: ") {
    std::cerr << prefix << printable(error.what()) << '\n';
    return status;
}

constexpr const char* out_of_memory = "out of memory; a smaller picture, or fewer --threads, need less";
/// Exceptions that nobody can catch end here: a library's, thrown while it is loaded.
[[noreturn]] void end_at_once() {
    try {
        if (std::current_exception()) throw;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "strahl: %s\n", out_of_memory);
        std::_Exit(exit_status::failed);
    } catch (...) {
    }
    std::abort();
}

/// What was printed may still be on its way, and the disk full.
void flush_output() {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
    throw OutputError(std::string("cannot write 'standard output': ") + std::strerror(errno));
}

}  // namespace
}  // namespace strahl

int main(int argc, char** argv) {
    using namespace strahl;
    std::set_terminate(end_at_once);
    try {
        const int status = run(argc, argv);
        flush_output();
        return status;
    } catch (const UsageError& error) {
        return fail(error, exit_status::usage);
    } catch (const OutputError& error) {
        return fail(error, dynamic_cast<const Interrupted*>(&error) ? exit_status::interrupted : exit_status::failed);
    } catch (const FileError& error) {
        return fail(error, exit_status::bad_file, "");
    } catch (const std::bad_alloc&) {
        return fail(std::runtime_error(out_of_memory), exit_status::failed);
    } catch (const std::exception& error) {
        return fail(error, exit_status::failed);
    }
}
