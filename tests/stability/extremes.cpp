// Values at the limits of the scene language: no picture ever contains NaN or infinity.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/stability/stage.h"
#include "text/parse.h"

using namespace strahl;
using namespace strahl::stability;

namespace {

void finite_in_all(const Scene& scene, const Still& shot = {33, 25, 5}) {
    for (const Precision precision : precisions) {
        CAPTURE(std::string(name(precision)));
        CHECK(not_finite(shoot(scene, precision, shot)) == 0);
    }
}

void finite_and_at_most_one(const Scene& scene, const Still& shot) {
    for (const Precision precision : precisions) {
        CAPTURE(std::string(name(precision)));
        const Frame frame = shoot(scene, precision, shot);
        CHECK(not_finite(frame) == 0);
        CHECK(*std::max_element(frame.rgb.begin(), frame.rgb.end()) < 1.00001);
    }
}

}  // namespace

TEST_CASE("a light on, inside and very near to a surface") {
    // At the light itself l is 0 / 0.
    for (const double x : {0., -1., -1 + 1e-16, -1 - 1e-16, -1 - 1e-300, -.5}) {
        Stage stage;
        Material shiny = paint({1, 1, 1});
        shiny.specular = 1, shiny.pow = 50, shiny.reflection = .5;
        stage.light({0, x, 0}).put(Sphere{{0, 0, 0}, 1}, shiny);
        stage.put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, shiny).look({0, -6, .5}, {0, x, 0}, 20);
        finite_in_all(stage.scene, {65, 49, 5});
        stage.light(stage.scene.camera.position);
        finite_in_all(stage.scene, {65, 49, 5});
    }
}

TEST_CASE("a light so near, in units of the scene, that the square of its distance is not a number of this kind") {
    // Naive: 1 / sqrt(0), and the surface is infinitely bright. A huge body makes the unit of length large.
    const DVec3 eye{0, 0, 0};
    Stage tube;
    tube.look(eye, {0, 1, 0}, 1, {0, 0, 1}).light(eye).put(Cylinder{{0, 1, 0}, {0, 0, -1e15}, 1}, paint({1, 1, 1}));
    finite_and_at_most_one(tube.scene, {19, 13});
    for (const double off : {1e-15, 1e-14, 1e-13, 1e-9}) {
        CAPTURE(off);
        Stage wall;
        Material shiny = paint({1, 1, 1});
        shiny.specular = 1, shiny.pow = 20;
        wall.look(eye, {1, .1, .2}, 30).light(eye).put(Plane{{off, 0, 0}, {off, 1, 0}, {off, 0, 1}}, paint({1, 1, 1}));
        wall.put(Cylinder{{-9, 0, 0}, {-8, 0, 0}, 2e12}, shiny);
        finite_and_at_most_one(wall.scene, {19, 13});
        // Straight ahead the light falls in at a right angle, however near it is.
        for (const Precision precision : precisions)
            CHECK(pixel(shoot(wall.look(eye, {1, 0, 0}, 1).scene, precision), 32, 24).x > .9);
    }
}

TEST_CASE("a light exactly at a hit point") {
    Material shiny = paint({1, 1, 1});
    shiny.specular = 1, shiny.pow = 2, shiny.reflection = .5;
    Stage stage;
    stage.light({0, -1, 0}).put(Sphere{{0, 0, 0}, 1}, shiny).look({0, -6, 0}, {0, 0, 0}, 20);
    // Shifted by half a pixel, one ray goes exactly along the axis; its neighbours in the pack do not.
    const View view{.camera = stage.scene.camera, .width = 16, .height = 16, .depth = 5, .shift_x = .5, .shift_y = .5};
    for (const Precision precision : precisions) CHECK(not_finite(render(stage.scene, view, precision, 1)) == 0);
}

TEST_CASE("highlights of every exponent") {
    CHECK(std::isnan(std::pow(-1e-8, 20.5)));      // naive: not clamped
    CHECK(std::isinf(std::pow(1.000001f, 1e9f)));  // and with cosines a rounding error above 1
    for (const double pow : {0., 1e-300, .5, 1., 20.5, 1024., 1025., 1e6, 1e9, 1e15}) {
        CAPTURE(pow);
        Stage stage;
        Material shiny = paint({.5, .5, .5});
        shiny.specular = 1, shiny.pow = pow;
        stage.light({0, -6, 0}).light({-3, -3, 3}).put(Sphere{{0, 0, 0}, 1}, shiny);
        for (const Precision precision : precisions) {
            const Frame frame = shoot(stage.scene, precision, {65, 49});
            CHECK(not_finite(frame) == 0);
            for (const double v : frame.rgb) CHECK_UNARY(v >= 0 && v <= 2 * 1.5 + 1e-6);
            // A highlight never removes light, even where the reflected ray points away from the light.
            Scene dull = stage.scene;
            dull.materials[0].specular = 0;
            const Frame without = shoot(dull, precision, {65, 49});
            int darker = 0;
            for (std::size_t i = 0; i < frame.rgb.size(); ++i) darker += frame.rgb[i] < without.rgb[i];
            CHECK(darker == 0);
        }
    }
}

