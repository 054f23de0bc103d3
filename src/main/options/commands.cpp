// The commands of the program, each with its options and what --help and the manual page say about them.
#include "files/error.h"
#include "files/os/interrupt.h"
#include "main/commands/command_bundle.h"
#include "main/commands/command_check.h"
#include "main/commands/command_compare.h"
#include "main/commands/command_crosscheck.h"
#include "main/commands/command_import.h"
#include "main/commands/command_join.h"
#include "main/commands/command_lsp.h"
#include "main/commands/command_pov.h"
#include "main/commands/command_render.h"
#include "main/commands/command_sheet.h"
#include "main/commands/command_stability.h"
#include "main/commands/command_view.h"
#include "main/options/options.h"
#include "main/process/exit_status.h"

namespace strahl {
namespace {

std::string layers_help() {
    std::string help = "Layers of an .exr file besides light: a list with commas of";
    for (const LayerKind& kind : layer_kinds)
        help.append(&kind == &layer_kinds[0] ? " " : ", ").append(kind.name).append(" (").append(kind.help).append(")");
    return help;
}

void add_render(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] = add_command(app, chosen, "render", "Render a scene to a picture file", render_command);
    add_scene(command, o->scene, o->opening, [o = o](const pov::IniFile& ini) {
        PictureSize& size = o->opening.size;
        size.width = ini.width.value_or(size.width), size.height = ini.height.value_or(size.height);
        if (ini.antialias == false) o->sampling = parse_samples("1");
        o->layers.alpha = o->alpha_of_scene = ini.alpha == true;
    });
    add_file(command, "-o,--output", o->output,
             "The picture: .bmp, .png or .exr; or a film: .mp4, .mkv or .webm, which needs ffmpeg; - is standard "
             "output");
    add_size(command, o->opening.size);
    add_parsed(command, "--crop", o->crop, parse_crop,
               "Render only this part of it; X and Y count from its top left corner", "X,Y,W,H");
    command->add_flag("--fit", o->fit,
                      "Widen the view if the camera's aspectratio is not the picture's, which would else be distorted");
    add_depth(command, o->depth);
    command
        ->add_option(
            "--error", o->error,
            "Largest error in each channel, whose values are from 0 to 1: a hard bound on the light that is pruned, "
            "and the target RMS error of anti-aliasing. Precision and rays are chosen to match; --stats reports them. "
            "With 0 nothing is pruned. By default light is pruned only if it cannot change the file by half a step, "
            "and the target is 1/510")
        ->check(numbers(0, 1e9))
        ->type_name("E");
    add_parsed(command, "--samples", o->sampling, parse_samples,
               "Rays in each pixel: 1, through its middle, or NxN, a grid. By default as many as the picture needs",
               "N");
    add_choice<std::optional<Precision>>(
        command, "--precision", o->precision,
        {{"float", Precision::float32}, {"double", Precision::float64}, {"extended", Precision::extended}},
        "float, double or extended; by default double, or what --error needs", "KIND");
    add_choice<Simd>(command, "--simd", o->simd,
                     {{"auto", Simd::automatic},
                      {"scalar", Simd::scalar},
                      {"v2", Simd::v2},
                      {"v3", Simd::v3},
                      {"v4", Simd::v4},
                      {"neon", Simd::neon}},
                     "Vector instructions: auto (default), scalar, v2, v3 or v4 for the levels of x86-64, or neon",
                     "LEVEL");
    add_threads(command, o->threads);
    add_bits(command, o->bits, {"8", "16", "32"},
             "Bits per channel: 8, or 16 for .png (.exr always holds 32-bit floats)");
    add_choice<Compression>(
        command, "--compression", o->compression, {{"fast", Compression::fast}, {"small", Compression::small}},
        "Compression of .png: fast (default), or small, which takes about a second per megapixel", "KIND");
    add_exposure(command, o->exposure);
    command->add_flag_callback(
        "--alpha", [o = o] { o->layers.alpha = true, o->alpha_of_scene = false; },
        "Make the background transparent, for .png and .exr; mirrors show it as it is. An .ini file does so by "
        "Output_Alpha");
    command
        ->add_option_function<std::string>(
            "--layers",
            [o = o](const std::string& list) {
                const bool alpha = o->layers.alpha;
                o->layers = parse_layers(list), o->layers.alpha |= alpha;
            },
            layers_help())
        ->type_name("LIST");
    add_choice<std::string>(
        command, "--format", o->format,
        {{"bmp", "bmp"}, {"png", "png"}, {"exr", "exr"}, {"ppm", "ppm"}, {"y4m", "y4m"}},
        "Format for standard output: bmp, png or exr; or ppm or y4m, which with --frames are streams", "KIND");
    add_time(command, o->time);
    add_parsed(command, "--frames", o->frames, parse_frames,
               "Frames of the flythrough, 0-99 or 1-3,5,7-20:2, as numbered files: their number replaces %04d in FILE, "
               "or else precedes the ending. By default a film has all frames, or those of an .ini file",
               "LIST");
    add_fps(command, o->rate, parse_rate,
            "Frames per second of the flythrough, 25 by default; frame N is at N/F seconds. 59.94 and other rates of "
            "video are 60000/1001 and so on");
    add_parsed(command, "--part", o->share, parse_share,
               "Part K of N: every Nth frame, or bands of one picture, which strahl join puts together", "K/N");
    command->add_flag("--resume", o->resume,
                      "Continue an interrupted picture from its checkpoint; skip frames whose files are complete");
    command
        ->add_option("--checkpoint", o->checkpoint,
                     "Seconds between checkpoints: the finished bands of a picture are saved in FILE.checkpoint; 10 by "
                     "default")
        ->check(numbers(0, 1e9))
        ->type_name("S");
    add_file(command, "--prove", o->prove,
             "Bound the rounding error of every pixel, and write a map of the pixels that are proved to equal those of "
             "exact arithmetic, .png or .bmp. Traces one ray per pixel, in double, and prunes a hundredth of the light "
             "that it would prune otherwise");
    add_file(command, "--stats", o->stats, "Write times, rays and errors to this JSON file");
    command->add_flag("--quiet", o->quiet, "Show no progress, and not what was written");
    command->footer(
        "Still:   strahl render SCENE -o picture.png --size 1920x1080\n"
        "Film:    strahl render SCENE -o film.mp4 --size 1280x720\n"
        "Frames:  strahl render SCENE -o film-%04d.png --frames 0-99 --fps 25\n"
        "Pipes:   strahl render - -o - --format png < SCENE | ...\n"
        "Ctrl-C saves the finished part as NAME.part.ENDING; a second Ctrl-C stops at once.");
}

/// Runs a command that Ctrl-C stops.
template <class Options, int (*command)(const Options&, const std::atomic<bool>*)>
int until_interrupted(const Options& options) {
    const os::Interrupt interrupt;
    return command(options, interrupt.flag());
}

void add_sheet(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] =
        add_command(app, chosen, "sheet", "Show moments of a scene's flight side by side in one picture",
                    until_interrupted<SheetOptions, sheet_command>);
    add_scene(command, o->scene, o->opening);
    add_file(command, "-o,--output", o->output, "The picture: .bmp, .png or .exr");
    command
        ->add_option("--pictures", o->pictures,
                     "Number of moments, 12 by default, from the start of the flight to its end")
        ->check(CLI::Range(1, 10000).description(""))
        ->type_name("N");
    command->add_option("--columns", o->columns, "Pictures in a row; by default about as many as there are rows")
        ->check(CLI::Range(1, 10000).description(""))
        ->type_name("N");
    add_parsed(command, "--size", o->size, parse_size,
               "Size of each picture in pixels; by default 320 wide, in the camera's proportions", "WxH");
    add_exposure(command, o->exposure);
    add_depth(command, o->depth);
    add_threads(command, o->threads);
    command->add_flag("--quiet", o->quiet, "Show no progress");
    command->footer("Below each picture stands its time in seconds.");
}

