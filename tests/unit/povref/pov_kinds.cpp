// Compares scenes of POV-Ray with POV-Ray's own pictures of them: random ones of kinds that once differed.
#include <doctest/doctest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iomanip>
#include <optional>
#include <random>
#include <sstream>
#include <string>

#include "image/picture.h"
#include "image/pixels.h"
#include "pov/open_scene.h"
#include "povref/compare/run_povray.h"
#include "tests/unit/scratch.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

constexpr int width = 64, height = 48;

/// Makes pieces of scene text with random numbers.
class Texts {
  public:
    explicit Texts(unsigned seed) : random(seed) {}
    std::string number(double low, double high) {
        std::ostringstream text;
        text << std::setprecision(4) << low + (high - low) * std::generate_canonical<double, 53>(random);
        return text.str();
    }
    std::string vector(double low, double high) {
        const std::string x = number(low, high), y = number(low, high), z = number(low, high);
        return "<" + x + "," + y + "," + z + ">";
    }
    std::string one_of(std::initializer_list<const char*> words) { return std::data(words)[random() % words.size()]; }
    /// A look of its own colour, through which this share of light comes.
    std::string clear(const std::string& share) {
        const std::string color = vector(0, 1);
        return " pigment { rgb " + color + " transmit " + share + " } finish { ambient 1 diffuse 0 } ";
    }
    std::string clear(double least, double most) { return clear(number(least, most)); }
    std::string camera() {
        return "camera { location <" + number(-2, 2) + "," + number(-1, 2) + ",-6> look_at <" + number(-.3, .3) + "," +
               number(-.3, .3) + ",0> angle 45 }\n";
    }

  private:
    std::mt19937 random;
};

const std::string header = "#version 3.7; global_settings { assumed_gamma 1 max_trace_level 8 }\n";
const std::string lamp = "light_source { <-4,6,-8>, rgb 1 }\n", sky = "background { rgb <.2,.3,.6> }\n";
const std::string rainbow =
    "sky_sphere { pigment { gradient y color_map { [0 rgb <1,.5,.2>] [1 rgb <.2,.4,1>] } scale 2 translate -1 } }\n";
const std::string checks = "plane { y, -1.4 pigment { checker rgb 1, rgb .2 } finish { ambient 1 diffuse 0 } }\n";
const std::string glass = " pigment { rgbf 1 } finish { ambient 0 diffuse 0 } ";

struct Kind {
    const char* name;
    std::function<std::string(Texts&)> text;
    double share = .006;    // of the pixels that may differ by more than 1/255: those on edges
    bool speckled = false;  // may POV-Ray's rounding speckle faces? Then they are told, or pictures are the same
};

