// The pictures of README.md: the naive method on the left, Strahl on the right.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

#include "image/picture.h"
#include "tests/stability/stage.h"
#include "tests/stability/whitted.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

constexpr int width = 240, height = 180, gap = 4;

/// NaN is shown in magenta.
void paste(const Frame& frame, Picture& picture, int at) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Color v = pixel(frame, x, y);
            const bool number = std::isfinite(v.x + v.y + v.z);
            for (int c = 0; c < 3; ++c)
                picture.values[3 * (std::size_t(y) * picture.width + at + x) + c] =
                    number ? std::clamp(v[c], 0., 1.) : c != 1;
        }
}
struct Pair {
    const char* name;
    Scene scene;
    Precision precision = Precision::float32;  // of Strahl's
    naive::Habits habits{};
    int depth = 6;
};
void draw(const Pair& pair, const std::string& folder) {
    Picture picture{2 * width + gap, height, 3, std::vector<double>(3 * (2 * width + gap) * height, 1.)};
    const Frame theirs = naive::Whitted<float>(pair.scene, pair.habits).picture(width, height);
    const Frame ours = shoot(pair.scene, pair.precision, {width, height, pair.depth});
    paste(theirs, picture, 0);
    paste(ours, picture, width + gap);
    write_picture(picture, folder + "/" + pair.name + ".png", {8});
    std::cout << pair.name << ": " << static_cast<int>(std::lround(100 * share_apart(theirs, ours, 2. / 255)))
              << " % of the pixels differ by more than 2 of 255\n";
}

Material dull(const Color& rgb) {
    Material m = paint(rgb);
    m.ambient = .15;
    return m;
}
Material shiny(const Color& rgb) {
    Material m = dull(rgb);
    m.specular = .5, m.pow = 30;
    return m;
}
const Color sky{.55, .7, .9};

Stage table(bool clear = false) {
    Stage stage;
    Material chrome = shiny({.3, .3, .35});
    chrome.reflection = .5;
    if (clear) chrome = glass(1.5);
    stage.look({0, -6, 2}, {0, 0, .1}, 18).background(sky).light({-4, -5, 6}, {.9, .9, .9});
    stage.put(Plane{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, dull({.6, .65, .55}));
    stage.put(Sphere{{-.9, 0, 0}, 1}, shiny({.9, .4, .2})).put(Sphere{{1.1, -.2, -.2}, .8}, chrome);
    return stage;
}

Scene far_ball() {
    return Stage()
        .look({0, -4096, 0}, {0, 0, 0}, .02)
        .background(sky)
        .light({-4000, -4000, 4000})
        .put(Sphere{{0, 0, 0}, 1}, dull({.9, .4, .2}))
        .scene;
}
Scene huge_ground() {
    Stage stage;
    stage.look({0, -8, 2}, {0, 0, .3}, 20).background(sky).light({-5, -5, 9});
    stage.put(Sphere{{0, 0, -1e7 - 1}, 1e7}, dull({.5, .65, .4})).put(Sphere{{0, 0, 0}, 1}, shiny({.9, .4, .2}));
    return stage.scene;
}
Scene thin_discs() {
    Stage stage;
    stage.look({0, -6, 3.5}, {0, 0, 0}, 17).background({.1, .12, .2});
    for (int i = 0; i < 5; ++i)
        stage.put(Cylinder{{(i % 3 - 1) * 1.3, i / 3 * 1.6 - .6, 0}, {(i % 3 - 1) * 1.3, i / 3 * 1.6 - .6, 2.5e-7}, .6},
                  glow({.9, .3 + .13 * i, .2}));
    return stage.scene;
}
Scene tube() {
    Stage stage;
    stage.look({0, -2000, 0}, {0, 0, 0}, .055).background(sky).light({-1500, -2000, 1500});
    stage.put(Cylinder{{0, 0, 0}, {.6, 3, 0}, 1}, dull({.4, .7, .9}));
    return stage.scene;
}
Scene twins() {
    Stage stage;
    stage.look({.3, -6.7, 1.1}, {.1, .2, .3}, 16).background({.1, .12, .2}).light({-4, -5, 6});
    stage.put(Sphere{{.1, .2, .3}, 1.3}, dull({.9, .3, .2}));
    stage.put(Sphere{{.1 / 3, .2 / 3, .1}, 1.3 / 3}, dull({.2, .4, .9}), {Scale{DVec3(3)}});
    return stage.scene;
}
Scene contact() {
    Stage stage;
    stage.look({0, -.02, .012}, {0, 0, 0}, 16).light({-.8, -.1, .6}).background(sky);
    stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, dull({.9, .9, .85}));
    for (int i = 0; i < 3; ++i)
        stage.put(Cylinder{{.004 * (i - 1), 0, 4e-4}, {.004 * (i - 1), 0, 5e-4}, 1.5e-3}, dull({.9, .5, .2}));
    return stage.scene;
}
Scene diver() {
    // From below the surface of water.
    Stage stage;
    stage.look({0, 0, -1}, {0, 1, -.12}, 40).background(sky);
    stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, glass(1.33));
    stage.put(Plane{{0, 0, -3}, {1, 0, -3}, {0, 1, -3}}, glow({.75, .65, .45}));
    for (int i = 0; i < 9; ++i) {
        stage.put(Sphere{{i * 1.6 - 6.4, 8, -2.5}, .5}, glow({.9, .2 + .08 * i, .2}));
        stage.put(Sphere{{i * 1.6 - 6.4, 9, 5 + i % 2}, .6}, glow({.2, .2 + .08 * i, .3}));
    }
    return stage.scene;
}
Scene row() {
    Stage stage;
    stage.look({0, -8, 5}, {0, 0, 0}, 10, {0, 0, 1}).background(sky).light({-6, -8, 10});
    for (int i = 0; i < 1000; ++i) stage.put(Sphere{{.001 * (i - 500), 0, 0}, 1}, dull({.9, .3 + .0004 * i, .2}));
    return stage.scene;
}
Scene bubble() {
    Stage stage;
    stage.look({0, -6, 0}, {0, 0, 0}, 13).background(sky);
    for (int i = -6; i <= 6; ++i)
        stage.put(Cylinder{{i * .5, 4, -4}, {i * .5, 4, 4}, .1}, glow({.8, .2 + .04 * (i + 6), .15}));
    stage.put(Sphere{{0, 0, 0}, 1.1}, glass(1.33)).put(Sphere{{0, 0, 0}, .7}, glass(1));
    return stage.scene;
}