void add_join(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] = add_command(app, chosen, "join", "Put the parts of a picture together", join_command);
    add_argument(command, "PART", o->parts, "All files that strahl render --part wrote for it")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_file(command, "-o,--output", o->output, "The picture; - is standard output");
    command->footer("Example: strahl join big.png.part-* -o big.png");
}

PictureSize parse_window_size(std::string_view text) {
    const PictureSize size = parse_size(text);
    if (size.width > 16384 || size.height > 16384) throw UsageError("each side of the window is 1 to 16384 pixels");
    return size;
}

double parse_pace(std::string_view text) {
    const double fps = parse_rate(text).per_second();
    if (fps < 1 || fps > 1000) throw UsageError("--fps of a window is from 1 to 1000");
    return fps;
}

int view_until_interrupted(const ViewOptions& options) {
    const os::Interrupt interrupt;
    const int status = view_command(options, interrupt.flag());
    return *interrupt.flag() ? exit_status::interrupted : status;
}

/// The options that `view` and `play` share.
void add_window_options(CLI::App* command, ViewOptions& options) {
    add_time(command, options.time);
    add_fps(command, options.fps, parse_pace,
            "Pictures per second in motion, 60 by default; the resolution adapts to it");
    add_exposure(command, options.exposure);
    add_depth(command, options.depth);
    add_threads(command, options.threads);
    std::optional<int>& port = options.rocket;
    CLI::Option* const flag = command->add_flag_callback(
        "--rocket", [&port] { port = port.value_or(1338); },
        "Let a GNU Rocket editor on this machine set the tracks and the moment");
    command
        ->add_option_function<int>(
            "--rocket-port", [&port](int given) { port = given; }, "Its port, 1338 by default")
        ->check(numbers(1, 65535))
        ->type_name("PORT")
        ->needs(flag);
    command->add_flag("--verbose", options.verbose, "Log events to standard output");
}

