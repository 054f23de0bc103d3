// Tests that bodies are moved, turned, scaled, copied and removed in a text, and that all else stays as it is.
#include "text/place_body.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "files/error.h"
#include "num/decimal.h"
#include "num/vec_math.h"
#include "tests/unit/scenes.h"
#include "tests/unit/text/random_texts.h"
#include "text/body_text.h"
#include "text/light_text.h"
#include "text/parse.h"
#include "text/parse_body.h"
#include "text/write.h"

using namespace strahl;

namespace {

const std::string camera_text = "camera { position <0,-9,2> look_at <0,0,0> up <0,0,-1> fov 20 }\n";

std::string placed(const std::string& text, int body, const Placing& placing, int decimals = 3) {
    const auto found = PlacedBody::find(text, parse_scene(text, "test"), body);
    REQUIRE(found);
    return found->text(placing, decimals);
}
/// Returns the text of a body after this.
std::string after(const std::string& body, const Placing& placing, int decimals = 3) {
    const std::string text = placed(camera_text + body, 0, placing, decimals);
    REQUIRE(text.starts_with(camera_text));
    parse_scene(text, "test");
    return text.substr(camera_text.size());
}

/// Returns the matrix of a placing; `axes` are those along which it scales.
glm::dmat4 matrix_of(const Placing& placing, const std::array<DVec3, 3>& axes) {
    const auto made = [](const auto& image, const DVec3& about) {
        glm::dmat4 m(1);
        for (int i = 0; i < 3; ++i) {
            DVec3 unit(0);
            unit[i] = 1;
            m[i] = glm::dvec4(image(unit), 0);
        }
        m[3] = glm::dvec4(about - image(about), 1);
        return m;
    };
    if (const auto* const move = std::get_if<MoveBy>(&placing)) {
        glm::dmat4 m(1);
        return m[3] = glm::dvec4(move->by, 1), m;
    }
    if (const auto* const turn = std::get_if<TurnBy>(&placing)) {
        const double angle = turn->degrees * M_PI / 180;
        return made(
            [&](const DVec3& v) {
                const DVec3 along = dot_product(v, turn->axis) * turn->axis, across = v - along;
                return along + std::cos(angle) * across + std::sin(angle) * cross_product(turn->axis, across);
            },
            turn->about);
    }
    const auto& scale = std::get<ScaleBy>(placing);
    return made(
        [&](const DVec3& v) {
            DVec3 image(0);
            for (int i = 0; i < 3; ++i) image += scale.factors[i] * dot_product(v, axes[i]) * axes[i];
            return image;
        },
        scale.about);
}

}  // namespace

TEST_CASE("a body without transformations gets other points and lengths, in place") {
    CHECK(after("sphere { <1, 2.50, 3> /* c */, 2 }", MoveBy{{.5, 0, -1}}) == "sphere { <1.5, 2.50, 2> /* c */, 2 }");
    CHECK(after("sphere { <1, 2, 3>, 2 }", ScaleBy{{1.5, 1.5, 1.5}, {1, 2, 3}}) == "sphere { <1, 2, 3>, 3 }");
    CHECK(after("cylinder { <0,0,0>, <0,0,2>, .5 }", MoveBy{{0, 1, 0}}) == "cylinder { <0,1,0>, <0,1,2>, .5 }");
    CHECK(after("torus { <0,0,1>, <0,0,1>, 2, .5 }", MoveBy{{0, 0, 2}}) == "torus { <0,0,3>, <0,0,1>, 2, .5 }");
    CHECK(after("box { <0,0,0>, <2,2,2> }", ScaleBy{{2, 1, 1}, {1, 1, 1}}) == "box { <-1,0,0>, <3,2,2> }");
    CHECK(after("plane { <0,0,0>, <1,0,0>, <0,1,0> }", MoveBy{{0, 0, -1}}) == "plane { <0,0,-1>, <1,0,-1>, <0,1,-1> }");
    CHECK(after("sphere { <1,2,3>, 2 }", MoveBy{{.123456, 0, 0}}, 2) == "sphere { <1.12,2,3>, 2 }");
    CHECK(after("sphere { <1234,2,3>, 2 }", MoveBy{{113, 0, 0}}, -2) == "sphere { <1300,2,3>, 2 }");
}

