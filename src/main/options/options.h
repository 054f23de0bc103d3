// Helpers that add options, so that commands.cpp reads as a list of them. CLI11 compiles slowly: only the files of this
// folder include it, and they are compiled as one.
#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "image/transfer.h"
#include "main/render/values.h"
#include "pov/open_scene.h"
#include "text/reading/messages.h"

namespace strahl {

/// The work that a command line asks for; returns the exit status. Empty until a command has been parsed.
using ChosenCommand = std::function<int()>;

/// Adds all commands with their options to `app`. When one has been parsed, `chosen` is its work.
void add_commands(CLI::App& app, ChosenCommand& chosen);

/// Adds a command: a struct of options, and the function that does the work.
template <class Options>
std::pair<CLI::App*, std::shared_ptr<Options>> add_command(CLI::App& app, ChosenCommand& chosen, const char* name,
                                                           const char* help, int (*work)(const Options&)) {
    auto options = std::make_shared<Options>();
    CLI::App* const command = app.add_subcommand(name, help);
    command->set_help_flag("-h,--help", "Print this help");
    command->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    command->callback([&chosen, options, work] { chosen = [options, work] { return work(*options); }; });
    return {command, options};
}

/// Adds a required argument.
template <class Value>
CLI::Option* add_argument(CLI::App* command, const char* name, Value& value, const char* help) {
    return command->add_option(name, value, help)->required()->type_name(" ");
}

/// Adds an option whose value is read by `parse`, which throws UsageError.
template <class Value, class Parsed>
CLI::Option* add_parsed(CLI::App* command, const char* name, Value& value, Parsed (*parse)(std::string_view),
                        const char* help, const char* form) {
    return command
        ->add_option_function<std::string>(
            name, [&value, parse](const std::string& text) { value = parse(text); }, help)
        ->type_name(form);
}

/// Accepts only these words. Their list is also the validator's name, from which `words_of` takes it.
inline CLI::Validator one_of(const std::vector<std::string>& words) {
    std::string name, all;
    for (const std::string& word : words) {
        name += (name.empty() ? "" : "|") + word;
        all += (all.empty() ? "" : ",") + word;
    }
    const auto check = [words, all](std::string& text) {
        if (std::ranges::find(words, text) != words.end()) return std::string();
        // Other words for some of the values.
        const std::map<std::string_view, std::string_view> others{
            {"single", "float"},  {"float32", "float"},        {"float64", "double"}, {"long", "extended"},
            {"quad", "extended"}, {"long double", "extended"}, {"avx2", "v3"},        {"avx512", "v4"}};
        const std::vector<std::string_view> known(words.begin(), words.end());
        const auto other = others.find(text);
        std::string_view meant = other != others.end() ? other->second : text.size() > 2 ? nearest(text, known) : "";
        if (std::ranges::find(known, meant) == known.end()) meant = {};
        return text + " not in {" + all + "}" + (meant.empty() ? "" : "; did you mean '" + std::string(meant) + "'?");
    };
    return CLI::Validator(check, "", name);
}
/// Returns the words that an option accepts, if it has a list of them.
inline std::optional<std::vector<std::string>> words_of(const CLI::Option& option) try {
    const std::string& name = const_cast<CLI::Option&>(option).get_validator(0)->get_name();
    if (name.empty()) return std::nullopt;
    return CLI::detail::split(name, '|');
} catch (const CLI::OptionNotFound&) {  // it has no validator
    return std::nullopt;
}

/// Adds an option whose value is one of some words.
template <class Value>
CLI::Option* add_choice(CLI::App* command, const char* name, Value& value,
                        std::vector<std::pair<std::string, Value>> words, const char* help, const char* form) {
    std::vector<std::string> known;
    for (const auto& word : words) known.push_back(word.first);
    return command
        ->add_option_function<std::string>(
            name,
            [&value, words](const std::string& text) {
                for (const auto& [word, choice] : words)
                    if (word == text) value = choice;
            },
            help)
        ->check(one_of(known))
        ->type_name(form);
}

/// Accepts real numbers from `low` to `high`; unlike CLI11's Range it also rejects NaN.
inline CLI::Validator numbers(double low, double high) {
    return CLI::Validator(
        [=](std::string& text) {
            double value = 0;
            if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return std::string();
            return strahl::quoted(text) + " is not a number from " + CLI::detail::to_string(low) + " to " +
                   CLI::detail::to_string(high);
        },
        "");
}

/// Adds the options for scenes of POV-Ray, which --help shows last.
inline void add_opening(CLI::App* command, OpeningOptions& options) {
    constexpr const char* group = "Options for scenes of POV-Ray";
    command
        ->add_option("--clock", options.clock,
                     "Value of clock in a .pov file at all times; by default it runs from 0 to 1 during the flight, or "
                     "as an .ini file says")
        ->check(numbers(-1e9, 1e9))
        ->type_name("T")
        ->group(group);
    command
        ->add_option("--library", options.library,
                     "A folder of files that a .pov file includes, searched before those of POV-Ray's package; may be "
                     "given several times")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false)
        ->type_name("DIR")
        ->group(group);
    command
        ->add_flag("--strict", options.strict,
                   "Treat whatever in a .pov file cannot be shown as it is meant as an error")
        ->group(group);
}
constexpr const char* scene_help =
    "The scene: an .rt file or -, which is standard input; a .pov file, or an .ini file of POV-Ray, also a section of "
    "it, FILE.ini[NAME]";
