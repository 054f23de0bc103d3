// The scene language: patterns in place of colours.
#include "num/vec_math.h"
#include "tests/unit/text/language.h"
#include "text/blocks/pigment.h"
#include "text/write.h"

using namespace strahl;
using namespace strahl::language;

namespace {

Pigment pigment(const std::string& text) {
    return parse(eye + "sphere { <0,0,0>, 1 material { rgb " + text + " } }").materials[0].rgb;
}
/// Checks the message about a pattern; column 1 is the pattern's first character.
void check_pattern(const std::string& text, const std::string& where, const std::string& message) {
    check_fault("sphere{<0,0,0>,1 material{rgb\n" + text + "} }", where + ": " + message);
}

}  // namespace

TEST_CASE("patterns and their defaults") {
    const Pigment chequered = pigment("checker { <1,.5,0>, <.1,.2,.3> scale 2 rotate <0,0,45> }");
    REQUIRE(chequered.pattern);
    CHECK(chequered.color == Color(1, .5, .3));  // the largest of each channel
    CHECK(*chequered.pattern ==
          Pattern{Checker{}, {{0, {1, .5, 0}}, {1, {.1, .2, .3}}}, {Scale{DVec3(2)}, Rotate{{0, 0, 45}}}});
    CHECK(*pigment("brick { <1,1,1> <0,0,0> mortar .2 brick_size <4,2,2> }").pattern ==
          Pattern{Brick{{4, 2, 2}, .2}, {{0, Color(1)}, {1, Color(0)}}, {}});
    CHECK(*pigment("gradient { colors { 0 <1,1,1>, 1 <0,0,0> } axis <0,0,2> }").pattern ==
          Pattern{Gradient{{0, 0, 2}}, {{0, Color(1)}, {1, Color(0)}}, {}});
    Marble marble;
    marble.turbulence = .6, marble.octaves = 5;
    CHECK(*pigment("marble { turbulence .6 octaves 5 colors { .2 <1,1,1> .2 <0,0,0> } }").pattern ==
          Pattern{marble, {{.2, Color(1)}, {.2, Color(0)}}, {}});
    CHECK(std::get<Noise>(pigment("noise { colors { 0 <1,1,1> } }").pattern->kind).octaves == 1);
    CHECK(pigment("wood { colors { 0 <1,1,1> } }") ==
          pigment("wood { octaves 6 omega .5 lambda 2 colors { 0 <1,1,1> } }"));
}

