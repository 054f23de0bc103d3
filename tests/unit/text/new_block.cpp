// Tests that bodies and lights that are added to a text stand on the surface that was clicked, and change nothing else.
#include "text/new_block.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

#include "num/vec_math.h"
#include "scene/overlap.h"
#include "scene/ray_hits.h"
#include "tests/unit/scenes.h"
#include "tests/unit/text/random_texts.h"
#include "text/parse.h"
#include "text/text_changes.h"
#include "text/write.h"

using namespace strahl;

namespace {

const std::string empty_scene = "camera { position <0,-9,2> look_at <0,0,0> up <0,0,-1> fov 20 }\n";

const NewBlock& block_of(const std::string& name) {
    for (const NewBlock& block : new_blocks)
        if (block.name == name) return block;
    FAIL("there is no " << name);
    return new_blocks[0];
}

}  // namespace

TEST_CASE("changes of a text are made in their order, and what they have in common once") {
    CHECK(with_changes("abcdef", {}) == "abcdef");
    CHECK(with_changes("abcdef", {{{4, 5}, "E"}, {{1, 2}, "B"}, {{6, 6}, "!"}, {{0, 0}, "?"}}) == "?aBcdEf!");
    CHECK(with_changes("abcdef", {{{1, 4}, "x"}, {{2, 5}, "y"}}) == "axyf");
    CHECK(with_changes("abcdef", {{{2, 2}, "1"}, {{2, 2}, "2"}}) == "ab12cdef");
}

TEST_CASE("a new block is one that a person would write, behind the last body or light") {
    const std::string text = empty_scene +
                             "sphere { <0,0,0>, 1 }  // one\n  box { <0,0,0>,\n    <1,1,1>\n  }  // two\n"
                             "light { position <1,2,3> color <1,1,1> } background { color <0,0,.1> }\n";
    const std::string with = with_new_block(text, block_of("sphere"), 2, {1.23456, 2, -.00001}, {0, 0, 1}, .5, 2);
    CHECK(with == empty_scene +
                      "sphere { <0,0,0>, 1 }  // one\n  box { <0,0,0>,\n    <1,1,1>\n  }  // two\n"
                      "  sphere { <0, 0, 0>, 0.5  material { rgb <.8, .8, .8>  reflection 0  refraction 0  "
                      "diffuse .8  ambient .1  specular .3 }  translate <1.23, 2, 0.5> }\n" +
                      text.substr(text.find("light")));
    CHECK(with_new_block(text, block_of("light"), 1, {0, 0, 0}, {0, 0, 1}, 1, 2)
              .find("} light { position <0, 0, 4>  color <.7, .7, .7> } background") != std::string::npos);
    CHECK(with_new_block("camera { }", block_of("light"), 0, {0, 0, 0}, {0, 0, 1}, 1, 2) ==
          "camera { }\nlight { position <0, 0, 4>  color <.7, .7, .7> }\n");
    CHECK(with_new_block(empty_scene, block_of("wall"), 0, {1, 2, 3}, {0, .1, .99}, 1, 2)
              .find("box { <-8, -0.13, -3>, <8, 0.13, 3>") != std::string::npos);
    CHECK(
        with_new_block(empty_scene, block_of("wall"), 0, {1, 2, 3}, {0, .1, .99}, 1, 2).find("translate <1, 2, 6> }") !=
        std::string::npos);
    // Bodies that a loop makes cannot be told apart in the text: the block comes behind all of it.
    CHECK(with_new_block("#for (I, 1, 2)\nsphere { <I, 0, 0>, 1 }\n#end\n", block_of("disc"), 2, {0, 0, 0}, {0, 0, 1},
                         1, 2)
              .find("#end\ndisc {") != std::string::npos);
}

TEST_CASE("new bodies stand on the surface, and lights are above it") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int run = 0; run < 200; ++run) {
        const DVec3 normal = normalize(DVec3(any(random), any(random), any(random))),
                    point = 100. * DVec3(any(random), any(random), any(random));
        const double size = std::pow(10, 2 * any(random));
        for (const NewBlock& block : new_blocks) {
            CAPTURE(block.name);
            const Scene scene = parse_scene(with_new_block(empty_scene, block, 0, point, normal, size, 5), "test");
            REQUIRE(scene.primitives.size() + scene.lights.size() == 1);
            if (block.what == TopBlock::light) {
                CHECK(length(scene.lights[0].position - point - (scene.lights[0].spot ? 6 : 4) * size * normal) < 1e-4);
                continue;
            }
            const Primitive& body = scene.primitives[0];
            const auto hits = ray_hits(body, {point + 20. * size * normal, DVec3(0) - normal, -1}, 0);
            // The hole of a torus is where it stands; boxes and walls stand straight, and touch slopes with an edge.
            const bool straight = std::string(block.name) == "box" || std::string(block.name) == "wall";
            if (std::string(block.name) != "torus") {
                REQUIRE(!hits.empty());
                CHECK(hits[0].t < 20 * size);
            }
            if (const Box box = world_bounds(body); box.finite() && !straight)
                for (int i = 0; i < 3; ++i) {
                    CHECK(box.low[i] > point[i] - 2.3 * size);
                    CHECK(box.high[i] < point[i] + 2.3 * size);
                }
            for (const RayHit& hit : hits)
                if (!straight) CHECK(hit.t < 20 * size + 1e-3 + 1e-3 * size);
        }
    }
}

TEST_CASE("a new body is the last one of any scene, and undone it leaves the text as it was") {
    RandomScenes scenes(12);
    int added = 0;
    for (int run = 0; run < 30; ++run) {
        const Scene scene = scenes.scene();
        const std::string whole = write_scene(scene);
        if (!is_valid(whole)) continue;
        const int bodies = static_cast<int>(scene.primitives.size()), lights = static_cast<int>(scene.lights.size());
        const std::string with = with_new_block(whole, new_blocks[0], bodies, {1, 2, 3}, {0, 0, 1}, 1, 2);
        const Scene longer = parse_scene(with, "test", {}, made_up_pixels);
        REQUIRE(std::ssize(longer.primitives) == bodies + 1);
        const Box box = world_bounds(longer.primitives.back());
        CHECK(box.low == DVec3(0, 1, 3));
        CHECK(box.high == DVec3(2, 3, 5));
        if (bodies > 0) CHECK(without_block(with, TopBlock::body, bodies) == whole);
        const std::string lit = with_new_block(whole, block_of("spotlight"), lights, {1, 2, 3}, {0, 0, 1}, 1, 2);
        CHECK(parse_scene(lit, "test", {}, made_up_pixels).lights.size() == scene.lights.size() + 1);
        ++added;
    }
    CHECK(added > 5);
}
