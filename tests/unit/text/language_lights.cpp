// The scene language: lights and fog.
#include "tests/unit/text/language.h"

using namespace strahl;
using namespace strahl::language;

namespace {

Light light(const std::string& text) { return with_eye("light { color <1,1,1> " + text + " }").lights.at(0); }
/// Checks the message about a light, whose parameters from `text` on stand in line 3.
void check_light(const std::string& text, const std::string& place, const std::string& message) {
    check_fault("light { color <1,1,1>\n" + text + " }", place + ": " + message);
}

}  // namespace

TEST_CASE("points, spots and parallel light") {
    CHECK(light("position <1,2,3>") == Light{{1, 2, 3}, Color(1)});
    CHECK(light("direction <0,0,-2>") == Light{{0, 0, 0}, Color(1), DVec3(0, 0, -2)});
    CHECK(light("position <1,2,3> spot { look_at <0,0,0> }") ==
          Light{{1, 2, 3}, Color(1), {}, Spot{{0, 0, 0}, 30, 45, 0}});
    CHECK(light("spot { tightness 3 radius 20 falloff 20 look_at <0,0,0> } position <1,2,3>") ==
          Light{{1, 2, 3}, Color(1), {}, Spot{{0, 0, 0}, 20, 20, 3}});
    CHECK(light("position <1,2,3> group 2.5").group == 2.5);
    CHECK(with_eye("light { position <1,2,3> color <-1,0,1> }").lights.at(0).color == Color(-1, 0, 1));
}

TEST_CASE("rectangles and grids") {
    CHECK(light("position <1,2,3> edges <2,0,0> <0,0,1>") ==
          Light{{1, 2, 3}, Color(1), {}, {}, Area{{2, 0, 0}, {0, 0, 1}}});
    const Light grid = light("edges <2,0,0>, <0,0,1> grid 3, 1 position <1,2,3>");
    CHECK(grid == Light{{1, 2, 3}, Color(1), {}, {}, Area{{2, 0, 0}, {0, 0, 1}, 3, 1}});
    CHECK(points_of(std::vector{grid}) ==
          std::vector<Light>{{{0, 2, 3}, Color(1. / 3)}, {{1, 2, 3}, Color(1. / 3)}, {{2, 2, 3}, Color(1. / 3)}});
    check_light("position <1,2,3> edges <2,0,0>, <1,1,0>", "3:18", "invalid edges: they are not perpendicular");
    check_light("position <1,2,3> edges <2,0,0>, <0,0,0>", "3:18", "invalid edges: one has no length");
    CHECK(light("position <1,2,3> edges <2,0,0>, <1,1,0> grid 3, 2").area == Area{{2, 0, 0}, {1, 1, 0}, 3, 2});
    check_light("position <1,2,3> edges <2,0,0>, <-1,0,0> grid 3, 2", "3:18", "invalid edges: they are parallel");
    check_light("position <1,2,3> grid 2, 2", "3:18", "a grid of points needs 'edges'");
    check_light("position <1,2,3> edges <2,0,0>, <0,1,0> grid 65, 2", "3:46",
                "'grid' of 'light' must be a whole number from 1 to 64, not '65'");
    check_light("direction <0,0,1> edges <2,0,0>, <0,1,0>", "3:19",
                "parallel light cannot be a rectangle; give it a 'position'");
    check_light("position <1,2,3> edges <2,0,0>, <0,1,0> spot { look_at <0,0,0> }", "3:41",
                "a light with 'edges' cannot have a spot unless it is 'soft': it shines in all directions");
    const Light soft = light("position <1,2,3> edges <2,0,0>, <0,0,1> grid 3, 2 soft adaptive 1 circular orient");
    CHECK((soft.soft && soft.area->columns == 3 && soft.adaptive == 1 && soft.circular && soft.orient));
    CHECK(points_of(soft) == 1);
    CHECK(light("position <1,2,3> edges <2,0,0>, <0,0,1> grid 3, 1 soft jitter").jitter);
    check_light("position <1,2,3> edges <2,0,0>, <0,1,0> soft jitter", "3:46",
                "'jitter' is for soft lights with a 'grid'");
    check_light("position <1,2,3> edges <2,0,0>, <0,1,0> soft adaptive 1", "3:46",
                "'adaptive' is for soft lights with a 'grid'");
    check_light("position <1,2,3> edges <2,0,0>, <0,1,0> grid 2, 2 orient", "3:51",
                "'orient' is for soft lights with a 'grid'");
    check_light("position <1,2,3> edges <2,0,0>, <0,1,0> grid 2, 1 soft circular", "3:56",
                "this needs a grid of at least 2 by 2 points");
    check_light("position <1,2,3> edges <2,0,0>, <0,1,0> grid 2, 2 soft adaptive 1.5", "3:65",
                "'adaptive' of 'light' must be a whole number from 0 to 100, not '1.5'");
    check_light("position <1,2,3> soft", "2:1", "a soft light needs 'edges'");
}