const Kind kinds[]{
    {"pictures without interpolation on faces along their borders",
     [](Texts& t) {
         const std::string shift = t.one_of({"-1", "0", "<-1,-1,0>", "<-1,0,0>"});
         return t.camera() + lamp + "box { -1, 1 pigment { image_map { png \"checks.png\" } scale " +
                t.one_of({"1", "2", "4"}) + " translate " + shift + " } rotate " + t.vector(-40, 40) + " }";
     }},
    {"heights that pictures of all kinds mean",
     [](Texts& t) {
         return t.camera() + lamp + "height_field { png \"" +
                t.one_of({"checks", "checks16", "grey", "grey16", "palette"}) + ".png\" " +
                t.one_of({"", "gamma 1.6 ", "gamma srgb "}) + t.one_of({"", "premultiplied on "}) +
                "translate <-.5,-.5,-.5> pigment { rgb " + t.vector(.3, 1) + " } scale <3,1.5,3> rotate " +
                t.vector(-30, 30) + " }";
     },
     .01},
    {"textures that blend across the triangles of a mesh",
     [](Texts& t) {
         std::string text = t.camera() + lamp + "#declare A = texture { pigment { rgb " + t.vector(0, 1) +
                            " } } #declare B = texture { pigment { checker rgb x, rgb z scale " + t.number(.2, .5) +
                            " } } mesh { ";
         for (int i = 0; i < 4; ++i)
             text += "triangle { " + t.vector(-1.5, 1.5) + ", " + t.vector(-1.5, 1.5) + ", " + t.vector(-1.5, 1.5) +
                     " texture_list { " + t.one_of({"A", "B"}) + " " + t.one_of({"A,", "B"}) + " B } } ";
         return text + "}";
     },
     .02},
    {"boxes around bodies",
     [](Texts& t) {
         const auto body = [&] {
             const std::string own[]{
                 "sphere { " + t.vector(-.5, .5) + ", " + t.number(.2, .6),
                 "cylinder { " + t.vector(-1, 0) + ", " + t.vector(.1, 1) + ", " + t.number(.1, .4),
                 "cone { " + t.vector(-1, 0) + ", .3, " + t.vector(.1, 1) + ", " + t.number(0, .5),
                 "disc { 0, " + t.vector(.1, 1) + ", .7",
                 "torus { .6, .2",
                 "superellipsoid { <.4,.7> scale .5",
                 "mesh { triangle { " + t.vector(-1, 1) + "," + t.vector(-1, 1) + "," + t.vector(-1, 1) + " }",
                 "text { ttf \"timrom.ttf\" \"W\" .2, 0"};
             return own[std::stoul(t.one_of({"0", "1", "2", "3", "4", "5", "6", "7"}))] + " rotate " +
                    t.vector(-180, 180) + t.one_of({"", " scale <.7,1.2,1>"}) + " translate " + t.vector(-.3, .3) +
                    t.one_of({"", " rotate 40*x"}) + " }";
         };
         const std::string first = body();
         return t.camera() + lamp + "#declare S = " + t.one_of({"union", "merge", "difference", "intersection"}) +
                " { object { " + first + " } " + body() + " rotate " + t.vector(-90, 90) +
                " } box { min_extent(S), max_extent(S) pigment { rgb " + t.vector(.3, 1) + " } }";
     }},
    {"sides of prisms",
     [](Texts& t) {
         const std::string spline =
             t.one_of({"linear_spline -.6, .5, 5, <-1,-1>, <1,-.8>, <.8,1>, <-.7,.9>, <-1,-1>",
                       "linear_spline .5, -.6, 5, <-1,-1>, <-.7,.9>, <.8,1>, <1,-.8>, <-1,-1>",
                       "quadratic_spline -.6, .5, 6, <1,-1>, <-1,-1>, <.8,-1>, <1,1>, <-1,.8>, <-1,-1>",
                       "cubic_spline -.6, .5, 7, <-1,.8>, <-1,-1>, <.8,-1>, <1,1>, <-1,.8>, <-1,-1>, <.8,-1>",
                       "bezier_spline -.6, .5, 8, <-1,0>, <-1,.6>, <-.4,1>, <0,1>, <0,1>, <.3,.3>, <-.4,-.5>, <-1,0>"});
         return t.camera() + lamp + "prism { " + spline +
                " texture { pigment { rgb <.2,.8,.3> } finish { ambient .4 } } interior_texture { pigment { rgb x } "
                "finish { ambient .4 } } rotate " +
                t.vector(-180, 180) + " }";
     }},
    {"reflection on bent normals",
     [](Texts& t) {
         const std::string how = t.one_of({"fresnel", "falloff .6", "falloff 2.5 metallic 1"});
         return t.camera() + rainbow + "sphere { 0, 1.5 pigment { rgb <.1,.7,.7> } normal { bumps " +
                t.number(.5, 1.5) + " scale " + t.number(.1, .4) + " } finish { ambient 0 diffuse 0 reflection { " +
                t.number(0, .3) + ", " + t.number(.4, .9) + " " + how + " } } interior { ior 1.4 } }";
     },
     .02},
    {"normals of textures that a pattern with turbulence shows",
     [](Texts& t) {
         const auto look = [&](const char* color) {
             return std::string("[.5 pigment { rgb ") + color + " } normal { " +
                    t.one_of({"bumps", "dents", "agate", "ripples"}) + " " + t.number(.3, .9) + " scale " +
                    t.number(.2, .6) + " } finish { phong .5 }] ";
         };
         const std::string moved =
             t.one_of({"turbulence .4", "warp { turbulence .3 } scale <.5,1,2>",
                       "rotate 30*z warp { repeat x*.7 flip x }", "scale .6 turbulence <.2,0,.5>"});
         return t.camera() + lamp + "sphere { 0, 1.5 texture { " +
                t.one_of({"bozo ", "gradient y ", "crackle ", "wood "}) + "scale .5 " + moved + " texture_map { " +
                look("1") + look("<1,.5,.2>") + "} rotate " + t.vector(-60, 60) + " } }";
     },
     .01},
    {"numbers below 0",
     [](Texts& t) {
         return t.camera() + lamp + "sphere { 0, 1.5 pigment { rgb " + t.vector(.2, 1) + " } finish { ambient " +
                t.vector(-.2, .1) + " emission " + t.number(-.1, .2) + " diffuse .65 brilliance " + t.number(-1, 2) +
                " } } sphere { <1.5,1,0>, .7 pigment { rgb .8 } finish { ambient -.1 diffuse .5 phong .6 phong_size " +
                t.number(-1, 10) + " reflection rgb " + t.vector(-.2, .5) + " } }";
     }},
    {"lights that are brighter off their axes",
     [](Texts& t) {
         return t.camera() + "light_source { <" + t.number(-1, 1) + ",3,-3> rgb 1 " +
                t.one_of({"spotlight radius 5 falloff 40", "cylinder radius .5 falloff 1.6"}) + " tightness " +
                t.number(-9, -.5) + " point_at 0 } plane { z, 1 pigment { rgb .3 } }";
     }},
    {"turned faces in one plane",
     [](Texts& t) {
         const std::string turn = " rotate " + t.vector(-60, 60) + " translate " + t.vector(-.3, .3);
         const std::string y = t.number(.3, 1);
         const auto box = [&](const char* color) {
             const std::string corner = "<" + t.number(.3, 1.2) + "," + y + "," + t.number(.3, 1.2) + ">";
             return "box { -" + corner + ", " + corner + " pigment { rgb " + color + " }" + turn + " } ";
         };
         const auto disc = [&](const char* color) {
             return "disc { 0, y, " + t.number(1.2, 2.6) + ", " + t.number(.2, .9) + " pigment { rgb " + color + " }" +
                    turn + " } ";
         };
         const bool round = t.one_of({"", "r"}) == "r";
         return t.camera() + lamp + "union { " + (round ? disc("x") : box("x")) + (round ? disc("y") : box("y")) + "}";
     }},
    {"surfaces inside unions that are parts",
     [](Texts& t) {
         const std::string both = "union { sphere { 0, 1" + t.clear(.3, .8) + "} sphere { " + t.vector(-.6, .6) + ", " +
                                  t.number(.4, .9) + t.clear(t.one_of({"0", ".6"})) + "} torus { .7, .3 rotate " +
                                  t.vector(0, 90) + t.clear(0, .6) + "} } ";
         const std::string box = "box { <-2,-3,-3>, <2," + t.number(-.3, .7) + ",3>" + t.clear(0, .6) + "} ";
         const std::string nested = "union { intersection { " + both + "plane { z, .3 " + t.clear(.2, .5) +
                                    "} } box { -.8, .5 } } sphere { 0, 1.4 } ";
         const std::string hole = "box { -1.5, 1.5 } union { sphere { -z*1.5, 1 } sphere { <.5,.3,-1.4>, .8 } } ";
         const std::string all[]{"intersection { " + both + box, "difference { " + both + box,
                                 "merge { intersection { " + both + box + "} " + box, "intersection { " + nested,
                                 "difference { " + hole};
         return t.camera() + sky + all[std::stoul(t.one_of({"0", "1", "2", "3", "4"}))] + t.clear(.4, .7) + "}";
     },
     .02},
    {"interiors of parts, and of bodies that overlap",
     [](Texts& t) {
         const std::string word = t.one_of({"intersection", "difference", "merge", "union"});
         const std::string own = t.one_of({"", "interior { ior 1.15 }"});
         return t.camera() + sky + checks + word + " { sphere { 0, 1 } sphere { " +
                t.one_of({"-.5*z, .8 ", "<.5,.2,-.3>, .9 "}) + own + " }" + glass + "interior { ior " +
                t.number(1.3, 1.6) + " fade_distance " + t.number(.5, 3) + " fade_power 2 fade_color <1,.5,.2> } }";
     },
     .03},
    {"what is further away than 1e7",
     [](Texts& t) {
         return "camera { location <0," + t.number(1e4, 1e6) + ",-24e6> look_at 0 angle 45 }\n" + sky +
                "light_source { -1e9*z rgb 1 parallel point_at 0 } sphere { x*" + t.number(-4e6, 4e6) + "," +
                t.number(14.1e6, 15e6) +
                " pigment { rgb 1 } }\nplane { y, -5e5 pigment { rgb <0,.5,0> } finish { "
                "ambient 1 diffuse 0 reflection .3 } }";
     }},
    {"shadows of what is nearer than 1e7, and further away",
     [](Texts& t) {
         const auto lamp_behind_ball = [&](const char* color, double x, const std::string& where) {
             const std::string from = "<" + std::to_string(x) + ",3e7,-2e7>";
             return "light_source { " + from + " rgb " + color + " } sphere { " + where + "*" + from + ", 2e6 } ";
         };
         return t.camera() + lamp_behind_ball("x", 2e7, t.number(.1, .2)) + lamp_behind_ball("y", 0, t.number(.4, .9)) +
                "plane { y, -1.4 pigment { rgb 1 } } sphere { 0, 1 pigment { rgb 1 } }";
     }},
    {"blobs whose lumps have several finishes",
     [](Texts& t) {
         const auto look = [&](const std::string& more) {
             return " texture { pigment { rgb " + t.vector(0, 1) + " " + more + " } finish { ambient " +
                    t.number(0, .6) + " diffuse " + t.number(.2, .7) + " specular " + t.number(0, .8) + " } }";
         };
         const std::string one = look(""), bent = t.one_of({"", "normal { bumps .4 scale .2 }"});
         return t.camera() + sky + lamp + "blob { threshold .3 sphere { -x*.7, 1.2, 1" + one + " } sphere { " +
                t.vector(0, .5) + ", 1.1, 1 " + look("") + " } cylinder { <.6,-1,0>, <.6,1,0>, .7, 1" + one +
                " } sphere { <.3,.8,-.4>, .9, 1 } sphere { -y*.6, .8, -.5" + look(t.one_of({"", "transmit .4"})) +
                " } pigment { rgb y } " + bent + " finish { reflection .2 } rotate " + t.vector(-60, 60) + " }";
     },
     .01},
    {"clear boxes that stand on planes",
     [](Texts& t) {
         const std::string y = t.number(-1.5, -.5), turn = t.one_of({"", "rotate 25*y ", "scale 1.2 "});
         return t.camera() + lamp + sky + "box { <-1,0,-1>, <" + t.number(.2, 1) + "," + t.number(.5, 1.5) + "," +
                t.number(.2, 1) + "> pigment { rgbt <1,.9,.8,.8> } finish { reflection .1 } interior { ior " +
                t.number(1.2, 1.6) + " } " + turn + "translate <" + t.number(-.3, .3) + "," + y + ",0> } plane { y, " +
                y + " pigment { checker rgb 1, rgb .3 } }";
     },
     .02},
    {"cylinders and cones that go on where others are taken away",
     [](Texts& t) {
         const std::string radius = t.number(.5, 1), middle = t.number(-.3, .3), slope = t.number(.3, .5);
         const std::string rods = "cylinder { -y, y, " + radius + " pigment { rgb x } } cylinder { y*" + middle +
                                  ", 1.4*y, " + radius + " pigment { rgb y } } ";
         const std::string cones = "cone { -y, 2.5*" + slope + ", y, .5*" + slope +
                                   " pigment { rgb x } } cone { 0, 1.5*" + slope + ", 1.5*y, 0 pigment { rgb y } } ";
         return t.camera() + lamp + checks + "difference { " + (t.one_of({"", "c"}) == "c" ? cones : rods) +
                t.one_of({"", "rotate 30*x ", "scale 1.2 "}) + "}";
     }},
    {"clear bodies on others",
     [](Texts& t) {
         const std::string y = t.number(-1, 0), look = " pigment { checker rgb <1,.5,.3>, rgb .3 scale .3 } ";
         const std::string clear = "pigment { rgbt <1,.9,.8,.8> } finish { reflection .1 } interior { ior 1.3 } ";
         const std::string below[]{
             "disc { y*" + y + ", y, 1.6" + look + "} ", "box { -1.3, <1.3," + y + ",1.3>" + look + "} ",
             "polygon { 4, <-2,0,-2>, <2,0,-2>, <0,0,2>, <-2,0,-2>" + look + "translate y*" + y + " } ",
             "box { -1.3, <1.3," + y + ",1.3> " + clear + "} "};
         const std::string above[]{"cylinder { y*" + y + ", y, " + t.number(.5, .9),
                                   "box { <-.6," + y + ",-.6>, <" + t.number(.3, 1) + ",1,.5>"};
         return t.camera() + lamp + sky + below[std::stoul(t.one_of({"0", "1", "2", "3"}))] +
                above[std::stoul(t.one_of({"0", "1"}))] + " " + clear + "}";
     },
     .006, true},
    {"bodies with faces in one place, and before a mirror",
     [](Texts& t) {
         const std::string z = t.number(.2, .8), turn = t.one_of({"", "rotate <20,30,0> "});
         const auto both = [&](const std::string& one, const std::string& other) {
             return one + " pigment { rgb x } " + turn + "} " + other + " pigment { rgb y } " + turn + "} ";
         };
         const std::string bodies[]{both("box { -1, <1,.7," + z + ">", "box { <-.6,-.6,0>, <.6,.4," + z + ">"),
                                    both("cylinder { -y, y, .8", "cylinder { y*" + z + ", 1.5*y, .8"),
                                    both("sphere { 0, 1.2", "sphere { 0, 1.2"),
                                    both("cylinder { -z, z*" + z + ", 1", "disc { z*" + z + ", z, .9")};
         return t.camera() + lamp + sky + bodies[std::stoul(t.one_of({"0", "1", "2", "3"}))] +
                "plane { z, 3 pigment { rgb .1 } finish { reflection .8 } }";
     },
     .006, true},
    {"boxes that are turned together, with faces in one plane",
     [](Texts& t) {
         std::string boxes;
         for (const char* const color : {"x", "y", "z", "x+y"})
             boxes += "box { <" + t.number(-2, -.5) + ",-.5," + t.number(-2, -.5) + ">, <" + t.number(.5, 2) + ",0," +
                      t.number(.5, 2) + "> pigment { rgb " + color + " } translate <" + t.number(-1, 1) + ",0," +
                      t.number(-1, 1) + "> rotate <20,10,30> } ";
         return t.camera() + lamp + boxes;
     },
     .006, true},
    {"parallel light that fades, seen beyond the plane from which it starts",
     [](Texts& t) {
         return t.camera() + "light_source { <" + t.number(-2, 2) + "," + t.number(0, 1) +
                ",0> rgb 1 parallel point_at <0,-1,1> fade_distance " + t.number(1, 4) + " fade_power 2 } " + checks +
                "plane { y, -1.4 pigment { rgb 1 } } sphere { 0, .7 pigment { rgb <1,.6,.3> } }";
     }},
    {"fog that filters, around bodies that cameras do not see",
     [](Texts& t) {
         return t.camera() + lamp + "fog { distance " + t.number(8, 20) + " rgbf <.3,.4,.6," + t.number(.3, .9) +
                "> } sphere { " + t.vector(-.6, .6) + ", 1 pigment { rgb 1 } " +
                t.one_of({"no_image", "no_reflection"}) +
                " } plane { y, -1.4 pigment { rgb <.9,.7,.5> } finish { reflection .3 } }";
     }},
    {"lights without shadows, which are a sort of their own",
     [](Texts& t) {
         const std::string beam = t.one_of({"spotlight radius 8 falloff 20 ", "cylinder radius .6 falloff 1.2 "});
         const std::string words = t.one_of({"s", ""}) == "s" ? "shadowless " + beam : beam + "shadowless ";
         return t.camera() + "light_source { <" + t.number(-3, 3) + ",5,-4> rgb 1 " + words +
                t.one_of({"", "fade_distance 6 fade_power 2"}) + " } " + checks +
                "sphere { 0, .7 pigment { rgb <1,.6,.3> } finish { phong .8 } }";
     }},
    {"waves and slopes of patterns that bend normals",
     [](Texts& t) {
         const std::string pattern =
             t.one_of({"bumps", "dents", "ripples", "waves", "wrinkles", "quilted", "bozo", "agate", "marble"});
         const std::string wave = t.one_of({"poly_wave .7 ", "poly_wave 2 ", "sine_wave ", "frequency 2 phase .3 ",
                                            "slope_map { [0 <.2,1>] [.6 <.9,0>] [1 <0,-1>] } "});
         return t.camera() + lamp + "box { -1, 1 pigment { rgb <.7,.8,.4> } normal { " + pattern + " " +
                t.number(.2, .6) + " " + wave + t.one_of({"", "turbulence .4 "}) + "scale " + t.number(.3, .8) +
                " } finish { phong .5 } rotate " + t.vector(-60, 60) + " }";
     },
     .01},
    {"lone parts that are moved and clipped",
     [](Texts& t) {
         const std::string look =
             " texture { pigment { bozo color_map { [.4 rgb x] [.6 rgb y] } scale .3 } normal { "
             "granite .4 } } ";
         const std::string move =
             t.one_of({"rotate ", "scale .9 rotate ", "matrix <1,.3,0, 0,1,0, 0,.2,1, 0,0,0> rotate "});
         return t.camera() + lamp + "union { union { torus { .8, .3 " + move + t.vector(-90, 90) + look +
                t.one_of({"} ", "translate .2 } "}) + t.one_of({"", "rotate 40*z "}) +
                "} clipped_by { plane { <1,1,-.5>, " + t.number(0, .6) + " } } rotate " + t.vector(-40, 40) + " }";
     },
     .01},
    {"sides of bicubic patches",
     [](Texts& t) {
         std::string points;
         for (int i = 0; i < 16; ++i)
             points +=
                 ",<" + std::to_string(i / 4 - 1.5) + "," + t.number(-.6, .6) + "," + std::to_string(i % 4 - 1.5) + ">";
         return t.camera() + lamp + "bicubic_patch { type " + t.one_of({"0", "1"}) +
                " u_steps 3 v_steps 3 flatness .01 " + points +
                " texture { pigment { rgb y } } interior_texture { pigment { rgb x } } " +
                t.one_of({"", "scale <1,-1,1> ", "scale <.8,1,1.1> "}) + "rotate " + t.vector(-180, 180) + " }";
     },
     .01},
    {"clear sweeps of balls, and parts of these",
     [](Texts& t) {
         std::string balls = "sphere_sweep { " + t.one_of({"linear_spline", "b_spline", "cubic_spline"}) + " 4";
         for (int i = 0; i < 4; ++i) balls += ", " + t.vector(-1, 1) + ", " + t.number(.2, .5);
         const std::string look = t.clear(.3, .8);
         if (t.one_of({"", "c"}) == "") return t.camera() + sky + balls + look + "}";
         return t.camera() + sky + "difference { box { <-3,-.2,-2>, <3,2,2> } " + balls + " }" + look + "}";
     },
     .02},
    {"glass of which a map of textures is clear in places",
     [](Texts& t) {
         const std::string clear = "pigment { rgbf <.5,.7,.9,.9> } finish { ambient .1 }";
         return t.camera() + sky + checks + "box { -1, 1 texture { " + t.one_of({"marble", "gradient y", "bozo"}) +
                " texture_map { [.3 " + clear + "] [.7 pigment { rgb <.4,.2,.1> }] } scale .7 } interior { ior " +
                t.number(1.2, 1.7) + " } rotate " + t.vector(-50, 50) + " }";
     },
     .02},
    {"colours outside of fractals",
     [](Texts& t) {
         return t.camera() + "plane { z, 1 pigment { " + t.one_of({"mandel 20 ", "julia <.3,.5>, 25 "}) + "exterior " +
                t.one_of({"6", "7", "8"}) + " " + t.number(1, 6) + " interior " + t.one_of({"0", "1", "3", "6"}) + " " +
                t.number(.2, 1) +
                " color_map { [0 rgb x] [.5 rgb y] [1 rgb 1] } "
                "scale 1.5 } finish { ambient 1 } }";
     }},
    {"bodies that emit light, beside ambient light of a colour",
     [](Texts& t) {
         const std::string light = t.one_of({"0", "<0,.7,.4>", "<1.4,.5,1>"});
         return "global_settings { ambient_light rgb " + light + " } " + t.camera() + lamp +
                "sphere { 0, 1.5 pigment { rgb " + t.vector(.2, 1) + " } finish { ambient " +
                t.one_of({"0", ".1", "<.2,0,.1>"}) + " emission " + t.one_of({"", "rgb "}) + t.number(.1, .9) +
                " diffuse " + t.number(0, .5) + t.one_of({" phong .5", "", " reflection .3"}) + " } }";
     }},
    {"reflection by Fresnel's law on either side of what is open, and around the camera",
     [](Texts& t) {
         const auto body = [&](const std::string& place) {
             const std::string bodies[]{"disc { 0, <.3,.2,-1>, 1.2",
                                        "cylinder { -y, y, .9 open",
                                        "lathe { cubic_spline 5, <.5,-1>, <.7,-.6>, <.8,.1>, <.6,.6>, <.9,1>",
                                        "prism { -.5, .7, 5, <.8,0>, <0,1>, <-1,0>, <0,-.8>, <.8,0> open",
                                        "sphere { 0, 1.2 clipped_by { plane { <.3,1,-.5>, .2 } }",
                                        "difference { sphere { 0, 1.2 } sphere { <.3,.3,-.6>, .8 }"};
             const std::string own = bodies[std::stoul(t.one_of({"0", "1", "2", "3", "4", "5"}))];
             return own + " pigment { rgb .1 } finish { reflection { " + t.one_of({"", ".2, "}) +
                    "1 fresnel } } interior { ior " + t.number(1.3, 2) + " } rotate " + t.vector(-180, 180) +
                    " translate " + place + " } ";
         };
         const std::string room =
             "box { -9, <9,9,8> pigment { rgb .1 } finish { reflection { 1 fresnel } } interior { "
             "ior 1.5 } } ";
         return t.camera() + rainbow + body("-1.2*x") + body("1.2*x") + (t.one_of({"", "r"}) == "r" ? room : "");
     },
     .02},
    {"thin films on bumps that mirror",
     [](Texts& t) {
         return t.camera() + rainbow + "sphere { 0, 1.5 pigment { rgb .2 } normal { bumps " + t.number(.5, 2) +
                " scale " + t.number(.2, .5) + " } finish { reflection " + t.number(.4, .9) + " irid { " +
                t.number(.2, .6) + " thickness " + t.number(.3, 1) + " } } }";
     },
     .02},
    {"fog before an orthographic camera some of whose rays begin in bodies",
     [](Texts& t) {
         return "camera { orthographic location <0," + t.number(-1, 1) +
                ",-6> look_at 0 right 6*x up 4.5*y } plane { y, " + t.number(-1, 0) + t.one_of({" ", " hollow "}) +
                "pigment { rgb .3 } finish { ambient 1 } } sphere { <1,1,-6>, 1 pigment { rgb y } "
                "finish { ambient 1 } } sphere { " +
                t.vector(-1, 1) +
                ", .8 pigment { rgb x } finish { ambient 1 } } fog "
                "{ distance " +
                t.number(4, 20) + " rgb <.7,.7,.9> }";
     },
     .02},
    {"layers that each mirror, in a room of mirrors",
     [](Texts& t) {
         const auto layer = [&](const std::string& color, double low, double high) {
             return " texture { pigment { rgbt " + color + " } finish { ambient .1 diffuse .2 reflection " +
                    t.number(low, high) + " } " + t.one_of({"", "normal { bumps .2 }"}) + " }";
         };
         return "global_settings { max_trace_level 12 } " + t.camera() + lamp + "box { <-3,-2,-9>, <3,3,4> hollow" +
                layer("<.7,.5,.4,0>", .3, .6) + layer("<.6,.3,.2,.7>", .1, .3) + " }";
     },
     .02},
    {"both sides of bodies that are turned inside out",
     [](Texts& t) {
         const std::string solid = t.one_of({"sphere { 0, 1.2 ", "quadric { <1,1.5,1>, 0, 0, -1 ", "torus { .9, .4 ",
                                             "lathe { linear_spline 4, <0,-1>, <1,-.5>, <.5,.6>, <0,1> "});
         const std::string look =
             "texture { pigment { rgb x } finish { specular .9 } } interior_texture { pigment { "
             "rgb y } finish { phong .9 } } rotate " +
             t.vector(-90, 90);
         const std::string bodies[]{solid + "inverse " + look + " }",
                                    "difference { box { <-2,-1,0>, <2,1,2> } " + solid + "} " + look + " }"};
         return t.camera() + lamp + bodies[std::stoul(t.one_of({"0", "1"}))];
     }},
    {"what is inside of bodies, turned inside out or not, and where rays meet them",
     [](Texts& t) {
         const auto solid = [&] {
             const std::string inverse = t.one_of({"", "", "inverse "}), turn = "rotate " + t.vector(-90, 90) + " ";
             return t.one_of({"sphere { <.3,.2,0>, .9 ", "box { -.7, .8 ", "cylinder { -y, y, .6 ", "plane { y, .2 ",
                              "torus { .7, .3 ", "blob { threshold .4 sphere { 0, 1.2, 1 } "}) +
                    turn + inverse + "} ";
         };
         std::string parts = solid() + solid();
         if (t.one_of({"", "n"}) == "n") parts = t.one_of({"union", "difference"}) + " { " + parts + "} " + solid();
         return "camera { location -20*z look_at 0 angle 22 }\n#declare Body = " +
                t.one_of({"union", "merge", "intersection", "difference"}) + " { " + parts +
                t.one_of({"", "inverse "}) +
                "};\n#for (I, 0, 9) #for (J, 0, 9) #local N = 0*x; #local P = <I,J,0>/3.3-<" + t.number(1.2, 1.5) +
                ",1.4,.3>; #local H = trace(Body, P-<.3,.2,4>, <.05,.04,1>, N);\n"
                "box { -.13, .13 translate <P.x-1.6,P.y,0> pigment { rgb inside(Body, P) } finish { ambient 1 } }\n"
                "box { -.13, .13 translate <P.x+1.6,P.y,0> pigment { rgb <N.x+1,N.y+1,H.z+5>/8 } finish { ambient 1 } "
                "} "
                "#end #end";
     }},
    {"noise of functions that are read before the noise is chosen",
     [](Texts& t) {
         return "#include \"functions.inc\"\nglobal_settings { noise_generator " + t.one_of({"1", "3"}) + " } " +
                t.camera() + "plane { z, 1 pigment { function { f_noise3d(x*" + t.number(.5, 2) +
                ",y,z) } } finish { " + "ambient 1 } }";
     }},
    {"normals that spirals with turbulence blend",
     [](Texts& t) {
         const auto part = [&] {
             return t.one_of({"bozo ", "gradient x ", "spiral2 2 ", "wood "}) + t.number(.2, .6) +
                    t.one_of({"", " turbulence .4"}) + " scale " + t.number(.3, .8);
         };
         return t.camera() + lamp + "box { -1.2, 1.2 pigment { rgb <1,.8,.6> } normal { " +
                t.one_of({"spiral1 ", "spiral2 "}) + t.one_of({"1 ", "3 "}) + "normal_map { [0 " + part() + "] [1 " +
                part() + "] } turbulence " + t.number(.2, .8) + t.one_of({"", " frequency 2 phase .3", " sine_wave"}) +
                " scale .6 } rotate " + t.vector(-60, 60) + " }";
     },
     .01},
    {"Julia sets that are taken away, or turned inside out",
     [](Texts& t) {
         const std::string julia = "julia_fractal { <" + t.number(-.3, .1) + "," + t.number(.4, .8) + "," +
                                   t.number(-.5, 0) + ",.1> quaternion max_iteration 6 precision 60 pigment { rgb y } ";
         const std::string box = "box { -1, <.3," + t.number(.2, .8) + ",.9> } ";
         const std::string look = t.one_of({"", "rotate 40*y ", "translate .3 "}) + "pigment { rgb x } }";
         const std::string bodies[]{"difference { " + box + julia + "} " + look,
                                    "intersection { " + box + julia + "inverse } " + look,
                                    "difference { " + box + julia + "inverse } " + look,
                                    "intersection { " + box + "object { " + julia + "} inverse } " + look};
         return t.camera() + lamp + bodies[std::stoul(t.one_of({"0", "1", "2", "3"}))];
     },
     .02},
    {"normals of smooth triangles that are scaled",
     [](Texts& t) {
         const std::string move =
             "scale " + t.vector(.4, 2) + t.one_of({"", " matrix <1,.3,0, .2,1,0, 0,.4,1, 0,0,0>"});
         const std::string look = " pigment { checker rgb 1, rgb <1,.8,.2> scale .4 } finish { diffuse 1 phong .5 } ";
         const std::string triangle =
             "smooth_triangle { <-1.5,-1,0>, <-.6,-.3,-1>, <1.5,-1,.3>, <.8,.1,-1>, <0,1,0>, "
             "<0," +
             t.number(.3, .9) + ",-1>" + look;
         return t.camera() + lamp +
                (t.one_of({"", "u"}) == "" ? triangle + move + " }"
                                           : "union { " + triangle + "rotate 20*z } sphere { 9, 1 } " + move + " }");
     }},
    {"fog in hollow bodies, and around a camera in a body", [](Texts& t) {
         const std::string bodies[]{
             "sphere { " + t.vector(-.5, .5) + ", " + t.number(.8, 1.5) + " pigment { rgbt <1,.8,.6,.6> } " +
                 t.one_of({"hollow", "", "hollow interior { ior 1.3 }"}) + " }",
             "plane { y, 2.2 hollow pigment { bozo color_map { [.5 rgbt 1] [1 rgb 1] } } finish { ambient 1 } } "
             "plane { y, 99 hollow pigment { rgb <.2,.5,.8> } finish { ambient 1 } }",
             std::string("sphere { 0, 30 ") + t.one_of({"", "hollow "}) +
                 "pigment { rgb <.3,.4,.9> } finish { ambient 1 } }",
             t.one_of({"sphere { 0, 1.5 clipped_by { plane { y, .3 rotate 40*x } } ", "cylinder { -y, y, 1.2 open "}) +
                 t.one_of({"pigment { rgbt <1,.8,.6,.6> } hollow }", "pigment { rgb x } finish { reflection .4 } }"})};
         return t.camera() + lamp + bodies[std::stoul(t.one_of({"0", "1", "2", "3", "3"}))] +
                " plane { y, -2 pigment { checker rgb 1, rgb .1 } } sphere { 0, .4 pigment { rgb x } } fog { "
                "distance " +
                t.number(4, 40) + " rgb <.7,.7,.8> }";
     }}};