TEST_CASE("images that are opaque only in places") {
    // A leaf of red with an alpha channel of .25, 1, 0, .5 by rows, and a grey one without.
    const auto files = [](const std::string& path) {
        FilePixels pixels(Pixels{2, 2, false, std::vector<float>(12, .5f), Color(.5)});
        if (path == "leaf.png") pixels.opacity = {.25f, 1, 0, .5f};
        return pixels;
    };
    const auto rgb = [&](const std::string& image) {
        return parse_scene(eye + "sphere { <0,0,0>, 1 material { rgb " + image + " } }\n", "x.rt", {}, files)
            .materials[0]
            .rgb;
    };
    const auto check = [&](const std::string& image, const DVec3& at, double opaque) {
        CAPTURE(image);
        const Pigment own = rgb(image);
        REQUIRE(own.pattern);
        CHECK(own.clear());
        const DVec3 there = transform_point(glm::inverse(matrix(own.pattern->transformations)), at);
        CHECK(value_at(std::get<SolidPattern>(own.pattern->kind), there) == doctest::Approx(opaque));
        // The pigment that is read from its own text is the same, and so is the text of that.
        const Pigment again = rgb(text_of(own));
        CHECK(text_of(again) == text_of(own));
        CHECK(value_at(std::get<SolidPattern>(again.pattern->kind), there) == doctest::Approx(opaque));
        CHECK(again.pattern->transformations == own.pattern->transformations);
        CHECK(*again.pattern->colors[1].pattern == *own.pattern->colors[1].pattern);
    };
    const std::string leaf = "image { \"leaf.png\" ";
    check(leaf + "opacity 1 }", {.25, .75, 0}, .25);
    check(leaf + "opacity 1 }", {.75, .75, 9}, 1);
    check(leaf + "opacity .5 }", {.75, .75, 0}, .5);
    check(leaf + "mask .5 }", {.75, .25, 0}, 1);
    check(leaf + "mask .6 }", {.75, .25, 0}, 0);
    check(leaf + "opacity .5 mask .6 }", {.75, .75, 0}, 0);
    check(leaf + "opacity 1 scale 2 translate <1,0,0> sharp }", {1.5, 1.5, 0}, .25);
    check(leaf + "opacity 1 }", {1.25, -.25, 0}, .25);
    check(leaf + "opacity 1 once <1,1,1> }", {1.25, .25, 0}, 1);
    check(leaf + "opacity 1 wrap clamp }", {-.25, 3, 0}, .25);
    check(leaf + "opacity 1 wrap mirror }", {1.75, -.75, 0}, .25);
    check(leaf + "opacity 1 wrap mirror repeat }", {1.75, -.25, 0}, .25);
    check("image { \"grey.png\" opacity_of \"leaf.png\" }", {.25, .25, 0}, 0);
    check(leaf + "opacity_of \"grey.png\" opacity .5 }", {.75, .75, 0}, .25);
    const auto fault = [&](const std::string& image, const char* said) {
        CHECK_THROWS_WITH_AS(rgb(image), doctest::Contains(said), FileError);
    };
    fault(leaf + "}", "2:45: 'leaf.png' has pixels that are not opaque, the first at column 0, row 0; 'opacity 1'");
    fault(leaf + "opacity 2 }", "'opacity' of 'image' must be from 0 to 1, not '2'");
    fault(leaf + "opacity 1 opacity 1 }", "a second 'opacity'");
    fault(leaf + "mask .5 map spherical }", "2:55: only the maps planar and uv show places that are not opaque");
    fault("checker { " + leaf + "opacity 1 }, <1,1,1> }", "a picture among colours must be opaque");
    fault("checker { " + leaf + "}, <1,1,1> }", "not opaque");
    CHECK_THROWS_WITH_AS(
        parse_scene(eye + "sphere { <0,0,0>, 1 material { bump " + leaf + "opacity 1 } } }", "x.rt", {}, files),
        doctest::Contains("unknown word 'opacity' in 'image'"), FileError);
}