TEST_CASE("fog") {
    CHECK(with_eye("fog { color <.1,.2,.3> distance 7 }").fog == Fog{7, {.1, .2, .3}});
    CHECK(!with_eye("").fog);
    CHECK(with_eye("fog { distance 7 color <.1,.2,.3> altitude 2 offset -1 up <0,1,0> filter .5 transmit .25 }").fog ==
          Fog{7, {.1, .2, .3}, 2, -1, {0, 1, 0}, .5, .25});
    check_fault("fog { color <1,1,1> }", "2:1: 'fog' lacks 'distance'");
    check_fault("fog { color <1,1,1> distance 0 }",
                "2:30: 'distance' of 'fog' must be greater than 0 and at most 1e9, not '0'");
    check_fault("fog { color <1,1,1> distance 1 }\nfog { color <1,1,1> distance 1 }",
                "3:1: a second 'fog'; the first is in line 2");
}

TEST_CASE("mistakes in lights") {
    const Light beam = light("direction <0,0,1> from <1,2,3> beam 2 core 1 tightness 3");
    CHECK((beam.beam == 2 && beam.core == 1 && beam.tightness == 3));
    check_light("direction <0,0,1> beam 2", "3:19", "only parallel light has a beam; give it a 'direction' and 'from'");
    check_light("direction <0,0,1> from <1,2,3> core 2", "3:32", "this is for parallel light with a 'beam'");
    check_light("direction <0,0,1> from <1,2,3> beam 0", "3:37",
                "'beam' of 'light' must be greater than 0 and at most 1e9, not '0'");
    CHECK(light("direction <0,0,1> from <1,2,3>").from == DVec3(1, 2, 3));
    check_light("position <1,2,3> from <1,2,3>", "3:18", "only parallel light has 'from'; give it a 'direction'");
    check_fault("light { color <1,1,1> }", "2:1: 'light' lacks 'position' (or 'direction')");
    check_light("position <1,2,3> direction <0,0,1>", "3:18",
                "'direction' repeats 'position' of line 3; give only one of them");
    check_light("direction <0,0,0>", "3:1", "invalid light: its 'direction' is 0");
    check_light("direction <0,0,1> spot { look_at <0,0,0> }", "3:19",
                "parallel light cannot have a spot; give it a 'position'");
    check_light("position <1,2,3> spot { look_at <1,2,3> }", "3:18",
                "invalid spot: 'look_at' is the light's own position");
    check_light("position <1,2,3> spot { }", "3:18", "'spot' lacks 'look_at'");
    check_light("position <1,2,3> spot { look_at <0,0,0> falloff 20 }", "3:18",
                "invalid spot: its falloff, 20, is below its radius, 30");
    check_light("position <1,2,3> spot { look_at <0,0,0> falloff 91 }", "3:49",
                "'falloff' of 'spot' must be from 0 to 90 degrees, not '91'");
    check_light("position <1,2,3> spot { look_at <0,0,0> } spot { look_at <0,0,0> }", "3:43",
                "a second 'spot'; the first is in line 3");
    check_light("position <1,2,3> spotlight { look_at <0,0,0> }", "3:18",
                "unknown word 'spotlight' in 'light'; did you mean 'spot'?");
}
