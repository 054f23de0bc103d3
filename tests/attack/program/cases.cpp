// The commands that are attacked.
#include "attacked.h"

namespace strahl::attack {
namespace {

const char scene[] = R"(camera { position <5, -20, 18>  look_at <0, 0, 0>  up <0, 0, -1>  fov 10 }
light { position <-5, 0, 10>  color <.9, .9, .9> }
light { position <8, -9, 12>  color <.2, .3, .4> }
background { color <.1, .1, .3> }
sphere { <0, 0, 2>, 2  material { rgb <1, .2, .2> } }
sphere { <2.5, -2, 1>, 1  material { rgb <.2, 1, .2>  refraction .6  ior 1.3 } }
cylinder { <-3, -1, 0>, <-3, -1, 2>, .7  material { ambient .2  reflection 0 }  rotate <10, 0, 0> }
plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
flythrough {
  duration 4
  key { time 0  position <5, -20, 18>  look_at <0, 0, 0> }
  key { time 4  position <15, -20, 10>  look_at <0, 0, 0> }
}
)";

/// A scene with most words that the other one lacks.
const char many_words[] = R"(camera { position <5, -20, 18>  look_at <0, 0, 0>  up <0, 0, -1>  fov 10 }
light { position <-5, 0, 10>  color <.9, .9, .9>  edges <1, 0, 0>, <0, 1, 0> }
light { position <8, -9, 12>  color <.2, .3, .4>  spot { look_at <0, 0, 0>  radius 10  falloff 20 } }
background { color gradient { colors { 0 <.1, .1, .3>  1 <.5, .7, 1> } } }
fog { distance 100  color <.6, .7, .8> }
define stone material { rgb marble { turbulence .5  colors { 0 <1, 1, 1>  1 <.5, .2, .1> } } }
difference { box { <-1, -1, 0>, <1, 1, 1> }  mesh { triangle { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }
  triangle { <0, 0, 0>, <0, 1, 0>, <0, 0, 1> }  triangle { <0, 0, 0>, <0, 0, 1>, <1, 0, 0> }
  triangle { <1, 0, 0>, <0, 0, 1>, <0, 1, 0> } }  material { rgb checker { <1, 0, 0>, <0, 1, 0> } }  scale <2, 2, 2> }
union { torus { <3, 0, 1>, <0, 0, 1>, 1, .25 }  cone { <3, 0, 1>, .5, <3, 0, 3>, 0 }  material stone }
sphere { <-3, 2, 1>, 1  motion { key { time 0 }  key { time 2  translate <0, 0, 2> } } }
)";

/// Replaces POV-Ray, because the attack is on the program that starts it.
const char povray[] = "#!/bin/sh\nexec cp \"$TMPDIR/a.bmp\" scene.ppm\n";
/// Replaces ffmpeg: writes its input as the film.
const char ffmpeg[] = "#!/bin/sh\nfor file; do :; done\nexec cat >\"${file#file:}\"\n";

/// A red picture of 8x6 pixels.
std::string red() {
    std::string bytes("BM\xc6\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x8\0\0\0\6\0\0\0\1\0\x18\0", 30);
    bytes.resize(54);
    for (int pixel = 0; pixel < 48; ++pixel) bytes.append("\0\0\xff", 3);
    return bytes;
}

}  // namespace