TEST_CASE("a reflected ray that hits a light") {
    // The cosine of the highlight is 1 up to rounding, and 1.0000001 to the power of 1e9 is no highlight.
    Dice dice;
    for (int i = 0; i < 100; ++i) {
        const DVec3 eye = dice.direction() * 6.;
        Material shiny = paint({0, 0, 0});
        shiny.specular = 1, shiny.pow = 1e9;
        Stage stage;
        stage.look(eye, {0, 0, 0}, 20, {.1, .2, .3}).light(eye).put(Sphere{{0, 0, 0}, 1}, shiny);
        for (const Precision precision : precisions) CHECK(shoot(stage.scene, precision, {1, 1}).rgb[0] <= 1);
    }
}

TEST_CASE("sizes and places from the smallest to the largest number a scene may hold") {
    for (const double size : {2.3e-308, 1e-300, 1e-160, 1e-45, 1e-30, 1e-12, 1e12, 1e14, 1e15}) {
        CAPTURE(size);
        Stage stage;
        stage.background({.25, .25, .25});
        // The camera stays in its place: the body is a dot, or all around it.
        Material shiny = paint({.5, .5, .5});
        shiny.reflection = .5, shiny.specular = .5;
        stage.light({-4, -5, 6}).put(Sphere{{0, 0, 0}, size}, shiny).put(Sphere{{.5, 1, 0}, 1}, glass(1.5, .5));
        stage.put(Cylinder{{0, 0, 0}, {0, 0, size}, size}, shiny).put(Cylinder{{0, 0, 0}, {0, 0, size}, 1}, shiny);
        stage.put(Cylinder{{0, 0, 0}, {0, 0, 1}, size}, shiny);
        stage.put(Plane{{0, 0, -size}, {size, 0, -size}, {0, size, -size}}, shiny);
        stage.light({size, size, size}).light({0, -size, 0});
        finite_in_all(stage.scene);
        // Scales everything, the camera included.
        if (size > 1e-300 && size < 1e14) finite_in_all(placed(still_life(), size));
    }
}