/// Noise a million cells away from the eye: by Strahl in float on the left, in double on the right.
void draw_noise(const std::string& folder) {
    Noise noise;
    noise.octaves = 3;
    Stage stage;
    Material clouds = glow({0, 0, 0});
    clouds.rgb = Pigment(Pattern{noise, {{.2, {.1, .2, .4}}, {.8, {1, .95, .8}}}, {}});
    const double away = 1e6;
    stage.look({0, 0, away}, {away, .3, 0}, std::atan(4 / (away * std::sqrt(2.))) * 57.29577951308232, {0, -1, 0});
    stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, clouds);
    Picture picture{2 * width + gap, height, 3, std::vector<double>(3 * (2 * width + gap) * height, 1.)};
    paste(shoot(stage.scene, Precision::float32, {width, height, 1}), picture, 0);
    paste(shoot(stage.scene, Precision::float64, {width, height, 1}), picture, width + gap);
    write_picture(picture, folder + "/noise.png", {8, false});
}

}  // namespace

/// stability_pictures FOLDER
int main(int count, char** words) {
    if (count != 2) return std::cerr << "usage: stability_pictures FOLDER\n", 2;

    const std::vector<Pair> pairs{
        {"far", far_ball()},
        {"ground", huge_ground(), Precision::float64},
        {"acne", placed(table().scene, 300)},
        {"small", placed(table(true).scene, 1e-4)},
        {"shifted", placed(table().scene, 1, DVec3(1e6, -1e6, 1e6)), Precision::float32, {.epsilon = .2}},
        {"contact", contact(), Precision::float32, {.epsilon = 1e-3}},
        {"discs", thin_discs()},
        {"tube", tube()},
        {"twins", twins()},
        {"row", row(), Precision::float32, {.epsilon = 1e-5}},
        {"total", diver(), Precision::float32, {.asks_for_total_reflection = false}},
        {"bubble", bubble()},
    };
    for (const Pair& pair : pairs) draw(pair, words[1]);
    draw_noise(words[1]);
}
