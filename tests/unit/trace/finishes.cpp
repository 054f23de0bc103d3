// Shadow rays through clear surfaces; materials that are mixed by shares or have two sides, light from behind, beams,
// and groups of lights.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "tests/referee/dice.h"
#include "tests/unit/scenes.h"
#include "text/parse.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

const std::string stage = R"(
camera { position <0, -9, 4>  look_at <0, 0, 0.8>  up <0, 0, -1>  fov 22 }
background { color <.1, .2, .3> }
defaultmaterial { rgb <0.8, 0.3, 0.2>  reflection 0  diffuse 0.8  ambient 0.05  specular 0  pow 40 }
)";
const std::string lamp = "light { position <-1, -1, 4>  color <1, .9, .8> }\n";

Frame picture(const std::string& text) {
    const Scene scene = parse_scene(stage + text, "x");
    return render(scene, {.camera = scene.camera, .width = 40, .height = 30, .depth = 5}, Precision::float64, 1);
}
/// Returns the largest difference between a picture and sums of others with these weights.
double off(const Frame& mixed, const Frame& a, double share, const Frame& b, double other) {
    double most = 0;
    for (std::size_t i = 0; i < mixed.rgb.size(); ++i)
        most = std::max(most, std::abs(mixed.rgb[i] - (share * a.rgb[i] + other * b.rgb[i])));
    return most;
}

}  // namespace

TEST_CASE("a picture of mixed materials is the mean of their pictures") {
    const auto scene = [&](const std::string& material) {
        return picture(lamp + "box { <-3, -3, -.2>, <3, 3, 0> }  sphere { <0, 0, 1>, 1 material { " + material +
                       " } }");
    };
    const std::string matt = "rgb <.8, .3, .2>  blinn .7  roughness .1 ", rest = " ambient .05  diffuse .7 ";
    const std::string mirror = "rgb <0, .5, 1>  reflection .6  blinn .5  metallic 1  gilding 1 " + rest;
    const std::string layered = "rgb <0, .5, 1> " + rest, coat = "coat { rgb <1, 0, 0, 0, .5>  diffuse .3 } ";
    const Frame one = scene(matt);
    const auto check = [&](const std::string& lowest, const std::string& coats) {
        const Frame two = scene(lowest + coats);
        const Frame mixed =
            scene(matt + "share <.25, .25, .25>  coat { share <.75, .75, .75> " + lowest + " } " + coats);
        CHECK(off(mixed, one, .25, two, .75) < 1e-9);
        CHECK(off(one, two, 1, two, 0) > .1);
    };
    check(mirror, "");
    check(layered, coat);
}

TEST_CASE("layers have their own bumps") {
    const auto scene = [&](const std::string& material) {
        return picture(lamp + "box { <-3, -3, -.2>, <3, 3, 0> }  sphere { <0, 0, 1>, 1 material { ambient 0  " +
                       material + " } }");
    };
    const std::string bozo = " bump solid { bozo  height 2  scale .2 } ",
                      waves = " bump solid { waves  height 1  scale .3 } ";
    const std::string flat = " bump solid { waves  height 0 } ", none;
    const std::string satin = "rgb <.9, .8, .7>  diffuse .4  reflection .2 ",
                      matt = "rgb <.8, .3, .2>  blinn .7  reflection .3  diffuse .6 ";
    for (const auto& [a, b] : {std::pair(bozo, waves), {bozo, none}, {none, waves}}) {
        CAPTURE(a + b);
        // Checks that each of two stacks is lit and mirrors by its own normals.
        const Frame one = scene(satin + a), two = scene(matt + b);
        const std::string own = b.empty() ? flat : b;
        CHECK(off(scene(satin + a + "share <.25, .25, .25>  coat { share <.75, .75, .75> " + matt + own + " }"), one,
                  .25, two, .75) < 1e-9);
        CHECK(off(one, two, 1, two, 0) > .1);
        // A clear coat adds its highlight to what is below it.
        const std::string clear = " blinn .9  reflection .3  diffuse 0 ";
        const Frame below = scene("rgb <.8, .3, .2>  diffuse .6 " + a), above = scene("rgb <0, 0, 0> " + clear + b);
        Frame both = scene("rgb <.8, .3, .2>  diffuse .6 " + a + "coat { rgb <1, 1, 1, 0, 1> " + clear + own + " }");
        const Frame dark = scene("rgb <0, 0, 0>");
        for (std::size_t i = 0; i < both.rgb.size(); ++i) both.rgb[i] += dark.rgb[i];
        CHECK(off(both, below, 1, above, 1) < 1e-9);
    }
    // A coat without a bump has that of the material.
    const std::string veil = "coat { rgb <0, 1, 0, 0, .5>  blinn .5 ";
    const Frame same = scene("rgb <.8, .3, .2>" + bozo + veil + "}");
    CHECK(off(same, scene("rgb <.8, .3, .2>" + bozo + veil + bozo + "}"), 1, same, 0) == 0);
    CHECK(off(same, scene("rgb <.8, .3, .2>" + bozo + veil + flat + "}"), 1, same, 0) > .01);
}