TEST_CASE("images, and what can be wrong with them") {
    int read = 0;
    const auto grey = [&](const std::string& path) {
        if (path != "folder/wood.png") throw FileError("no '" + path + "'");
        ++read;
        return Pixels{2, 1, false, {.2f, .2f, .2f, .6f, .6f, .6f}, Color(.6f)};
    };
    const auto sphere = [](const std::string& image) {
        return "sphere { <0,0,0>, 1 material { rgb " + image + " } }\n";
    };
    const auto scene = [&](const std::string& text) { return parse_scene(eye + text, "folder/x.rt", {}, grey); };
    const Scene two = scene(sphere("image { \"wood.png\" }") +
                            sphere("image { \"wood.png\" once <0,1,0> map cylindrical sharp rotate <90,0,0> }"));
    CHECK(read == 1);
    const Pigment plain = two.materials[0].rgb, changed = two.materials[1].rgb;
    CHECK(plain.color == Color(.6f));
    CHECK(changed.color == Color(.6f, 1, .6f));
    const auto& image = std::get<ImagePattern>(plain.pattern->kind);
    CHECK(image.map == ImageMap::planar);
    CHECK(!image.once);
    CHECK(*changed.pattern ==
          Pattern{ImagePattern{"wood.png", image.pixels, ImageMap::cylindrical, Color(0, 1, 0), true},
                  {},
                  {Rotate{{90, 0, 0}}}});
    CHECK(plain != changed);
    const auto check = [&](const std::string& text, const std::string& said) {
        CHECK_THROWS_WITH_AS(scene(sphere(text)), doctest::Contains(said.c_str()), FileError);
    };
    check("image { \"steel.png\" }", "2:45: no 'folder/steel.png'\n");
    check("image { map planar }", "the name of a picture");
    check("image { \"wood.png\" map round }", "2:59: unknown word 'round' after 'map'; known here: planar, spherical");
    check("image { \"wood.png\" map 3 }", "2:59: a word such as 'uv' expected after 'map'");
    check("image { \"wood.png\" map planar map planar }", "2:66: a second 'map'; the first is in line 2");
    check("image { \"wood.png\" once <1,1,1> once <1,1,1> }", "2:68: a second 'once'");
    check("image { \"wood.png\" sharp sharp }", "a second 'sharp'");
    check("image { \"wood.png\" once <1,1,-1> }", "'once' of 'image' must be from 0 to 1e9, not '-1'");
    check("image { \"wood.png\" colors { 0 <1,1,1> } }",
          "unknown word 'colors' in 'image'; known here: opacity, mask, opacity_of, map, once, wrap, sharp, rotate");
    const auto wrap = [&](const std::string& words) {
        const Pigment own = scene(sphere("image { \"wood.png\" " + words + " }")).materials[0].rgb;
        CHECK(scene(sphere(text_of(own))).materials[0].rgb == own);
        return std::get<ImagePattern>(own.pattern->kind).wrap;
    };
    using enum ImageWrap;
    CHECK(wrap("") == std::array{repeat, repeat});
    CHECK(wrap("wrap clamp sharp") == std::array{clamp, clamp});
    CHECK(wrap("wrap mirror repeat scale 2") == std::array{mirror, repeat});
    check("image { \"wood.png\" wrap round }", "unknown word 'round' after 'wrap'; known here: repeat, clamp, mirror");
    check("image { \"wood.png\" wrap 3 }", "a word such as 'clamp' expected after 'wrap'");
    check("image { \"wood.png\" wrap clamp wrap clamp }", "a second 'wrap'");
    check_fault(sphere("image { \"wood.png\" }"), "2:45: cannot read 'wood.png': pictures are not read here");
}

TEST_CASE("images by uv") {
    const auto scene = [](const std::string& text) {
        return parse_scene(eye + text, "x.rt", {}, [](const std::string&) { return Pixels{1, 1, false, {0, 0, 0}}; });
    };
    const std::string uv = "material { rgb image { \"a\" map uv } }";
    const std::string first = "triangle { <0,0,0>, <1,0,0>, <0,1,0>", second = "triangle { <0,0,1>, <1,0,0>, <0,1,0>";
    const Scene one = scene("mesh { " + first + " } " + second + " uv_vectors <0,.5>, <1,0> <0,0> } " + uv + " }");
    const MeshData& mesh = *std::get<Mesh>(one.primitives[0].shape).data;
    const MeshData::Corners* const numbers = mesh.place_numbers();
    REQUIRE(numbers);
    const auto place = [&](int i, int k) { return mesh.places[numbers[i][k]]; };
    for (int k = 0; k < 3; ++k) CHECK(place(0, k) == MeshData::Place{0, 0});
    CHECK(place(1, 0) == MeshData::Place{0, .5});
    CHECK(place(1, 1) == MeshData::Place{1, 0});
    CHECK(parse_scene(write_scene(one), "x.rt", {}, [](const std::string&) {
              return Pixels{1, 1, false, {0, 0, 0}};
          }) == one);
    CHECK(scene("mesh { " + first + " uv_vectors <0,0>, <1,0>, <0,1> } }") !=
          scene("mesh { " + first + " uv_vectors <0,0>, <1,0>, <0,2> } }"));
    const auto fault = [&](const std::string& text, const std::string& said) {
        CHECK_THROWS_WITH_AS(scene(text), doctest::Contains(said.c_str()), FileError);
    };
    fault("sphere { <0,0,0>, 1 " + uv + " }",
          "2:1: invalid sphere: its pattern is mapped by uv, which only meshes have\n");
    fault("define m material { rgb image { \"a\" map uv } }\nunion { sphere { <0,0,0>, 1 } material m }",
          "3:1: invalid union: its pattern is mapped by uv, which only meshes have\n");
    fault("mesh { " + first + " } " + uv + " }",
          "2:1: invalid mesh: its pattern is mapped by uv, and no triangle has 'uv_vectors'\n");
    fault("background { color image { \"a\" map uv } }", "2:1: invalid background");
    fault(first + " uv_vectors <0,0>, <1,0>, <0,1> }", "unknown word 'uv_vectors' in 'triangle'");
    fault("mesh { " + first + " uv_vectors <0,0>, <1,0,0>, <0,1> } }", "2:67: '>' expected after the two numbers");
    fault("mesh { " + first + " uv_vectors <0,0> <1,1> } }",
          "two numbers <u, v> expected for 'uv_vectors' of 'triangle', but found '}'");
    fault("mesh { " + first + " uv_vectors <0,0> <1,1> <0,1> uv_vectors <0,0> <1,1> <0,1> } }",
          "a second 'uv_vectors'");
}