/// Writes a picture of 8x8 pixels, which are numbers from 0 to 9 of colours (PNG, 11.2).
void write_palette_png(const std::string& path, const std::array<std::uint8_t, 64>& numbers) {
    std::ofstream file(path, std::ios::binary);
    const auto put = [&](std::uint32_t value) {
        for (const int shift : {24, 16, 8, 0}) file.put(static_cast<char>(value >> shift & 255));
    };
    const auto chunk = [&](const std::string& type, const std::string& data) {
        const std::string both = type + data;
        put(static_cast<std::uint32_t>(data.size()));
        file << both;
        put(static_cast<std::uint32_t>(
            crc32(0, reinterpret_cast<const Bytef*>(both.data()), static_cast<uInt>(both.size()))));
    };
    std::string colors, rows;
    for (int i = 0; i < 10; ++i)
        colors += {static_cast<char>(90 * i), static_cast<char>(25 * i), static_cast<char>(-i)};
    for (std::size_t i = 0; i < 64; ++i) {
        if (i % 8 == 0) rows += '\0';
        rows += static_cast<char>(numbers[i]);
    }
    std::string packed(200, '\0');
    uLongf size = packed.size();
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()), rows.size());
    file << "\x89PNG\r\n\x1a\n";
    chunk("IHDR", std::string("\0\0\0\x08\0\0\0\x08\x08\x03\0\0\0", 13));
    chunk("PLTE", colors);
    chunk("IDAT", packed.substr(0, size));
    chunk("IEND", "");
}