TEST_CASE("rays of layers with their own bumps are all followed where one pixel makes more than are held at once") {
    const auto scene = [](const std::string& first, const std::string& second) {
        const Scene room = parse_scene(stage + lamp +
                                           "box { <-9, -9, -9>, <9, 9, 9>  material { rgb <1, .8, .6>  reflection .3"
                                           "  coat { rgb <.9, .5, .5, 0, .5>  reflection .3  diffuse .1 " +
                                           first + " }  coat { rgb <.5, .5, .9, 0, .5>  reflection .2  diffuse .1 " +
                                           second + " } } }",
                                       "x");
        Camera camera = room.camera;
        camera.position = {0, -7, 1};
        return render(room, {.camera = camera, .width = 3, .height = 2, .depth = 10}, Precision::float64, 1);
    };
    // Each hit makes three rays, so that 19683 are in the last generation of a pixel.
    const Frame one = scene("", "");
    const Frame three = scene("bump solid { waves  height 0 }", "bump solid { waves  height 0  frequency 2 }");
    CHECK(off(three, one, 1, one, 0) < 1e-9);
}

TEST_CASE("light goes through mixed glass, and its shadows, as the mean of what goes through both") {
    const auto scene = [&](const std::string& material) {
        return picture(
            lamp +
            "box { <-3, -3, -.2>, <3, 3, 0> }  triangle { <-2, -1, 1>, <2, -1, 1>, <0, 2, 2>  material { diffuse "
            "0  ambient 0 " +
            material + " } }");
    };
    const Frame mixed =
        scene("rgb <1, 0, 0, 1, 0>  share <.5, .5, .5>  coat { rgb <0, 1, 0, 1, 0>  share <.5, .5, .5> }");
    CHECK(off(mixed, scene("rgb <.5, .5, 0, 1, 0>"), 1, mixed, 0) < 1e-12);
    CHECK(off(mixed, scene("rgb <0, 0, 0>"), 1, mixed, 0) > .1);
}

namespace {

/// Returns how bright (x, 0, 0) is, seen from above.
double red(const std::string& text, double x) {
    const Scene scene = parse_scene(
        "camera { position <0, 0, 9>  look_at <" + std::to_string(x) + ", 0, 0>  up <0, -1, 0>  fov 1 } " + text, "x");
    return render(scene, {.camera = scene.camera, .width = 1, .height = 1}, Precision::float64, 1).rgb[0];
}
const std::string white = "material { rgb <1, 1, 1>  diffuse 1  ambient 0  reflection 0  specular 0 ";

}  // namespace

