// Worlds to measure with, as scene text on standard output: bench_worlds KIND COUNT
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/bench/points.h"

namespace {

using namespace strahl::bench;

/// Numbers that look random and are the same everywhere.
class Chance {
  public:
    double in(double low, double high) { return low + (high - low) * chance(state += next_state); }

  private:
    std::uint64_t state = 1;
};

void sphere(const Point& c, double r, const char* more = "") {
    std::printf("sphere { <%.9g,%.9g,%.9g>, %.9g%s }\n", c.x, c.y, c.z, r, more);
}
void cylinder(const Point& a, const Point& b, double r, const char* more = "") {
    std::printf("cylinder { <%.9g,%.9g,%.9g>, <%.9g,%.9g,%.9g>, %.9g%s }\n", a.x, a.y, a.z, b.x, b.y, b.z, r, more);
}
void floor_at(double z) { std::printf("plane { <0,0,%g>, <1,0,%g>, <0,1,%g> }\n", z, z, z); }

/// A floor ten wide, seen from above one of its sides, under these lights.
void floor_scene(const char* lights) {
    std::puts(
        "background { color <.5,.65,.85> }\n"
        "camera { position <-1.5,-9.5,5.5> look_at <0,-1.2,0> sky <0,0,1> angle 55 }");
    std::puts(lights);
    std::puts(
        "defaultmaterial { rgb <.7,.68,.62> reflection 0 refraction 0 diffuse .8 ambient .1 specular 0 pow 30 ior 1 }");
    floor_at(0);
}

void flake_world(int count) {
    int generations = 0;
    for (int balls = 1, level = 1; balls < count; balls += level) level *= 9, ++generations;
    std::puts(
        "global_settings { max_trace_level 6 }\n"
        "background { color <.078,.361,.753> }\n"
        "camera { position <2.1,1.3,1.7> look_at <0,0,0> sky <0,0,1> angle 45 }\n"
        "light { position <4,3,2> color <.577,.577,.577> }\n"
        "light { position <1,-4,4> color <.577,.577,.577> }\n"
        "light { position <-3,1,5> color <.577,.577,.577> }\n"
        "defaultmaterial { rgb <1,.75,.33> reflection 0 refraction 0 diffuse .8 ambient .05 specular 0 pow 1 ior 1 }");
    floor_at(-.5);
    std::puts("defaultmaterial { rgb <1,.9,.7> reflection .5 diffuse .5 specular .5 pow 20 }");
    flake([](const Point& c, double r) { sphere(c, r); }, {0, 0, 0}, .5, {0, 0, 1}, generations);
}

/// Small balls and upright cylinders in turn, in rows on a floor ten wide.
void grid_world(int count) {
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    const double cell = 10. / side;
    std::puts("global_settings { max_trace_level 4 }");
    floor_scene(
        "light { position <-8,-6,9> color <.7,.7,.65> }\n"
        "light { position <6,-9,12> color <.35,.35,.4> }");
    const char* const colours[] = {"<.85,.25,.2>", "<.25,.6,.3>", "<.25,.35,.8>", "<.9,.75,.3>", "<.8,.8,.85>"};
    Chance chance;
    for (int band = 0; band < 5; ++band) {
        std::printf("defaultmaterial { rgb %s diffuse .7 ambient .1 specular .4 reflection %g }\n", colours[band],
                    band < 3 ? 0. : .3);
        for (int i = band; i < count; i += 5) {
            const Point foot{cell * (i % side + .5) - 5, cell * (i / side + .5) - 5, 0};
            const double r = cell * chance.in(.2, .4), gap = .02 * cell;
            if (i / 5 % 2 == 0)
                sphere(foot + Point{0, 0, r + gap}, r);
            else
                cylinder(foot + Point{0, 0, gap}, foot + Point{0, 0, cell * chance.in(.5, 1.2)}, r);
        }
    }
}

/// Glass balls and rods on a chequered row of coloured balls: long trees of mirrored and refracted rays.
void glass_world(int count) {
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    std::puts(
        "global_settings { max_trace_level 8 }\n"
        "background { color <.55,.7,.9> }\n"
        "camera { position <3,-14,7> look_at <0,0,.6> sky <0,0,1> angle 42 }\n"
        "light { position <-9,-6,12> color <.8,.8,.75> }\n"
        "light { position <8,-10,9> color <.4,.4,.45> }\n"
        "defaultmaterial { rgb <.75,.7,.6> reflection 0 refraction 0 diffuse .8 ambient .12 specular 0 pow 40 ior 1 }");
    floor_at(0);
    Chance chance;
    for (int i = 0; i < count; ++i) {
        const Point foot{2. * (i % side) - side + 1, 2. * (i / side) - side + 1, 0};
        if (i % 3 == 2) {
            std::printf(
                "defaultmaterial { rgb <%.3f,%.3f,%.3f> reflection .15 refraction 0 diffuse .7 ambient .1 "
                "specular .5 pow 40 }\n",
                chance.in(.2, 1), chance.in(.2, 1), chance.in(.2, 1));
            sphere(foot + Point{0, 0, .72}, .7);
            continue;
        }
        std::printf(
            "defaultmaterial { rgb <.93,.97,1> reflection .1 refraction .86 diffuse .04 ambient .02 "
            "specular .8 pow 120 ior 1.5 }\n");
        if (i % 6 == 4)
            cylinder(foot + Point{0, 0, .03}, foot + Point{0, 0, 1.9}, .6);
        else
            sphere(foot + Point{0, 0, .87}, .85);
    }
}

/// A hundred dull and shining balls under many lamps.
void lights_world(int count) {
    std::puts(
        "global_settings { max_trace_level 5 }\n"
        "background { color <.1,.12,.2> }\n"
        "camera { position <2,-13,8> look_at <0,0,0> sky <0,0,1> angle 50 }\n"
        "defaultmaterial { rgb <.8,.8,.78> reflection 0 refraction 0 diffuse .8 ambient .1 specular 0 pow 40 ior 1 }");
    for (int i = 0; i < count; ++i) {
        const double turn = 2.399963 * i, r = 9 * std::sqrt((i + .5) / count);  // as the seeds of a sunflower
        std::printf("light { position <%.9g,%.9g,%.9g> color <%.9g,%.9g,%.9g> }\n", r * std::cos(turn),
                    r * std::sin(turn), 7 + .5 * std::cos(3. * i), .9 / count, .85 / count, .8 / count);
    }
    floor_at(0);
    Chance chance;
    for (int i = 0; i < 100; ++i) {
        std::printf("defaultmaterial { rgb <%.3f,%.3f,%.3f> reflection %g diffuse .75 ambient .1 specular .5 }\n",
                    chance.in(.2, 1), chance.in(.2, 1), chance.in(.2, 1), i % 4 ? 0. : .3);
        const double r = chance.in(.25, .48);
        sphere({i % 10 - 4.5, i / 10 - 4.5, r + .02}, r);
    }
}

/// Dull balls under one lamp: no mirror, no glass, nothing but balls and a floor.
void plain_world(int count) {
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    const double cell = 10. / side;
    floor_scene("light { position <-8,-6,9> color <.9,.9,.85> }");
    std::puts("defaultmaterial { rgb <.85,.35,.25> specular .4 }");
    Chance chance;
    for (int i = 0; i < count; ++i) {
        const double r = cell * chance.in(.2, .45);
        sphere({cell * (i % side + .5) - 5, cell * (i / side + .5) - 5, r + .02 * cell}, r);
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::string kind = argc > 1 ? argv[1] : "";
    const int count = argc > 2 ? std::atoi(argv[2]) : 0;
    if (count > 0 && kind == "flake") return flake_world(count), 0;
    if (count > 0 && kind == "grid") return grid_world(count), 0;
    if (count > 0 && kind == "glass") return glass_world(count), 0;
    if (count > 0 && kind == "lights") return lights_world(count), 0;
    if (count > 0 && kind == "plain") return plain_world(count), 0;
    std::fputs("bench_worlds flake|grid|glass|lights|plain COUNT: scene text to standard output\n", stderr);
    return 2;
}
