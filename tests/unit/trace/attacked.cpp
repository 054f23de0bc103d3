// Scenes that tests/attack found faults in, as small as they could be made.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "tests/attack/bodies/body_check.h"
#include "tests/attack/bodies/degenerate_scene.h"
#include "tests/attack/renderer/picture_check.h"
#include "tests/attack/renderer/shrink.h"
#include "text/parse.h"

using namespace strahl;

namespace {

std::vector<std::string> faults(const std::string& text, int width, int height) {
    WildScene wild{parse_scene(text, "text"), {}};
    wild.view = {
        .camera = wild.scene.camera, .width = width, .height = height, .depth = wild.scene.settings.max_trace_level};
    return PictureCheck().faults(wild);
}

}  // namespace

TEST_CASE("a box thinner than float can say") {
    for (const std::string thickness : {"1e-30", "8e-107", "1e-300"}) {
        CAPTURE(thickness);
        const std::string text =
            "camera { position <-3, -4, -4> look_at <0, 0, 0> up <0, 0, 1> fov 45 }"
            "background { color <.7, .4, .75> }"
            "box { <0, 0, 0>, <-.7, -" +
            thickness +
            ", 1> } box { <0, 0, 1>, <1, 1, 0> }"
            "sphere { <0, 0, 0>, 1 } cylinder { <0, 0, 0>, <0, 1, 0>, 1 }";
        CHECK(faults(text, 30, 16) == std::vector<std::string>{});
    }
}

TEST_CASE("a cone so flat that its height is lost") {
    CHECK(faults("camera { position <0, 0, -3e8> look_at <0, 0, 0> up <0, 1, 0> fov 45 }"
                 "cone { <0, 0, 0>, .1, <0, 0, .1>, 5e7 material { ambient 1 } }",
                 19, 20) == std::vector<std::string>{});
    CHECK(faults("camera { position <0, 0, -3e8> look_at <0, 0, 0> up <0, 1, 0> fov 45 }"
                 "cylinder { <0, 0, 0>, <0, 1e-6, 0>, 1e-6 } sphere { <0, 0, 0>, 1e-6 }"
                 "box { <0, 0, 0>, <1e-6, 1e-6, 1e-6> }"
                 "cone { <0, 0, 0>, 1e-6, <0, 0, 1e-6>, 1e9 scale .08 material { ambient 1 } }",
                 16, 7) == std::vector<std::string>{});
    CHECK(faults("camera { position <0, 0, 0> look_at <0, 0, 1> up <0, 1, 0> fov 45 } background { color <.2, .5, 1> }"
                 "cone { <-1.8, -1.8, -1.8000000000000105>, 3, <-1.8, -1.8000000000000002, -1.8000000000000105>, 1 }",
                 28, 18) == std::vector<std::string>{});
    for (const std::string height : {"2e-47", "4e-197", "1e-300"})
        CHECK(faults("camera { position <0, 0, 1> look_at <0, 0, 0> up <0, 1, 0> fov 45 }"
                     "cone { <0, 0, 0>, 1, <0, 1, 0>, 1 } sphere { <0, 0, 0>, 1 }"
                     "cone { <-1, 0, -" +
                         height + ">, 1, <-1, 0, 0>, 2 material { ambient 1 } }",
                     26, 6) == std::vector<std::string>{});
}

TEST_CASE("a mirror whose squared radius float can hardly say") {
    for (const std::string radius : {"5.5e-14", "6e-14", "6.5e-14"}) {
        CAPTURE(radius);
        CHECK(faults("camera { position <0, 0, -1e9> look_at <1e-6, 0, -1e9> up <0, 1, 0> fov 30 }"
                     "background { color <.2, .5, 1> }"
                     "sphere { <1.5e-13, 0, -1e9>, " +
                         radius +
                         " material { reflection 1 } }"
                         "box { <2e-6, -1e9, 0>, <1e9, -2e-6, -3e-6> material { ambient .7 } }"
                         "box { <0, 0, 0>, <1e-6, 1e-6, 1e-6> } sphere { <0, 0, 0>, 1e-6 }",
                     30, 20) == std::vector<std::string>{});
    }
}