TEST_CASE("a body looks as its two sides do, to the eye and to shadow rays") {
    const auto scene = [&](const std::string& up, const std::string& material, const std::string& more) {
        return picture(
            "light { position <-1, -1, 4>  color <1, .9, .8>  shadowless } box { <-3, -3, -.2>, <3, 3, 0> } "
            "disc { <0, 0, 1>, <0, 0, " +
            up + ">, 1 material { " + material + " } }" + more);
    };
    const std::string veil = "rgb <.9, .5, .1, .6, .1>  blinn .7  diffuse .4 ", reflecting = "rgb <.2, .5, 1> ";
    const std::string mirror = reflecting + "reflection .5  ambient .2  diffuse .3 ";
    const std::string coat = "coat { rgb <1, 0, 0, 0, .5>  diffuse .3 } ";
    for (const std::string& more :
         {std::string(),
          std::string(
              "sphere { <0, 0, 3>, .2 material { fade_distance 1  fade_power 2  rgb <1, 1, 1, 0, 1>  ior 1.2 } }")}) {
        CAPTURE(more);
        const std::string sides = veil + coat + "inside 0  coat { " + mirror + " outside 0 } " +
                                  "coat { rgb <1, 1, 0, .5, .25>  diffuse .3 }";
        const std::string inner = mirror + "coat { rgb <1, 1, 0, .5, .25>  diffuse .3 }";
        const Frame outer = scene("1", veil + coat, more), inside = scene("-1", inner, more);
        CHECK(off(scene("1", sides, more), outer, 1, outer, 0) < 1e-12);
        CHECK(off(scene("-1", sides, more), inside, 1, inside, 0) < 1e-12);
        CHECK(off(outer, inside, 1, inside, 0) > .1);
    }
    // Checks balls of glass: light that comes out of one has passed both sides, to the eye and from the lamp.
    const std::string clear = "diffuse 0  ambient 0  reflection 0  specular 0  ";
    const std::string light = "light { position <0, 0, 8>  color <1, 1, 1> } ";
    const std::string floor = "plane { <0, 0, -2>, <1, 0, -2>, <0, 1, -2> " + white + "} } ";
    const auto ball = [&](const std::string& how) {
        return "sphere { <0, 0, 0>, 1  material { " + clear + how + " } } ";
    };
    const double lit = red(light + floor, 0);
    CHECK(red(light + floor +
                  ball("rgb <.5, 0, 0, 1, 0>  inside 0  coat { rgb <1, 0, 0, 1, 0> " + clear + " outside 0 }"),
              0) == doctest::Approx(.25 * lit));
    CHECK(red(light + floor +
                  ball("rgb <.5, 0, 0, 1, 0>  inside 0  coat { rgb <.5, 0, 0, 1, 0> " + clear + " outside 0 }"),
              0) == doctest::Approx(.0625 * lit));
}

TEST_CASE("lights of a group shine on its bodies alone, and some lights take light away") {
    const std::string lights =
        "light { position <0, 0, 5>  color <1, 1, 1> } light { position <0, 0, 5>  color <.25, 0, 0>  group 2 } "
        "light { position <0, 0, 5>  color <.125, 0, 0>  group 7 } ";
    const auto disc = [&](const std::string& how) { return "disc { <0, 0, 0>, <0, 0, 1>, 2 " + white + how + " } } "; };
    CHECK(red(lights + disc(""), 0) == doctest::Approx(1));
    CHECK(red(lights + disc("group 2"), 0) == doctest::Approx(1.25));
    CHECK(red(lights + disc("group 7"), 0) == doctest::Approx(1.125));
    CHECK(red(lights + disc("group 3"), 0) == doctest::Approx(1));
    CHECK(red(lights + disc("group 2  common 0"), 0) == doctest::Approx(.25));
    CHECK(red(lights + disc("common 0"), 0) == 0);
    // Bodies of no group keep such light from others.
    CHECK(red(lights + disc("group 2  common 0"), 1) > .2);
    CHECK(red(lights + disc("group 2  common 0") + "sphere { <.5, 0, 2.5>, .1 }", 1) == 0);
    const std::string darker =
        "light { position <0, 0, 5>  color <-.75, 0, 0> } light { position <0, 0, 5>  color <1, 1, 1> } ";
    CHECK(red(darker + disc(""), 0) == doctest::Approx(.25));
    CHECK(red("light { position <0, 0, 5>  color <-.75, 0, 0>  edges <1, 0, 0>, <0, 1, 0>  soft } light { position <0, "
              "0, 5>  color <1, 1, 1> } " +
                  disc(""),
              0) == doctest::Approx(.25));
}