TEST_CASE("else transformations at the end of its block change, or are added there") {
    // A pattern moves with its body.
    CHECK(after("sphere { <0,0,0>, 2  material { rgb checker { <1,1,1>, <0,0,0> } } }", MoveBy{{1, 0, 0}}) ==
          "sphere { <0,0,0>, 2  material { rgb checker { <1,1,1>, <0,0,0> } }  translate <1, 0, 0> }");
    CHECK(after("union { sphere { <0,0,0>, 2 } box { <0,0,0>, <3,4,5> }}", MoveBy{{1, 0, 0}}) ==
          "union { sphere { <0,0,0>, 2 } box { <0,0,0>, <3,4,5> }  translate <1, 0, 0> }");
    CHECK(after("define ball sphere { <0,0,0>, 2 }\nball { }", MoveBy{{1, 0, 0}}) ==
          "define ball sphere { <0,0,0>, 2 }\nball { translate <1, 0, 0> }");
    CHECK(after("sphere { <0,0,0>, 2 translate <1, .20, 3> }", MoveBy{{1, 0, 0}}) ==
          "sphere { <0,0,0>, 2 translate <2, .20, 3> }");
    CHECK(after("sphere { <0,0,0>, 2 translate <1, 2, 3> rotate <0,0,90> }", MoveBy{{1, 0, 0}}) ==
          "sphere { <0,0,0>, 2 translate <1, 2, 3> rotate <0,0,90>  translate <1, 0, 0> }");
    CHECK(after("sphere {\n    <0,0,0>, 2\n    scale 2  // big\n}\n", MoveBy{{0, 0, 3}}) ==
          "sphere {\n    <0,0,0>, 2\n    scale 2  // big\n    translate <0, 0, 3>\n}\n");
    CHECK(after("box { <-1,-1,0>, <1,1,1> translate <3, 0, 0> }", TurnBy{{0, 0, 1}, 30, {3, 0, .5}}) ==
          "box { <-1,-1,0>, <1,1,1> rotate <0, 0, 30> translate <3, 0, 0> }");
    CHECK(after("box { <2,-1,0>, <4,1,1> rotate <0, 0, 10> }", TurnBy{{0, 0, 1}, -10, {0, 0, 0}}) ==
          "box { <2,-1,0>, <4,1,1> rotate <0, 0, 0> }");
    CHECK(after("sphere { <0,0,0>, 1 scale 2 translate <1,0,0> }", ScaleBy{{2, 1, 1}, {1, 0, 0}}) ==
          "sphere { <0,0,0>, 1 scale <4, 2, 2> translate <1,0,0> }");
    CHECK(after("sphere { <0,0,0>, 1 scale 2 translate <1,0,0> }", ScaleBy{DVec3(2), {1, 0, 0}}) ==
          "sphere { <0,0,0>, 1 scale 4 translate <1,0,0> }");
    // A number that follows a track, and what comes before, stay.
    CHECK(after("sphere { <0,0,0>, 1 translate <track \"x\",0,0> }", MoveBy{{0, 1, 0}}) ==
          "sphere { <0,0,0>, 1 translate <track \"x\",0,0>  translate <0, 1, 0> }");
}

TEST_CASE("bodies are where they were dragged, whatever came before") {
    std::mt19937 random(7);
    const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    const auto vector = [&](double reach) {
        return DVec3(uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach));
    };
    for (int run = 0; run < 400; ++run) {
        std::string text = camera_text + "union { sphere { <0,0,0>, 1 } box { <0,0,0>, <1,2,3> } ";
        for (int i = int(random() % 4); i > 0; --i) {
            const DVec3 v = vector(3);
            const char* const words[] = {"rotate ", "translate ", "scale "};
            const auto word = random() % 3;
            text += words[word] +
                    strahl::text_of(word == 0   ? 60. * v
                                    : word == 2 ? DVec3(.5 + std::abs(v.x), 1, 2)
                                                : v) +
                    " ";
        }
        if (run % 7 == 0) text += "rotate <12, 90, 34> ";
        text += "}\n";
        const Scene before = parse_scene(text, "test");
        const DVec3 axis = normalize(vector(1));
        const DVec3 factors(uniform(.5, 2), uniform(.5, 2), uniform(.5, 2));
        const Placing placings[] = {MoveBy{vector(5)}, TurnBy{axis, uniform(-170, 170), vector(4)},
                                    ScaleBy{factors, vector(4)}};
        const Placing& placing = placings[run % 3];
        const auto found = PlacedBody::find(text, before, 0);
        REQUIRE(found);
        const std::string changed = found->text(placing, 6);
        const Scene after = parse_scene(changed, "test");
        CAPTURE(text);
        CAPTURE(changed);
        const glm::dmat4 wanted = matrix_of(placing, found->axes()) * matrix(before.primitives[0].transformations);
        const glm::dmat4 got = matrix(after.primitives[0].transformations);
        double error = 0;
        // Degrees have two decimals, factors four.
        for (int i = 0; i < 4; ++i) error = std::max(error, length(DVec3(wanted[i]) - DVec3(got[i])));
        CHECK(error < 4e-3);
    }
}