void add_view(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] = add_command(app, chosen, "view", "Fly through a scene in a window", view_until_interrupted);
    add_scene(command, o->scene, o->opening)->required(false);
    add_parsed(command, "--size", o->size, parse_window_size, "Size of the window in pixels", "WxH");
    command->add_flag("--fullscreen", o->full_screen, "Start in full screen (F11)");
    command->add_flag("--fly", o->fly,
                      "Start flying along the scene's flythrough, or around the scene if it has none; motions play");
    add_parsed(command, "--still-size", o->still_size, parse_window_size,
               "Size of stills (F12); by default that of the picture in the window", "WxH");
    command->add_option("--still-folder", o->still_folder, "Folder for stills; by default the current one")
        ->type_name("DIR");
    add_choice<std::string>(command, "--still-format", o->still_ending, {{"bmp", ".bmp"}, {"png", ".png"}},
                            "Format of stills: bmp (default) or png", "KIND");
    add_window_options(command, *o);
    command->add_flag(
        "--list-keys", o->list_keys,
        "Print the commands of the window and their keys; lines of this in ~/.config/strahl/keys change them");
    command->footer(
        "Without SCENE, as from a desktop's menu, a gallery of scenes is shown. H lists the keys.\n"
        "When the scene file changes it is read again; while it has an error, the window shows the\n"
        "last scene that had none. Drop another file on the window to open it.\n"
        "The word view may be omitted: strahl SCENE --fly");
}

void add_play(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] =
        add_command(app, chosen, "play", "Play a scene's flight in full screen", view_until_interrupted);
    o->play = o->full_screen = true;
    add_scene(command, o->scene, o->opening);
    command
        ->add_option_function<std::string>(
            "--size", [o = o](const std::string& text) { o->size = parse_window_size(text), o->full_screen = false; },
            "Play in a window of this size in pixels instead")
        ->type_name("WxH");
    command->add_flag("--loop", o->loop, "Start again at the end");
    CLI::Option* const benchmark =
        command->add_flag("--benchmark", o->benchmark,
                          "Report the times between pictures, their resolutions and quality, and pixels per second");
    add_file(command, "--stats", o->stats, "Write what --benchmark reports to this JSON file")->needs(benchmark);
    add_window_options(command, *o);
    benchmark->excludes("--rocket");
    command->footer("Esc ends it, Space pauses. Bodies are where they belong at each moment, whatever the frame rate.");
}

void add_check(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] =
        add_command(app, chosen, "check", "Report errors in scenes, or list what is in them", check_command);
    add_argument(command, "SCENE", o->scenes, scene_help)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_flag("--print", o->print, "Print the scene as text instead");
    add_opening(command, o->opening);
}

void add_compare(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] =
        add_command(app, chosen, "compare", "Report how much two pictures differ; exit status 0 or 1", compare_command);
    add_argument(command, "A", o->a,
                 "A picture file: .bmp, .png, .exr, .jpg, .gif, .tga or .pfm, or a binary .ppm or .pgm");
    add_argument(command, "B", o->b, "Another picture of the same size");
    command
        ->add_option("--tolerance", o->tolerance, "Largest difference per channel that counts as equal, 0 by default")
        ->check(numbers(0, 1e9))
        ->type_name("T");
    add_file(command, "--heatmap", o->heatmap, "Write a picture of the differences");
}