TEST_CASE("bumps, and what can be wrong with them") {
    const auto bump = [](const std::string& text) {
        return parse(eye + "sphere { <0,0,0>, 1 material { bump " + text + " } }").materials[0].bump;
    };
    const Bump noise = bump("noise { height .3 octaves 2 scale .2 }");
    Noise kind;
    kind.octaves = 2;
    CHECK(noise.height == .3);
    CHECK(*noise.pattern == Pattern{kind, {}, {Scale{DVec3(.2)}}});
    CHECK(bump("none") == Bump{});
    CHECK(!parse(eye + "sphere { <0,0,0>, 1 }").materials[0].patterned());
    const Scene scene = parse(eye +
                              "defaultmaterial { bump wood { height 1 } }\nsphere { <0,0,0>, 1 }\n"
                              "sphere { <0,0,0>, 2 material { bump none } }\n"
                              "sphere { <0,0,0>, 3 material { bump wood { height 2 } } }\n");
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[0].patterned());
    CHECK(scene.materials[1].bump == Bump{});
    CHECK(scene.materials[2].bump != scene.materials[0].bump);
    const auto check = [](const std::string& text, const std::string& where, const std::string& message) {
        check_fault("sphere{<0,0,0>,1 material{bump\n" + text + "} }", where + ": " + message);
    };
    check("noise { }", "3:1", "'noise' lacks 'height'");
    check("nois { height 1 }", "3:1", "unknown word 'nois' for 'bump' of 'material'; did you mean 'noise'?");
    check("checker { height 1 }", "3:1",
          "unknown word 'checker' for 'bump' of 'material'; known here: gradient, noise, marble, wood, image, solid, "
          "none");
    check("<1,1,1>", "3:1", "a pattern or 'none' expected for 'bump' of 'material', but found '<'");
    check("noise { height 1 height 1 }", "3:18", "a second 'height'; the first is in line 3");
    check("noise { height -1 }", "3:16", "'height' of 'noise' must be from 0 to 1e9, not '-1'");
    check(
        "noise { height 1 colors { 0 <1,1,1> } }", "3:18",
        "unknown word 'colors' in 'noise'; known here: octaves, omega, lambda, height, map, rotate, translate, scale");
    check("gradient { height 1 axis <0,0,0> }", "3:1", "invalid gradient: its axis has no direction");
    check("noise { height 1 scale 0 }", "3:24",
          "'scale' of 'noise' is 0, which would leave nothing of it; 1 changes nothing");
}

