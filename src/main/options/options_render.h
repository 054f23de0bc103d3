// The options of the commands that make picture files. Only main.cpp may include this, as options.h.
#pragma once
#include "main/commands/command_join.h"
#include "main/commands/command_render.h"
#include "main/options/options.h"

namespace strahl {

inline void add_render(CLI::App& app, Action& action) {
    auto [command, o] = add_command(app, action, "render", "Render a scene to a picture file", render_command);
    add_scene(command, o->scene);
    add_file(command, "-o,--output", o->output,
             "The picture: .bmp, .png or .exr; or a film, for which ffmpeg is needed: .mp4, .mkv or .webm; - is "
             "standard output");
    add_parsed(command, "--size", o->size, parse_size, "Size of the picture in pixels, 640x480 by default", "WxH");
    add_parsed(command, "--crop", o->crop, parse_crop, "Only this part of it; X and Y count from its top left corner",
               "X,Y,W,H");
    add_depth(command, o->depth);
    command
        ->add_option(
            "--error", o->error,
            "Error allowed in each channel, whose values are from 0 to 1: bounded for what rays leave out, and the RMS "
            "error aimed at for the averages over pixels. Precision and rays are chosen to match; --stats reports how. "
            "0: no pruning. Without this option only light that can't change the file by half a step is pruned, and "
            "1/510 is aimed at")
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
    add_bits(command, o->bits, {8, 16, 32}, "Bits per channel: 8, or 16 for .png (.exr always holds 32-bit floats)");
    add_choice<Compression>(command, "--compression", o->compression,
                            {{"fast", Compression::fast}, {"small", Compression::small}},
                            "Of .png: fast (default), or small, which takes about a second per megapixel", "KIND");
    add_choice<std::string>(
        command, "--format", o->format,
        {{"bmp", "bmp"}, {"png", "png"}, {"exr", "exr"}, {"ppm", "ppm"}, {"y4m", "y4m"}},
        "Format for standard output: bmp, png or exr; or ppm or y4m, of which --frames makes a stream", "KIND");
    add_time(command, o->time);
    add_parsed(
        command, "--frames", o->frames, parse_frames,
        "Frames of the flythrough, 0-99 or 1-3,5,7-20:2, as numbered files: %04d in FILE becomes the number; else it "
        "goes before the ending. A film has all of them by default",
        "LIST");
    add_fps(command, o->fps, "Frames per second of the flythrough, 25 by default; frame N is at N/F seconds");
    add_parsed(command, "--part", o->share, parse_share,
               "Part K of N: every Nth frame, or bands of one picture, which strahl join puts together", "K/N");
    command->add_flag("--resume", o->resume,
                      "Go on from what an interrupted run has kept; leave out frames whose files are there, and whole");
    command
        ->add_option("--checkpoint", o->checkpoint,
                     "Seconds after which finished bands of a picture are kept in FILE.checkpoint, 10 by default")
        ->check(numbers(0, 1e9))
        ->type_name("S");
    add_file(command, "--prove", o->prove,
             "Bound the rounding of every pixel, and write to this picture which ones are proved to be those of exact "
             "arithmetic; traces one ray in each pixel, in double, and prunes a hundredth of what it would without");
    add_file(command, "--stats", o->stats, "Write times, rays and errors to this JSON file");
    command->add_flag("--quiet", o->quiet, "Show no progress");
    command->footer(
        "A still:           strahl render scenes/article.rt -o article.png --size 1920x1080\n"
        "A film:            strahl render SCENE -o film.mp4 --size 1280x720\n"
        "Its frames:        strahl render SCENE -o film-%04d.png --frames 0-99 --fps 25\n"
        "From and to pipes: strahl render - -o - --format png < SCENE | ...\n"
        "Ctrl-C saves the finished part as NAME.part.ENDING; a second Ctrl-C stops at once.");
}

inline void add_join(CLI::App& app, Action& action) {
    auto [command, o] = add_command(app, action, "join", "Put the parts of a picture together", join_command);
    add_argument(command, "PART", o->parts, "All files that strahl render --part wrote for it")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_file(command, "-o,--output", o->output, "The picture; - is standard output");
    command->footer("strahl join big.png.part-* -o big.png");
}

}  // namespace strahl