TEST_CASE("the old opacity counts how bright a colour is that filters") {
    const std::string light = "light { position <0, 0, 5>  color <1, 1, 1> } ";
    const auto disc = [&](const std::string& how) {
        return "disc { <0, 0, 0>, <0, 0, 1>, 2  material { diffuse 1  ambient 0  reflection 0  specular 0  rgb <.5, "
               ".25, 0, .5, .25> " +
               how + " } } ";
    };
    CHECK(red(light + disc(""), 0) == doctest::Approx(.5 * .25));
    CHECK(red(light + disc("old_opacity 1"), 0) == doctest::Approx(.5 * .5));
}

TEST_CASE("a beam fades around its axis, and surfaces are lit from behind") {
    const std::string floor = "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> " + white + "} }  sphere { <1, 0, 12>, 1 } ";
    const std::string light = "light { direction <0, 0, -1>  from <0, 0, 3>  color <1, 1, 1>  beam 2 ";
    for (const double d : {.1, .4, .8, 1.3, 1.9}) {
        CAPTURE(d);
        const double s = 1 - d / 2, u = std::min(s / .75, 1.), faded = u * u * (3 - 2 * u);
        CHECK(red(light + "core .5  tightness 1.5 } " + floor, d) == doctest::Approx(std::pow(s, 1.5) * faded));
        CHECK(red(light + "} " + floor, d) == doctest::Approx(1));
    }
    CHECK(red(light + "} " + floor, 2.1) == 0);
    const std::string below = "light { position <0, 0, -5>  color <1, 1, 1> } ";
    const auto disc = [&](const std::string& how) { return "disc { <0, 0, 0>, <0, 0, 1>, 2 " + white + how + " } } "; };
    CHECK(red(below + disc(""), 0) == 0);
    CHECK(red(below + disc("behind .25"), 0) == doctest::Approx(.25));
    CHECK(red(below + disc("both_sides 1  behind .25"), 0) == doctest::Approx(1));
    CHECK(red(below + disc("both_sides 1") + "sphere { <0, 0, -3>, 1 }", 0) == 0);
    // A thin film gives light colours.
    const auto film = [&](double wave) { return 1 + .5 * std::cos(2 * 3.14159265358979 * .3 * 2 / wave); };
    const std::string above = "light { position <0, 0, 5>  color <1, 1, 1> } ";
    CHECK(red(above + disc("irid .5  film .3"), 0) == doctest::Approx(film(.7)));
    CHECK(red(above + "background { color <.5, .5, .5> } " +
                  "disc { <0, 0, 0>, <0, 0, 1>, 2  material { rgb <0, 0, 0, 0, 1>  clarity .5  reflection 0  specular "
                  "0 } }",
              0) == doctest::Approx(.25));
    // The far side of a ball keeps the light from its near side.
    CHECK(red(below + "sphere { <0, 0, 0>, 1 " + white + "both_sides 1 } }", 0) == 0);
}