TEST_CASE("bumps by images") {
    const auto grey = [](const std::string& path) {
        if (path != "relief.png") throw FileError("no '" + path + "'");
        return Pixels{4, 2, false, std::vector<float>(24, .5f), Color(.5)};
    };
    const auto scene = [&](const std::string& image) {
        return parse_scene(eye + "sphere { <0,0,0>, 1 material { bump image { " + image + " } } }\n", "x.rt", {}, grey);
    };
    const Scene one = scene("\"relief.png\" height .1 map spherical scale 2");
    const Bump bump = one.materials[0].bump;
    const auto& image = std::get<ImagePattern>(bump.pattern->kind);
    CHECK(bump.height == .1);
    CHECK(bump.step() == .25);
    CHECK(image.map == ImageMap::spherical);
    CHECK(parse_scene(write_scene(one), "x.rt", {}, grey) == one);
    const Scene round = scene("\"relief.png\" once <1,0,0> height .1");
    CHECK(parse_scene(write_scene(round), "x.rt", {}, grey) == round);
    const auto fault = [&](const std::string& text, const std::string& said) {
        CHECK_THROWS_WITH_AS(scene(text), doctest::Contains(said.c_str()), FileError);
    };
    fault("\"steel.png\" height 1", "2:46: no 'steel.png'\n");
    fault("\"relief.png\"", "'image' lacks 'height'");
    fault("height 1", "the name of a picture");
    fault("\"relief.png\" height 1 map uv", "2:1: invalid sphere: its pattern is mapped by uv");
}

TEST_CASE("normal maps, and what can be wrong with them") {
    const auto tilted = [](const std::string& path) {
        if (path != "normals.png") throw FileError("no '" + path + "'");
        return Pixels{1, 1, false, {.6f, .5f, .9f}, Color(.6, .5, .9)};
    };
    const auto scene = [&](const std::string& material, const std::string& more = "") {
        return parse_scene(eye + more + "sphere { <0,0,0>, 1 material { " + material + " } }\n", "x.rt", {}, tilted);
    };
    const Scene one = scene("normal image { \"normals.png\" }");
    CHECK(one.materials[0].normal.height == 1);
    CHECK(one.materials[0].bends());
    CHECK(write_scene(one).find("normal image { \"normals.png\" }") != std::string::npos);
    const Scene both = scene(
        "normal image { \"normals.png\" once <.5,.5,1> height .5 map cylindrical rotate <90,0,0> }  "
        "bump wood { height .2 }");
    CHECK(both.materials[0].normal.height == .5);
    CHECK(both.materials[0].bump.height == .2);
    for (const Scene& own : {one, both}) CHECK(parse_scene(write_scene(own), "x.rt", {}, tilted) == own);
    const std::string others = "defaultmaterial { normal image { \"normals.png\" } }\n";
    CHECK(scene("normal none", others).materials[0] == Material{});
    CHECK(scene("pow 3", others).materials[0].normal == one.materials[0].normal);
    const auto fault = [&](const std::string& text, const std::string& said) {
        CHECK_THROWS_WITH_AS(scene(text), doctest::Contains(said.c_str()), FileError);
    };
    fault("normal noise { height 1 }",
          "2:39: unknown word 'noise' for 'normal' of 'material'; known here: image, none");
    fault("normal <0,0,1>", "2:39: a pattern or 'none' expected for 'normal' of 'material', but found '<'");
    fault("normal image { \"steel.png\" }", "2:48: no 'steel.png'");
    fault("normal image { \"normals.png\" height -1 }", "'height' of 'image' must be from 0 to 1e9, not '-1'");
    fault("normal image { \"normals.png\" map uv }", "2:1: invalid sphere: its pattern is mapped by uv");
    fault("normal image { \"normals.png\" } normal none", "a second 'normal'");
}

