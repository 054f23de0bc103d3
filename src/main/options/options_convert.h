// The options of the commands that make other things of scenes than pictures. Only main.cpp may include this, as
// options.h.
#pragma once
#include "main/commands/command_bundle.h"
#include "main/commands/command_import.h"
#include "main/commands/command_pov.h"
#include "main/options/options.h"

namespace strahl {

inline void add_import(CLI::App& app, Action& action) {
    auto [command, o] =
        add_command(app, action, "import", "Convert a scene of another program: NFF or Tachyon's", import_command);
    add_argument(command, "FILE", o->file, "The scene, an .nff or .dat file; - is standard input");
    add_file(command, "-o,--output", o->output, "The .rt file; by default -, standard output");
    command->footer("What the scene language can't say is told with its line. See src/import/README.md.");
}

inline void add_pov(CLI::App& app, Action& action) {
    auto [command, o] = add_command(app, action, "pov", "Convert a scene for POV-Ray", pov_command);
    add_scene(command, o->scene);
    add_file(command, "-o,--output", o->output, "The .pov file; an .ini file to render it is written beside it");
    add_size(command, o->width, o->height);
    add_depth(command, o->depth);
    add_bits(command, o->bits, {8, 16}, "Bits per channel of POV-Ray's picture: 8, or 16 (default)");
    add_time(command, o->time);
    command->add_flag("--animation", o->animation, "The whole flythrough, driven by POV-Ray's frame_number");
    add_fps(command, o->fps, "Frames per second of the animation, 25 by default");
}

inline void add_bundle(CLI::App& app, Action& action, const char* version) {
    auto [command, o] = add_command(app, action, "bundle",
                                    "Make a folder that plays a scene on machines without Strahl", bundle_command);
    o->version = version;
    add_argument(command, "SCENE", o->scene, "The scene, an .rt file");
    command->add_option("-o,--output", o->output, "The folder; an older bundle is replaced")
        ->required()
        ->type_name("DIR");
    command->footer("FOLDER/play plays it, with the options of strahl play.");
}

}  // namespace strahl