namespace {

template <class... Part>
std::string joined(const Part&... parts) {
    std::ostringstream all;
    all.precision(17);
    (all << ... << parts);
    return all.str();
}

constexpr int stack_pixels = 15;            // of a side of the picture
constexpr double stack_spacing = .5;        // of its columns, in the middle row, on the floor
constexpr double passed_in_shadows = 1e-3;  // up to which distance from their starts shadow rays see nothing
constexpr double stack_clarity = .75;       // the share of light that a surface lets through

/// Panes above one point of the floor.
struct Stack {
    std::string text;
    std::vector<double> heights;  // of their clear surfaces
    bool opaque = false;
};

Stack random_stack(Dice& dice, double y) {
    Stack stack;
    double z = .3;
    const auto pane = [&](double thickness) {
        const auto box = [&](double wider, double low, double high) {
            const double r = .05 + wider;
            return joined("box { <", -r, ", ", y - r, ", ", low, ">, <", r, ", ", y + r, ", ", high, "> } ");
        };
        const double low = z, high = z + thickness;
        const auto prism = [&](const std::string& last) {
            return joined("prism { ", low, ", ", high, "  contour { <.07, ", y - .02, "> line <0, ", y + .07,
                          "> line <-.07, ", y - .02, "> ", last, "} } ");
        };
        stack.heights.insert(stack.heights.end(), {low, high});
        switch (dice.upto(3)) {
            case 0:
                return box(0, low, high);
            case 1:
                return "intersection { " + box(0, low - .1, high) + box(.01, low, high + .1) + "} ";
            case 2:
                return "intersection { " + prism(joined("line <0, ", y - .07, "> ")) + box(0, low - .1, high + .1) +
                       "} ";
            default:
                return prism("");
        }
    };
    for (int i = dice.upto(5); i >= 0; --i) {
        if (dice.chance(.3)) {
            stack.text += joined("disc { <0, ", y, ", ", z, ">, <0, 0, 1>, .05 } ");
            stack.heights.push_back(z);
        } else {
            const double thickness = dice.chance(.5) ? dice.in(2e-4, 3e-3) : dice.in(.01, .05);
            stack.text += pane(thickness);
            z += thickness;
        }
        z += dice.chance(.5) ? dice.in(2e-4, 3e-3) : dice.in(.01, .1);
    }
    stack.opaque = dice.chance(.15);
    if (stack.opaque)
        stack.text += joined("sphere { <0, ", y, ", ", dice.in(.4, 2), ">, .04 material { rgb <1, 1, 1> } } ");
    return stack;
}

/// Returns how much light comes down to the floor: from surface to surface, POV-Ray passes over those that are
/// near to the one before. Behind what it passed over it sees the next one, however near.
double light_below(const Stack& stack) {
    double share = stack.opaque ? 0 : 1, from = 0, over = passed_in_shadows;
    for (const double height : stack.heights) {
        if (height < from) continue;
        if (height - from < over) {
            from += over, over = 0;
            continue;
        }
        share *= stack_clarity, from = height, over = passed_in_shadows;
    }
    return share;
}

}  // namespace

TEST_CASE("light that passes clear surfaces near to each other") {
    Dice dice(70);
    for (int n = 0; n < 20; ++n) {
        std::vector<Stack> stacks;
        const double fov = 180 / std::numbers::pi * std::atan(stack_spacing * stack_pixels / 2 / std::hypot(9, 9));
        std::string text =
            joined("camera { position <9, 0, 9>  look_at <0, 0, 0>  up <0, 0, 1>  orthographic  fov ", fov,
                   " }\nlight { direction <0, 0, -1>  color <1, 1, 1> }\n"
                   "box { <-9, -9, -1>, <9, 9, 0> material { rgb <1, 1, 1>  diffuse 1  ambient 0  reflection 0  "
                   "specular 0 } }\n"
                   "defaultmaterial { diffuse 0  ambient 0  reflection 0  specular 0  rgb <1, 1, 1, 0, ",
                   stack_clarity, "> }\n");
        const int count = n % 2 == 0 ? 3 : stack_pixels;  // few bodies, or so many that they are in a hierarchy
        for (int i = 0; i < count; ++i) {
            stacks.push_back(random_stack(dice, stack_spacing * (stack_pixels / 2 - i)));
            text += stacks.back().text + "\n";
        }
        Scene scene = parse_scene(text, "x");
        scene.settings.passed_over = passed_in_shadows / 10;
        for (const Simd simd : {Simd::scalar, Simd::automatic}) {
            const Frame frame =
                render(scene, {.camera = scene.camera, .width = stack_pixels, .height = stack_pixels, .depth = 9},
                       Precision::float64, 1, simd);
            for (int i = 0; i < count; ++i) {
                CAPTURE(text);
                CAPTURE(i);
                CHECK(frame.rgb[static_cast<std::size_t>(3 * (stack_pixels / 2 * stack_pixels + i))] ==
                      doctest::Approx(light_below(stacks[static_cast<std::size_t>(i)])).epsilon(1e-9));
            }
        }
    }
}