/// Adds the scene; of an .ini file, FILE.ini or FILE.ini[SECTION], the scene in it. Options that are added later
/// replace what an .ini file says: `follow` is called with it first.
inline CLI::Option* add_scene(CLI::App* command, std::string& value, OpeningOptions& options,
                              const std::function<void(const pov::IniFile&)>& follow = {}) {
    const auto take = [&value, &options, follow](const std::string& given) {
        value = given;
        if (follow_ini(value, options) && follow) follow(*options.ini);
    };
    CLI::Option* const scene =
        command->add_option_function<std::string>("SCENE", take, scene_help)->required()->type_name(" ");
    add_opening(command, options);
    return scene;
}
inline CLI::Option* add_file(CLI::App* command, const char* name, std::string& value, const char* help) {
    return command->add_option(name, value, help)->type_name("FILE");
}
inline CLI::Option* add_size(CLI::App* command, PictureSize& value) {
    const std::string help = "Size of the picture in pixels, " + size_text(value.width, value.height) + " by default";
    return add_parsed(command, "--size", value, parse_size, help.c_str(), "WxH");
}
inline CLI::Option* add_depth(CLI::App* command, std::optional<int>& value) {
    return command
        ->add_option("--depth", value, "Generations of rays, 1 to 256; by default the scene's max_trace_level")
        ->check(CLI::Range(1, 256).description(""))
        ->type_name("N");
}
inline CLI::Option* add_threads(CLI::App* command, int& value) {
    return command->add_option("--threads", value, "Number of threads; by default one for each processor")
        ->check(CLI::Range(1, 1024).description(""))
        ->type_name("N");
}
inline CLI::Option* add_bits(CLI::App* command, int& value, const std::vector<std::string>& choices, const char* help) {
    return command->add_option("--bits", value, help)->check(one_of(choices))->type_name("N");
}
inline CLI::Option* add_time(CLI::App* command, std::optional<double>& value) {
    return command->add_option("--time", value, "A moment of the scene's flythrough and motions, in seconds")
        ->check(numbers(0, 1e9))
        ->type_name("T");
}
inline CLI::Option* add_exposure(CLI::App* command, Exposure& value) {
    return command
        ->add_option("--exposure", value,
                     "Multiply light by 2^E in what is shown with 8 bits, and compress what is brighter than 0.8 of "
                     "white instead of cutting it off there. By default light is shown as it is")
        ->check(numbers(-most_exposure, most_exposure))
        ->type_name("E");
}
template <class Value>
CLI::Option* add_fps(CLI::App* command, Value& value, Value (*parse)(std::string_view), const char* help) {
    return add_parsed(command, "--fps", value, parse, help, "F");
}

}  // namespace strahl
