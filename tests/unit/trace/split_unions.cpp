// Which bodies a union becomes when it is traced.
#include "trace/world/split_unions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <random>

#include "scene/overlap.h"
#include "tests/unit/sanitized.h"

namespace strahl {
namespace {

TEST_CASE("a union around the eye stays whole, whose surfaces inside it are not there") {
    const auto parts = std::make_shared<const std::vector<Primitive>>(
        std::vector<Primitive>{{Sphere{{.5, 0, 0}, 1}, 0, {}}, {Cuboid{{-9, -2, -9}, {9, .9, 9}}, 0, {}}});
    Scene scene;
    scene.materials.push_back({});
    scene.primitives.push_back({Union{parts}, 0, {Translate{{1, 2, 3}}}});
    const auto bodies_from = [&](const DVec3& eye) {
        scene.camera.position = eye + DVec3(1, 2, 3);
        return with_split_unions(scene).primitives.size();
    };
    for (const DVec3& inside : {DVec3(0, .5, -3), DVec3(.5, .95, 0), DVec3(8, 0, 8)}) CHECK(bodies_from(inside) == 1);
    for (const DVec3& outside : {DVec3(0, 1.5, -3), DVec3(2, .95, 0), DVec3(99, 0, 0)})
        CHECK(bodies_from(outside) == 2);
}

TEST_CASE("unions are split where their parts share no points") {
    std::minstd_rand random(5);
    int split = 0, groups_seen = 0;
    for (int round = 0; round < (sanitized() ? 60 : 200); ++round) {
        std::uniform_real_distribution<double> place(-10, 10), size(.1, round % 2 ? 2 : 6);
        const auto cube = [&](int material) {
            const DVec3 low{place(random), place(random), place(random)};
            return Primitive{Cuboid{low, low + DVec3(size(random))}, material, {Translate{{0, 1, 0}}}};
        };
        std::vector<Primitive> inner, outer;
        for (int i = 0; i < round % 9; ++i) inner.push_back(cube(0));
        for (int i = 0; i <= round % 7; ++i) outer.push_back(cube(0));
        std::vector<Box> boxes;
        for (const Primitive& part : outer) boxes.push_back(transformed_bounds(part, glm::dmat4(1)));
        const std::vector<Transformation> lift{Translate{{0, 0, 3}}};
        for (const Primitive& part : inner) boxes.push_back(transformed_bounds(part, matrix(lift)));
        if (!inner.empty()) outer.push_back({Union{std::make_shared<const std::vector<Primitive>>(inner)}, 0, lift});
        const Primitive whole{Union{std::make_shared<const std::vector<Primitive>>(outer)}, 0, {Translate{{9, 0, 0}}}};

        // Groups by the plainest way: neighbours take over the lower number until none does.
        std::vector<std::size_t> group(boxes.size());
        for (std::size_t i = 0; i < group.size(); ++i) group[i] = i;
        const auto meet = [](const Box& a, const Box& b) {
            bool all = true;
            for (int c = 0; c < 3; ++c) all &= a.low[c] <= b.high[c] && b.low[c] <= a.high[c];
            return all;
        };
        for (std::size_t pass = 0; pass < boxes.size(); ++pass)
            for (std::size_t i = 0; i < boxes.size(); ++i)
                for (std::size_t k = 0; k < boxes.size(); ++k)
                    if (meet(boxes[i], boxes[k])) group[i] = group[k] = std::min(group[i], group[k]);
        std::size_t groups = 0;
        for (std::size_t i = 0; i < group.size(); ++i) groups += group[i] == i;

        std::vector<Material> materials{{.refraction = .5}};
        const std::vector<Primitive> pieces = split_union(whole, materials);
        CHECK(pieces.size() == groups);
        split += groups > 1, groups_seen += static_cast<int>(groups);
        if (groups == 1 && boxes.size() > 1) CHECK(pieces[0] == whole);
        for (int i = 0; i < 200; ++i) {
            const DVec3 p{9 + place(random), place(random), place(random)};
            const auto in = [&](const Primitive& piece) { return contains(piece, p); };
            CHECK(std::ranges::count_if(pieces, in) == contains(whole, p));
        }
    }
    CHECK(split > (sanitized() ? 15 : 50));
    CHECK(groups_seen > (sanitized() ? 90 : 300));
}

TEST_CASE("what a union of many bodies becomes") {
    std::vector<Material> materials{{}, {.refraction = .5, .ior = 1.5}, {.refraction = .5, .ior = 1.3}, {}};
    const auto row = [](int balls, double step, int material) {
        std::vector<Primitive> parts;
        for (int i = 0; i < balls; ++i) parts.push_back({Sphere{{step * i, 0, 0}, 1}, material, {}});
        return Primitive{Union{std::make_shared<const std::vector<Primitive>>(parts)}, material, {}};
    };
    CHECK(split_union(row(64, 1, 0), materials).size() == 64);  // only an eye inside sees inner surfaces
    CHECK(split_union(row(64, 1, 1), materials).size() == 1);   // and those of glass
    CHECK(split_union(row(65, 1, 1), materials).size() == 1);
    CHECK(split_union(row(65, 3, 1), materials).size() == 65);
    Primitive mixed = row(65, 3, 1);
    mixed.material = 2;  // which refracts in another way than its parts
    CHECK(split_union(mixed, materials) == std::vector<Primitive>{mixed});
    // Faces with different materials in one plane have an order, as long as there are few.
    for (const int balls : {64, 65}) {
        const Primitive row_of_one = row(balls, 1, 0);
        std::vector<Primitive> parts = *std::get<Union>(row_of_one.shape).parts;
        parts[1].material = 3;
        const Primitive two{Union{std::make_shared<const std::vector<Primitive>>(parts)}, 0, {}};
        CHECK(split_union(two, materials).size() == (balls == 64 ? 1 : 65));
        Primitive own_pattern = row_of_one;
        own_pattern.material = 3;  // the parts have material 0, whose pattern is where they are
        materials[0].rgb = Pigment(Pattern{});
        CHECK(split_union(own_pattern, materials).size() == (balls == 64 ? 1 : 65));
        materials[0].rgb = Material{}.rgb;
    }
    // Parts that were moved take the whole's patterns along, those of bumps, shares and coats too.
    materials.assign(4, {});
    materials[0].rgb = Pigment(Pattern{}), materials[0].bump.pattern = std::make_shared<const Pattern>();
    materials[0].coats = {{.rgb = Pigment(Pattern{})}};
    materials[0].share = materials[0].coats[0].share = Pigment(Pattern{});
    const Primitive ball{Sphere{{0, 0, 0}, 1}, 0, {Translate{{7, 0, 0}}}};
    const std::vector<Primitive> moved = split_union(
        {Union{std::make_shared<const std::vector<Primitive>>(1, ball)}, 0, {Translate{{0, 5, 0}}}}, materials);
    const std::vector<Transformation> back{Translate{{-7, 0, 0}}};
    CHECK(materials.at(4).rgb.pattern->transformations == back);
    CHECK(materials.at(4).bump.pattern->transformations == back);
    CHECK(materials.at(4).share.pattern->transformations == back);
    CHECK(materials.at(4).coats.at(0).rgb.pattern->transformations == back);
    CHECK(materials.at(4).coats.at(0).share.pattern->transformations == back);
    materials.assign(4, {});

    const std::clock_t start = std::clock();  // processor time, which other programs do not lengthen
    const std::size_t many = sanitized() ? 20000 : 100000;
    for (const double step : {0., .001, 3.})
        CHECK(split_union(row(static_cast<int>(many), step, 0), materials).size() == many);
    CHECK(std::clock() - start < 10 * CLOCKS_PER_SEC);
    CHECK(materials.size() == 4);
}

}  // namespace
}  // namespace strahl