TEST_CASE("a body smaller than the last bit of where it is hides nothing else") {
    // The box of such a body is a point, and so is the box around all bounded bodies.
    for (const double size : {2.3e-308, 1e-100, 1e-17, 1e-16})
        for (const DVec3& place : {DVec3(1), DVec3(0), DVec3(-3e5, 2, .1), DVec3(0, 1e15, 0)}) {
            CAPTURE(size);
            CAPTURE(place.x);
            CAPTURE(place.y);
            Stage alone;
            alone.background({.25, .5, .75}).light({-4, -5, 6}).look({0, -6, 1}, {0, 0, 0}, 40);
            alone.put(Plane{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, paint({1, 1, 1}));
            Stage dust = alone;
            dust.put(Sphere{place, size}, paint({1, 0, 0}));
            Stage two = dust;
            two.put(Sphere{place, size / 2}, paint({1, 0, 0}));
            for (const Precision precision : precisions) {
                CAPTURE(std::string(name(precision)));
                const Frame frame = shoot(alone.scene, precision);
                for (const Scene& scene : {dust.scene, two.scene}) {
                    const Frame other = shoot(scene, precision);
                    CHECK(not_finite(other) == 0);
                    CHECK(share_apart(other, frame, 1e-3) < .02);
                }
            }
        }
}

TEST_CASE("all bodies at one place") {
    for (const double place : {0., 1e-300, 1., 1e15}) {
        Stage stage;
        stage.look({place, place, place}, {place, place + std::max(1., place), place}, 45);
        for (int i = 0; i < 40; ++i) stage.put(Sphere{DVec3(place), 1. + i % 3}, glass(1 + .1 * (i % 4), .5));
        stage.light(DVec3(place)).background({1, 1, 1});
        finite_in_all(stage.scene, {17, 13, 3});
    }
}

TEST_CASE("extreme scaling") {
    for (const double stretch : {1e-12, 1e-6, 1e6, 1e12})
        for (const int axis : {0, 1, 2}) {
            CAPTURE(stretch);
            CAPTURE(axis);
            DVec3 by(1);
            by[axis] = stretch;
            Stage stage;
            Material shiny = paint({.5, .5, .5});
            shiny.reflection = .5;
            stage.light({-4, -5, 6}).background({.5, .25, 0});
            stage.put(Sphere{{0, 0, 0}, 1}, shiny, {Scale{by}, Rotate{{10, 20, 30}}});
            stage.put(Cylinder{{0, 0, -1}, {.5, .5, 1}, .5}, glass(1.5, .5), {Scale{by}});
            stage.put(Plane{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, shiny, {Rotate{{10, 20, 30}}, Scale{by}});
            finite_in_all(stage.scene);
        }
}

TEST_CASE("the brightest scene allowed gives finite values in every precision") {
    // Products of three: a light, a share and a colour. Float ends at 3.4e38.
    const std::string largest = "1e308";
    const auto text = [](const std::string& bright) {
        return "camera { position <0,-6,0> look_at <0,0,0> sky <0,0,1> fov 20 }\n"
               "global_settings { ambient_light <" +
               bright +
               ", 1, 1> }\n"
               "background { color <" +
               bright +
               ", 0, 0> }\n"
               "light { position <-4,-5,6> color <" +
               bright +
               ", 1, 0> }\n"
               "sphere { <0,0,0>, 1 material { rgb <" +
               bright + ", 1, 0> diffuse " + bright + " specular " + bright + " ambient " + bright +
               " reflection 1 } }\n";
    };
    CHECK_THROWS_AS(parse_scene(text(largest), "bright.rt"), FileError);
    finite_in_all(parse_scene(text("1e9"), "bright.rt"));
}

TEST_CASE("the largest and smallest index of refraction allowed") {
    const auto text = [](const std::string& ior) {
        return "camera { position <0,-6,0> look_at <0,0,0> sky <0,0,1> fov 20 }\n"
               "sphere { <0,0,0>, 1 material { refraction 1 ior " +
               ior + " } }\n";
    };
    for (const char* ior : {"2.3e-308", "1e308"}) CHECK_THROWS_AS(parse_scene(text(ior), "glass.rt"), FileError);
    for (const char* ior : {"1e-9", "1e9"}) finite_in_all(parse_scene(text(ior), "glass.rt"));
}

TEST_CASE("glass brighter than white, and total reflection without loss, in float too") {
    // Naive: products overflow, and infinity times 0 is NaN.
    for (const double bright : {2., 1e9}) {
        Stage stack;
        Material tinted = glass(1);
        tinted.rgb = {bright, 0, 1}, tinted.diffuse = 1;
        stack.light({0, 0, 900}).put(Plane{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, paint({1, 1, 1}));
        for (int i = 0; i < 100; ++i) stack.put(Sphere{{0, 0, double(i)}, .5}, tinted);
        finite_in_all(stack.scene);
    }
    Stage trap;
    Material twice = glass(3);
    twice.reflection = 1;  // 2 in all, at each of 255 reflections
    trap.put(Sphere{{0, 0, 0}, 1}, twice).light({0, 3, 3}).look({0, -.99, 0}, {.5, -.99, 0}, 40);
    finite_in_all(trap.scene, {8, 6, 256});
}

TEST_CASE("noise in float, so far from the eye") {
    // Up to these distances, in cells of the coarsest octave, float's noise is that of double to half a step of 8 bits.
    const auto patch = [](const std::string& kind, double away) {
        Scene scene = parse_scene(
            "global_settings { ambient_light <1, 1, 1> }\n"
            "defaultmaterial { ambient 1  diffuse 0  reflection 0  specular 0 }\n"
            "camera { position <0, 0, 1>  look_at <1, .3, 0>  sky <0, 1, 0>  fov 1 }\n"
            "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0>  material { rgb " +
                kind + " colors { 0 <0, 0, 0>  1 <1, 1, 1> } } } }",
            "noise");
        scene.camera.position.z = scene.camera.look_at.x = away;
        scene.camera.fov = std::atan(4 / (away * std::sqrt(2.))) * 57.29577951308232;  // 8 cells wide
        return scene;
    };
    const auto off = [&](const std::string& kind, double away) {
        const Scene scene = patch(kind, away);
        const Still shot{160, 120, 1};
        return largest_difference(shoot(scene, Precision::float32, shot), shoot(scene, Precision::float64, shot));
    };
    for (const auto& [kind, reach] : {std::pair("noise { octaves 1", 10000.), std::pair("noise { octaves 6", 4000.),
                                      std::pair("marble { turbulence 1", 1000.)}) {
        CAPTURE(std::string(kind));
        for (const double share : {.01, .1, 1.}) CHECK(off(kind, share * reach) < 1 / 510.);
        CHECK(off(kind, 10 * reach) > 1 / 510.);
    }
}