TEST_CASE("a body that is read alone makes the scene that the whole text makes") {
    RandomScenes scenes(5);
    std::mt19937 random(3);
    int alone = 0, all = 0;
    for (int run = 0; run < 40; ++run) {
        const std::string text = "define red material { rgb <1, 0, 0> }\n" + write_scene(scenes.scene()) +
                                 "defaultmaterial { pow 7 }\nsphere { <0,0,0>, 1 }\n"
                                 "sphere { <0,0,9>, 1 material red }\n"
                                 "union { sphere { <0,0,0>, 1 } sphere { <1,0,0>, 1 material { pow 3 } } }\n";
        CAPTURE(text);
        try {
            const Scene scene = parse_scene(text, "test", {}, made_up_pixels);
            for (int body = 0; body < std::ssize(scene.primitives); ++body) {
                const BodyText now = body_text(text, scene, body, 0);
                // A number of its shape, its place or its material is another one.
                const BodyValue& value = now.values[random() % now.values.size()];
                if (!value.fixed.empty() || (value.slices.empty() && value.own_at == 0)) continue;
                std::vector<double> numbers = value.numbers;
                numbers[0] = std::clamp(numbers[0] / 2 + .25, value.range.low, value.range.high);
                const std::string changed =
                    value.slices.empty() ? with_own_value(text, value, numbers) : with_numbers(text, value, numbers);
                if (!value.source.empty() && value.source != no_source) continue;  // it stands in another block
                const std::string block =
                    changed.substr(now.block_begin, now.block_end + changed.size() - text.size() - now.block_begin);
                const auto read = with_body(scene, body, now.context, block, "test", made_up_pixels);
                ++all, alone += read.has_value();
                if (!read) continue;
                CAPTURE(block);
                CHECK(*read == parse_scene(changed, "test", {}, made_up_pixels));
            }
        } catch (const FileError&) {
            continue;  // invalid by chance
        }
    }
    CHECK(all > 100);
    CHECK(alone > all / 3);
}

TEST_CASE("a copy stands behind its body or light, and is removed without a trace") {
    const std::string text = camera_text +
                             "sphere { <0,0,0>, 1 }  // one\n  box { <0,0,0>,\n    <1,1,1>\n  }\n"
                             "light { position <1,2,3> color <1,1,1> } light { position <3,2,1> color <1,1,1> }\n";
    CHECK(with_copy(text, TopBlock::body, 0) ==
          camera_text + "sphere { <0,0,0>, 1 }  // one\nsphere { <0,0,0>, 1 }\n" + text.substr(text.find("  box")));
    CHECK(without_block(text, TopBlock::body, 0) == camera_text + text.substr(text.find("  box")));
    CHECK(without_block(text, TopBlock::body, 1) ==
          camera_text + "sphere { <0,0,0>, 1 }  // one\n" + text.substr(text.find("light")));
    CHECK(without_block(text, TopBlock::light, 1) == text.substr(0, text.rfind(" light")) + "\n");
    CHECK(with_copy(text, TopBlock::body, 2) == text);
    CHECK(without_block(text, TopBlock::light, 2) == text);

    RandomScenes scenes(11);
    for (int run = 0; run < 40; ++run) {
        const Scene scene = scenes.scene();
        const std::string whole = write_scene(scene);
        if (!is_valid(whole)) continue;
        for (int i = 0; i < std::ssize(scene.primitives); ++i) {
            const std::string copied = with_copy(whole, TopBlock::body, i);
            const Scene with = parse_scene(copied, "test", {}, made_up_pixels);
            REQUIRE(with.primitives.size() == scene.primitives.size() + 1);
            CHECK(with.primitives[std::size_t(i)] == with.primitives[std::size_t(i + 1)]);
            CHECK(without_block(copied, TopBlock::body, i + 1) == whole);
        }
        for (int i = 0; i < std::ssize(scene.lights); ++i) {
            const std::string copied = with_copy(whole, TopBlock::light, i);
            CHECK(parse_scene(copied, "test", {}, made_up_pixels).lights.size() == scene.lights.size() + 1);
            CHECK(without_block(copied, TopBlock::light, i) == whole);
        }
    }
}

TEST_CASE("the values of a light stand where its text has them") {
    const std::string text = camera_text +
                             "light { position <1, 2, 3> color <1, .5, .2>\n"
                             "  spot { look_at <0, 0, 1> radius 20 } }\n"
                             "light { direction <0, 0, -1> color <1, 1, 1> }\n";
    const Scene scene = parse_scene(text, "test");
    const BodyText spot = light_text(text, scene, 0);
    CHECK(spot.kind == "spotlight");
    CHECK(spot.line == 2);
    const auto value = [&](const char* name) {
        const auto found = std::ranges::find(spot.values, name, &BodyValue::name);
        REQUIRE(found != spot.values.end());
        return *found;
    };
    const double target[] = {0, 5, 1}, distance[] = {7};
    CHECK(with_numbers(text, value(spot_target), target).find("look_at <0, 5, 1>") != text.npos);
    CHECK(value("color").color);
    CHECK(value("falloff of spot").numbers[0] == 45);
    const std::string fading = with_own_value(text, value("fade_distance"), distance);
    CHECK(parse_scene(fading, "test").lights[0].fade_distance == 7);
    const BodyText parallel = light_text(text, scene, 1);
    CHECK(parallel.kind == "parallel light");
    CHECK(parallel.line == 4);
    for (const BodyValue& other : parallel.values) CHECK(other.name != "position");
    CHECK(light_text("", scene, 0).values[0].numbers == std::vector<double>{1, 2, 3});
}