TEST_CASE("shrinking a scene ends") {
    // 0.3 and 3 * 0.1, the next number above, became each other for ever.
    WildScene wild{parse_scene("camera { position <0, 0, .31> look_at <0, 1, 0> up <0, 0, 1> fov 45 }", "text"), {}};
    int tries = 0;
    const WildScene small = shrunk(wild, [&](const WildScene& w) {
        if (++tries > 10000) throw std::runtime_error("no end");
        return w.scene.camera.position.z > .29 && w.scene.camera.position.z < .32;
    });
    CHECK(small.scene.camera.position.z == .3);
}

TEST_CASE("a cone that is nothing in float") {
    for (const std::string size : {"4e-225", "1e-100"}) {
        CAPTURE(size);
        CHECK(faults("camera { position <1, 0, 0> look_at <0, 0, 1> up <1, 0, 0> fov 89.99999999999999 }"
                     "cone { <1.980754203476951, 0, 0>, 0, <1.980754203476951, 0, -" +
                         size + ">, " + size +
                         " } sphere { <0, 0, 0>, 1 material { ior 1.3 } } sphere { <0, 0, 0>, 1 }"
                         "cylinder { <0, 0, 0>, <0, 0, 1>, 1 }"
                         "plane { <0, 0, 0>, <0, 0, 1>, <0, 1, 0> material { ambient 1 } }"
                         "sphere { <0, 0, 0>, 1e9 material { ior 3 } }",
                     16, 15) == std::vector<std::string>{});
    }
}

TEST_CASE("one side shrinks more than float can say") {
    const std::string sky = "background { color <.9, .2, .4> }";
    CHECK(faults("camera { position <-5, 0, 1> look_at <0, 0, 0> up <0, 0, 1> fov 45 }" + sky +
                     "cone { <0, 0, 0>, 0, <0, 0, 1>, 1 scale <-1, -2.3473442004460097, 7.943614243260376e-11> }",
                 7, 16) == std::vector<std::string>{});
    CHECK(faults("camera { position <2, 1.3, 4> look_at <0, 0, 1> up <-1.5, 0, -1.3> fov 45 }"
                 "cylinder { <0, -.7, 0>, <1, 0, -2>, .4 scale <-1.25, -.5, 4.9457630743498925e-08>"
                 "material { ambient 1 } } sphere { <0, 0, 0>, 1 }",
                 12, 9) == std::vector<std::string>{});
    CHECK(faults("camera { position <0, 0, -6> look_at <0, 0, 0> up <0, 1, 0> fov 45 }" + sky +
                     "sphere { <0, 0, 0>, 1 rotate <40, 30, 20> scale <1, 1, 3e-9> rotate <50, 60, 0> }",
                 32, 24) == std::vector<std::string>{});
    CHECK(faults("camera { position <0, 0, -6> look_at <0, 0, 0> up <0, 1, 0> fov 45 }" + sky +
                     "box { <-1, -1, -1>, <1, 1, 1> rotate <40, 30, 20> scale <1, 1, 3e-9> rotate <50, 60, 0> }",
                 32, 24) == std::vector<std::string>{});
}

TEST_CASE("bodies of which one is the unit of length, and the square of the other no number in it") {
    CHECK(faults("camera { position <0, 0, 0> look_at <0, 0, 1> up <0, 1, 0> fov 45 }"
                 "cone { <0, 0, 0>, 1, <0, 0, 1>, 1 scale 4.432039137151644e-142 }"
                 "cylinder { <0, 0, 0>, <1e9, 0, 0>, 1e7 material { ambient 1 } }",
                 17, 24) == std::vector<std::string>{});
    CHECK(faults("camera { position <0, 0, -1e-77> look_at <0, 0, 0> up <0, 1, 0> fov 45 }"
                 "cylinder { <0, 1, 0>, <0, 0, 0>, 1 scale <1.5, 1.3237483668007852, -2> material { ambient 1 } }"
                 "sphere { <0, 0, 0>, 1 scale -5.671912830527493e-78 }"
                 "plane { <0, 0, 0>, <0, 0, 1>, <1, 0, 0> }",
                 30, 21) == std::vector<std::string>{});
}