TEST_CASE("every pattern can be mapped by uv, which only meshes have") {
    const auto any = [](const std::string&) { return Pixels{1, 1, false, {0, 0, 0}}; };
    const auto scene = [&](const std::string& material, const std::string& places) {
        return parse_scene(
            eye + "mesh { triangle { <0,0,0>, <1,0,0>, <0,1,0> " + places + " } material { " + material + " } }",
            "x.rt", {}, any);
    };
    for (const std::string material :
         {"rgb checker { <0,1,0>, <1,0,0> map uv }", "rgb noise { map uv colors { 0 <0,1,0> } octaves 2 }",
          "bump marble { height 1 map uv scale 2 }", "normal image { \"n\" map uv once <1,1,1> height 2 }",
          "bump image { \"n\" map uv height 2 }", "rgb image { \"n\" once <1,1,1> map uv rotate <0,0,30> }"}) {
        CAPTURE(material);
        const Scene own = scene(material, "uv_vectors <0,0>, <1,0>, <0,1>");
        CHECK(own.materials[0].by_uv());
        CHECK(parse_scene(write_scene(own), "x.rt", {}, any) == own);
        CHECK_THROWS_WITH_AS(scene(material, ""),
                             doctest::Contains("2:1: invalid mesh: its pattern is mapped by "
                                               "uv, and no triangle has 'uv_vectors'"),
                             FileError);
    }
    check_pattern("brick { <1,1,1> <0,0,0> mortar -.2 }", "3:32",
                  "'mortar' of 'brick' must be from 0 to 1e9, not '-.2'");
    check_pattern("checker { <1,1,1>, <0,0,0> map planar }", "3:32",
                  "unknown word 'planar' after 'map'; known here: uv");
}

TEST_CASE("a material block changes a colour to a pattern and back") {
    const Scene scene = parse(eye +
                              "defaultmaterial { rgb checker { <1,1,1>, <0,0,0> } }\nsphere { <0,0,0>, 1 }\n"
                              "sphere { <0,0,0>, 2 material { rgb <1,0,0> } }\n"
                              "sphere { <0,0,0>, 3 material { pow 3 } }\n");
    REQUIRE(scene.materials.size() == 3);
    CHECK(scene.materials[0].rgb.pattern);
    CHECK(!scene.materials[1].rgb.pattern);
    CHECK(scene.materials[2].rgb == scene.materials[0].rgb);
}

TEST_CASE("patterns among the colours of others") {
    const std::string rings = "wood { colors { 0 <0,0,0> 1 <1,.5,0> } scale 2 }";
    const Pigment nested = pigment("checker { <.2,.3,.4>, " + rings + " }");
    CHECK(nested.color == Color(1, .5, .4));
    REQUIRE(nested.pattern->colors[1].pattern);
    CHECK(*nested.pattern->colors[1].pattern == *pigment(rings).pattern);
    CHECK(pigment("noise { colors { 0 <1,1,1,.5,.25> .3 " + rings + " } }").transmit == .25);
    CHECK(text_of(nested) == "checker { <0.2, 0.3, 0.4>, wood { colors { 0 <0, 0, 0>  1 <1, 0.5, 0> }  scale 2 } }");
    std::string deep = "<0,0,0>";
    for (int i = 0; i < 5; ++i) deep = "noise { colors { 0 " + deep + " } }";
    CHECK(pigment(deep).pattern->nests());
    check_pattern("noise { colors { 0 " + deep + " } }", "3:96", "patterns in patterns are at most 4 deep");
    check_pattern("noise { colors { 0 noise { colors { 0 <0,0,0> } map uv } } }", "3:20",
                  "a pattern among colours cannot be mapped by uv");
    check_pattern("noise { colors { 0 noise { colors { 0 <0,0,0> } } } map uv }", "3:1",
                  "a pattern that is mapped by uv cannot have patterns among its colours");
    const Scene sky = parse(eye + "background { coat <1,0,0,.5,.25> color <0,0,1> coat " + rings + " }");
    REQUIRE(sky.background_coats.size() == 2);
    CHECK(sky.background_coats[0].filter == .5);
    CHECK(sky.background_coats[1] == pigment(rings));
    CHECK(faults(eye + "background { coat <1,0,0> }").at(0).ends_with("'background' lacks 'color'"));
}