void add_bundle(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] = add_command(app, chosen, "bundle",
                                    "Make a folder that plays a scene on machines without Strahl", bundle_command);
    o->version = STRAHL_VERSION;
    add_argument(command, "SCENE", o->scene, "The scene, an .rt file");
    command->add_option("-o,--output", o->output, "The folder; an older bundle is replaced")
        ->required()
        ->type_name("DIR");
    command->footer("FOLDER/play plays it, with the options of strahl play.");
}

void add_import(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] = add_command(app, chosen, "import",
                                    "Convert a scene of another program: POV-Ray's, NFF or Tachyon's", import_command);
    add_argument(command, "FILE", o->file,
                 "The scene, a .pov, .nff or .dat file, or a model; - is standard input, no .pov or model");
    add_opening(command, o->opening);
    add_file(command, "-o,--output", o->output, "The .rt file; by default -, standard output");
    command->footer("Unsupported features are reported with their line and substitute; the rest is converted.");
}

void add_pov(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] = add_command(app, chosen, "pov", "Convert a scene for POV-Ray", pov_command);
    add_scene(command, o->scene, o->opening);
    add_file(command, "-o,--output", o->output, "The .pov file; an .ini file to render it is written beside it");
    add_size(command, o->opening.size);
    add_depth(command, o->depth);
    add_bits(command, o->bits, {"8", "16"}, "Bits per channel of POV-Ray's picture: 8, or 16 (default)");
    add_time(command, o->time);
    command->add_flag("--animation", o->animation, "Convert the whole flythrough, driven by POV-Ray's frame_number");
    add_fps(command, o->rate, parse_rate, "Frames per second of the animation, 25 by default");
}

void add_crosscheck(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] =
        add_command(app, chosen, "crosscheck", "Render scenes with Strahl and POV-Ray and compare; exit status 0 or 1",
                    until_interrupted<CrosscheckOptions, crosscheck_command>);
    add_argument(command, "SCENE", o->scenes, "The scenes: .rt files, or .pov files, which POV-Ray gets as they are")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_opening(command, o->opening);
    add_size(command, o->opening.size);
    add_time(command, o->time);
    add_depth(command, o->depth);
    add_threads(command, o->threads);
    add_file(command, "--sheet", o->sheet, "Write both pictures and their difference side by side");
    command->footer(
        "Worst off: largest difference, in steps of 1/65535, of pixels that are not on an edge.\n"
        "Beyond off, on edges: number of pixels that differ by more than one step, off and on edges.\n"
        "Unsure: those off the edges of a .pov scene in which POV-Ray's rounding decides. Its picture moved by a\n"
        "millionth of a pixel differs there from itself.\n"
        "Needs povray.");
}

void add_stability(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] =
        add_command(app, chosen, "stability",
                    "Render a scene in float, double and long double; show where they disagree", stability_command);
    add_scene(command, o->scene, o->opening);
    add_file(command, "-o,--output", o->output,
             "A map: grey where all agree, orange where float differs, red where double does too");
    add_size(command, o->opening.size);
    add_depth(command, o->depth);
    add_threads(command, o->threads);
    command->footer(
        "Counts pixels whose 8-bit colours differ; exact halves are not counted. Long double has no SIMD,\n"
        "so this takes a while.");
}

void add_lsp(CLI::App& app, ChosenCommand& chosen) {
    auto [command, o] =
        add_command(app, chosen, "lsp", "Show errors and help in an editor, which starts this command", lsp_command);
    command->add_flag("--stdio", o->stdio, "Use standard input and output, which it does anyway");
    command->footer("A server of the Language Server Protocol for .rt files, and for errors in .pov files.");
}

}  // namespace

void add_commands(CLI::App& app, ChosenCommand& chosen) {
    add_view(app, chosen);
    add_play(app, chosen);
    add_render(app, chosen);
    add_sheet(app, chosen);
    add_join(app, chosen);
    add_check(app, chosen);
    add_compare(app, chosen);
    add_bundle(app, chosen);
    add_import(app, chosen);
    add_pov(app, chosen);
    add_crosscheck(app, chosen);
    add_stability(app, chosen);
    add_lsp(app, chosen);
}

}  // namespace strahl