TEST_CASE("glass in coloured fog that lets nearly nothing through") {
    // The colours of refracted rays were divided by the largest of them, whose inverse is infinite.
    for (const std::string body : {"plane { <0, 0, -1>, <1, 0, -1>, <0, 1, -1>", "box { <-4, -1, -1>, <4, 3, 1>"})
        CHECK(faults("camera { position <0, -4, 1> look_at <0, 0, 0> up <0, 0, -1> fov 40 }"
                     "light { position <-5, -5, 2> color <1, 1, 1> }"
                     "fog { distance 2 color <1, 2, 1> altitude .5 transmit .7 filter .4 }" +
                         body + " material { reflection .5 refraction 5e-324 ior .9 } }",
                     24, 18) == std::vector<std::string>{});
}

TEST_CASE("bodies with degenerate values are those of the referee in every precision") {
    constexpr int scenes = 150;
    int checked[3] = {};
    for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
        const DegenerateScene made = degenerate_scene(seed);
        const BodyFaults faults = faults_of(made.scene, made.condition);
        CAPTURE(seed);
        CAPTURE(made.words);
        for (int p = 0; p < 3; ++p) checked[p] += faults.checked[p];
        CHECK(faults.pixels == std::array{0, 0, 0});
    }
    CHECK(checked[0] > scenes / 4);
    CHECK(std::min(checked[1], checked[2]) > scenes / 2);
}

TEST_CASE("bodies that once had holes") {
    const auto pixels = [](const std::string& scene, double condition) {
        const std::string sky = "background { color <.4, .1, .2> } ";
        return faults_of(parse_scene(sky + scene, "text"), condition).pixels;
    };
    const std::string glass = " material { reflection .4 refraction .6 diffuse .6 ambient .2 ior 1.3 } } ";
    // The axis was a unit vector in double alone, and points were off the widest radius in long double.
    CHECK(pixels("camera { position <0, -8, 0> look_at <0, 0, 0> sky <0, 0, 1> fov 12 }"
                 "light { position <-5, -5, 2> color <1, 1, 1> } cone { <0, 0, -1>, 1, <.3, .7, 1>, 1 }",
                 1e2) == std::array{0, 0, 0});
    // Where bodies are moved far, points were rounded before the origin came near the eye.
    for (const std::string body : {"box { <0, 0, 0>, <1, .7, .01> rotate <0, 0, 20>", "box { <0, 0, 0>, <1, .7, .3>",
                                   "sphere { <.5, .3, .1>, .4 scale <1, 1, .001>",
                                   "cone { <0, 0, 0>, 1, <0, 0, .2>, 1"
                                   " scale <1, 1, .3>"}) {
        CAPTURE(body);
        CHECK(
            pixels("camera { position <5003.2, 1364.6, -343.6> look_at <5005.4, 1365.3, -343.1> sky <0, 0, 1> fov 14 }"
                   "light { position <5001.6, 1360.5, -330> color <1, 1, 1> }" +
                       body + " translate <5004.934302364035, 1364.8925089996787, -343.14558009553747>" + glass,
                   1e7) == std::array{0, 0, 0});
    }
    // The eye is close to a wide thin box, whose middle is far: crossings are counted from there.
    CHECK(pixels("camera { position <-24.43, .0891, -9.92> look_at <-18.18, 0, -12.05> sky <0, 1, 0> fov 60 }"
                 "light { position <-165, 122, -59> color <1, 1, 1> }"
                 "box { <0, 0, 0>, <-36, 8.5e-9, -36> material { reflection 0 ambient .2 } }",
                 1e9) == std::array{0, 0, 0});
    // A ray that is in a body thinner than the rounding of where it starts.
    CHECK(pixels("camera { position <1.2, .65, -1.48> look_at <0, -.3, 0> sky <0, 0, 1> fov 20 }"
                 "light { position <2.6, 3.7, -8.6> color <1, 1, 1> }"
                 "cone { <.02265251371, -.13, -.38>, 1, <.022652513714, -.13, -.38>, 1 scale <1, 1, .13>" +
                     glass,
                 1e12) == std::array{0, 0, 0});
}