TEST_CASE("mistakes in patterns") {
    check_pattern("cheker { <1,1,1>, <0,0,0> }", "3:1",
                  "unknown word 'cheker' for 'rgb' of 'material'; did you mean 'checker'?");
    check_pattern("checker <1,1,1>", "3:9", "'{' expected after 'checker', but found '<'");
    check_pattern("5", "3:1", "a vector <x, y, z> or a pattern expected for 'rgb' of 'material', but found '5'");
    check_pattern("checker { <1,1,1> }", "3:19",
                  "a vector <x, y, z> expected for 'second colour' of 'checker', but found '}'");
    check_pattern("checker { <1,1,1>, <0,-1,0> }", "3:23",
                  "'second colour' of 'checker' must be from 0 to 1e9, not '-1'");
    check_pattern("checker { <1,1,1>, <0,0,0> colors { 0 <1,1,1> } }", "3:28",
                  "unknown word 'colors' in 'checker'; known here: map, rotate, translate, scale");
    check_pattern("marble { }", "3:1", "'marble' lacks 'colors'");
    check_pattern("marble { colors { } }", "3:10", "'colors' has no stops; a stop is, for example, '0 <1, 1, 1>'");
    check_pattern("marble { colors { 0 <1,1,1> .5 <0,0,0> .4 <1,1,1> } }", "3:40",
                  "stops must not fall: the one before is at 0.5");
    check_pattern("marble { colors { 0 <1,1,1> 1.5 <0,0,0> } }", "3:29",
                  "'stop' of 'colors' must be from 0 to 1, not '1.5'");
    check_pattern("marble { colors { 0 <1,1,1> <0,0,0> } }", "3:29",
                  "a number expected for 'stop' of 'colors', but found '<'");
    check_pattern("marble { colors { 0 <1,1,1> 1 } }", "3:31",
                  "a vector <x, y, z> expected for 'colour' of 'colors', but found '}'");
    check_pattern("marble { colors { 0 <1,1,1> } colors { 0 <1,1,1> } }", "3:31",
                  "a second 'colors'; the first is in line 3");
    check_pattern("marble { octaves 2.5 colors { 0 <1,1,1> } }", "3:18",
                  "'octaves' of 'marble' must be a whole number from 1 to 10, not '2.5'");
    check_pattern("wood { turbulance 1 colors { 0 <1,1,1> } }", "3:8",
                  "unknown word 'turbulance' in 'wood'; did you mean 'turbulence'?");
    check_pattern("gradient { axis <0,0,0> colors { 0 <1,1,1> } }", "3:1",
                  "invalid gradient: its axis has no direction");
    check_pattern("noise { colors { 0 <1,1,1> } scale 0 }", "3:36",
                  "'scale' of 'noise' is 0, which would leave nothing of it; 1 changes nothing");
    check_pattern("noise { colors { 0 <1,1,1> } translate <1e9,0,0> scale 2 }", "3:50",
                  "invalid noise: the transformations up to here make it too large, too small or too far away "
                  "(coordinates go up to 1e9)");
    check_pattern("noise { colors { 0 <1,1,1> } scale <1,1,1e-13> }", "3:30",
                  "invalid noise: the transformations up to here flatten it: one side shrinks more than 1e12 times as "
                  "much as another");
    std::string many = "noise { colors {";
    for (int i = 0; i < 257; ++i) many += " 0 <1,1,1>";
    check_pattern(many + " } }", "3:2578", "more than 256 stops");
    check_fault("light { position <0,0,0> color checker { <1,1,1>, <0,0,0> } }",
                "2:32: a vector <x, y, z> expected for 'color' of 'light', but found 'checker'");
}