/// Returns the share of the pixels that differ by more than 1/255 from POV-Ray's own; nothing if the scene may be
/// speckled, and is told to be.
std::optional<double> differing(const std::string& path, const std::string& text, bool speckled) {
    std::ofstream(path) << header << text << '\n';
    const OpenedScene opened = open_scene(bytes_of(path), path, {.size = {width, height}}, read_pixels);
    const bool whole = opened.summary == "opens whole";
    // Parts at random may share faces, which is told; where POV-Ray speckles none of them, pictures are the same.
    const auto shared = [](const Message& note) {
        return note.text.find("faces of parts in one place") != std::string::npos ||
               note.text.find("a face in the place of another body's") != std::string::npos;
    };
    CHECK((whole || std::ranges::all_of(opened.notes, shared)));
    if (speckled && !whole) return {};
    const View view{.camera = opened.scene.camera,
                    .width = width,
                    .height = height,
                    .depth = opened.scene.settings.max_trace_level};
    const Frame ours = render(opened.scene, view);
    const Picture theirs = run_povray_file({.path = path, .width = width, .height = height, .gamma = 1}, 1).picture;
    int count = 0;
    for (std::size_t i = 0; i < ours.rgb.size(); i += 3) {
        bool differs = false;
        for (std::size_t c = i; c < i + 3; ++c)
            differs |= std::fabs(std::clamp(ours.rgb[c], 0., 1.) - theirs.values[c]) > 1. / 255;
        count += differs;
    }
    return double(count) / (width * height);
}

}  // namespace

