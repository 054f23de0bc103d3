// The options of the commands that open the window. Only main.cpp may include this: CLI11 compiles slowly.
#pragma once
#include "main/commands/command_view.h"
#include "main/options/options.h"
#include "main/process/exit_status.h"
#include "main/process/interrupt.h"
#include "scene/error.h"

namespace strahl {

inline PixelSize parse_window_size(std::string_view text) {
    const Size size = parse_size(text);
    if (size.width > 16384 || size.height > 16384) throw UsageError("each side of the window is 1 to 16384 pixels");
    return {size.width, size.height};
}

inline int view_until_interrupted(const ViewOptions& options) {
    const Interrupt interrupt;
    const int status = view_command(options, interrupt.flag());
    return *interrupt.flag() ? exit_status::interrupted : status;
}

inline void add_rocket(CLI::App* command, std::optional<int>& port) {
    CLI::Option* const flag = command->add_flag_callback(
        "--rocket", [&port] { port = port.value_or(1338); },
        "Let a GNU Rocket editor on this machine change tracks and moment");
    command->add_option_function<int>("--rocket-port", [&port](int given) { port = given; },
                                      "Its port, 1338 by default")
        ->check(numbers(1, 65535))
        ->type_name("PORT")
        ->needs(flag);
}

inline void add_view(CLI::App& app, Action& action) {
    auto [command, o] = add_command(app, action, "view", "Fly through a scene in a window", view_until_interrupted);
    add_scene(command, o->scene);
    add_parsed(command, "--size", o->size, parse_window_size, "Size of the window in pixels", "WxH");
    command->add_flag("--fullscreen", o->full_screen, "Start in full screen (F11)");
    command->add_flag("--fly", o->fly, "Start flying: along the scene's flythrough or around it; play what moves");
    add_time(command, o->time);
    add_fps(command, o->fps, "Pictures per second in motion, 60 by default; the resolution adapts to it")
        ->check(numbers(1, 1000));
    add_depth(command, o->depth);
    add_threads(command, o->threads);
    add_parsed(command, "--still-size", o->still_size, parse_window_size,
               "Size of stills (F12); by default that of the picture in the window", "WxH");
    command->add_option("--still-folder", o->still_folder, "Where stills are saved; by default here")->type_name("DIR");
    add_choice<std::string>(command, "--still-format", o->still_ending, {{"bmp", ".bmp"}, {"png", ".png"}},
                            "Format of stills: bmp (default) or png", "KIND");
    add_rocket(command, o->rocket);
    command->add_flag("--verbose", o->verbose, "Log events to standard output");
    command->footer(
        "H lists the keys. The scene is read again whenever its file changes, and waited for until it has no\n"
        "error; drop another file on the window to open it.\n"
        "The word view may be omitted: strahl scenes/article.rt --fly");
}

inline void add_play(CLI::App& app, Action& action) {
    auto [command, o] =
        add_command(app, action, "play", "Play a scene's flight in full screen", view_until_interrupted);
    o->play = o->full_screen = true;
    add_scene(command, o->scene);
    command
        ->add_option_function<std::string>(
            "--size",
            [o = o](const std::string& text) { o->size = parse_window_size(text), o->full_screen = false; },
            "In a window of this size in pixels instead")
        ->type_name("WxH");
    command->add_flag("--loop", o->loop, "Again and again");
    add_time(command, o->time);
    add_fps(command, o->fps, "Pictures per second, 60 by default; the resolution adapts to it")
        ->check(numbers(1, 1000));
    add_depth(command, o->depth);
    add_threads(command, o->threads);
    CLI::Option* const benchmark = command->add_flag(
        "--benchmark", o->benchmark, "Report the times between pictures, their resolutions and pixels per second");
    CLI::Option* const stats = add_file(command, "--stats", o->stats, "... and write them to this JSON file");
    stats->needs(benchmark);
    add_rocket(command, o->rocket);
    benchmark->excludes("--rocket");
    command->add_flag("--verbose", o->verbose, "Log events to standard output");
    command->footer("Esc ends it, Space pauses. What moves is where it is at each moment, whatever the frame rate.");
}

}  // namespace strahl