std::vector<Case> cases() {
    const Files alone{{"scene.rt", scene}}, with_older{{"scene.rt", scene}, {"picture.bmp", "an older picture"}},
        pair{{"a.bmp", red()}, {"b.bmp", red()}};
    const auto render = [](std::string file, std::string threads, std::vector<std::string> more = {}) {
        std::vector<std::string> words{"render", "scene.rt", "-o",        std::move(file),
                                       "--size", "8x6",      "--threads", std::move(threads)};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    // In this order: a short attack tries only the first ones.
    std::vector<Case> all{
        {"pov --animation",
         {"pov", "scene.rt", "-o", "a.pov", "--animation"},
         {{"scene.rt", scene}, {"a.pov", "older"}, {"a.ini", "older"}}},
        {"a hard link", render("picture.bmp", "1"), with_older},
        {"check", {"check", "scene.rt"}, alone},
        {"--resume",
         render("film.bmp", "1", {"--frames", "0-2", "--resume"}),
         {{"scene.rt", scene}, {"film-0001.bmp", "cut off"}}},
        {"compare", {"compare", "a.bmp", "b.bmp", "--heatmap", "map.png"}, pair},
        {"check --print", {"check", "--print", "scene.rt"}, alone},
        {"a faulty scene", {"check", "scene.rt"}, {{"scene.rt", std::string(scene) + "sphere { oops"}}},
        {"pov", {"pov", "scene.rt", "-o", "a.pov"}, alone},
        {"stability", {"stability", "scene.rt", "--size", "8x6", "-o", "map.png", "--threads", "2"}, alone},
        {"BMP", render("picture.bmp", "1"), with_older},
        {"PNG, 4 threads", render("picture.png", "4", {"--bits", "16"}), alone},
        {"EXR, 4 threads", render("picture.exr", "4"), alone},
        {"--error", render("picture.bmp", "2", {"--error", ".01", "--stats", "stats.json"}), with_older},
        {"to a pipe", render("-", "1", {"--format", "png"}), alone},
        {"--frames", render("film.bmp", "1", {"--frames", "0-2"}), alone},
        {"a checkpoint", render("picture.png", "2", {"--size", "8x200", "--checkpoint", "0"}), alone},
        {"many words", render("picture.bmp", "2", {"--time", "1"}), {{"scene.rt", many_words}}},
        {"import",
         {"import", "scene.nff", "-o", "scene.rt"},
         {{"scene.nff",
           "v\nfrom 0 -9 3\nat 0 0 0\nup 0 0 1\nangle 30\nhither 1\nresolution 8 6\nl 3 -4 9\n"
           "f 1 .5 .2 .8 .2 9 0 0\ns 0 0 1 1\nc 1 1 0 1\n1 1 2 0\n"
           "p 3\n0 0 0\n1 0 0\n0 1 0\n"},
          {"scene.rt", "older"}}},
        {"a part", render("picture.bmp", "1", {"--size", "8x200", "--checkpoint", "0", "--part", "1/2"}), alone},
    };
    const auto part = [&](const char* which) {
        return render("picture.bmp", "1", {"--size", "8x200", "--part", which});
    };
    all.push_back({.name = "join",
                   .words = {"join", "picture.bmp.part-1-of-2", "picture.bmp.part-2-of-2", "-o", "picture.bmp"},
                   .before = with_older,
                   .first = {part("1/2"), part("2/2")}});
    all.push_back({.name = "crosscheck",
                   .words = {"crosscheck", "scene.rt", "--size", "8x6", "--sheet", "sheet.png"},
                   .before = {{"scene.rt", scene}, {"a.bmp", red()}, {"povray", povray}},
                   .times = true});
    for (Case& attacked : all) attacked.hard_link = attacked.name == "a hard link";
    return all;
}

std::vector<Case> cases_with_others() {
    return {{"a film",
             {"render", "scene.rt", "-o", "film.mp4", "--size", "8x6", "--frames", "0-2", "--threads", "1"},
             {{"scene.rt", scene}, {"film.mp4", "an older film"}, {"ffmpeg", ffmpeg}}},
            {"bundle",
             {"bundle", "scene.rt", "-o", "folder"},
             {{"scene.rt", scene}},
             {{"bundle", "scene.rt", "-o", "folder"}}}};
}

std::vector<Case> larger_cases() {
    const Files older{{"scene.rt", scene}, {"picture.png", "an older picture"}, {"picture.exr", "an older picture"}};
    return {{"a still", {"render", "scene.rt", "-o", "picture.png", "--size", "800x600"}, older},
            {"a still with checkpoints",
             {"render", "scene.rt", "-o", "picture.png", "--size", "800x600", "--checkpoint", "0"},
             older},
            {"a still of float", {"render", "scene.rt", "-o", "picture.exr", "--size", "400x300"}, older},
            {"a film", {"render", "scene.rt", "-o", "film.png", "--size", "160x120", "--frames", "0-19"}, older}};
}

}  // namespace strahl::attack