TEST_CASE("random scenes of POV-Ray's show what POV-Ray shows") {
    const Scratch folder;
    Picture checkered{8, 8, 3, {}}, grey{8, 8, 1, {}};
    std::array<std::uint8_t, 64> numbers{};
    for (int i = 0; i < 64; ++i) {
        for (const double value : {.2, .5, .9})
            checkered.values.push_back((i % 8 + i / 8) % 2 ? value : .8 - value / 2);
        grey.values.push_back(std::fmod(.37 * i, 1));
        numbers[std::size_t(i)] = static_cast<std::uint8_t>(7 * i % 10);
    }
    for (const int bits : {8, 16}) {
        const std::string ending = bits == 8 ? ".png" : "16.png";
        write_picture(checkered, folder / ("checks" + ending), {bits, 1});
        write_picture(grey, folder / ("grey" + ending), {bits, 1});
    }
    write_palette_png(folder / "palette.png", numbers);
    for (const Kind& kind : kinds)
        for (unsigned seed = 1; seed <= 3; ++seed) {
            Texts texts(seed);
            const std::string text = kind.text(texts);
            CAPTURE(kind.name);
            CAPTURE(text);
            CHECK(differing(folder / "scene.pov", text, kind.speckled).value_or(0) <= kind.share);
        }
}
