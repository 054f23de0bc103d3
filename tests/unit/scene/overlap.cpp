// Which transparent bodies share space, and how long it takes to say so.
#include "scene/overlap.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <random>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/ray_hits.h"
#include "tests/referee/dice.h"

namespace strahl {
namespace {

Scene glass() {
    Scene scene;
    scene.materials.push_back({.refraction = .5});
    return scene;
}

void add_ball(Scene& scene, const DVec3& centre, double radius) {
    scene.primitives.push_back({.shape = Sphere{centre, radius}, .material = 0, .transformations = {}});
}

TEST_CASE("bodies overlap exactly where some pair of them does") {
    std::minstd_rand random(7);
    int overlapping = 0;
    for (int round = 0; round < 400; ++round) {
        Scene scene = glass();
        std::uniform_real_distribution<double> place(-10, 10), size(.01, round % 4 ? .8 : 2);
        std::vector<Sphere> balls;
        bool expected = false;
        for (int i = 0; i < 2 + round % 37; ++i) {
            const Sphere ball{{place(random), round % 3 ? place(random) : 0, place(random)}, size(random)};
            for (const Sphere& other : balls) {
                const DVec3 d = ball.centre - other.centre;
                expected |= std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z) < ball.radius + other.radius;
            }
            balls.push_back(ball);
            add_ball(scene, ball.centre, ball.radius);
        }
        CHECK(transparent_bodies_overlap(scene) == expected);
        overlapping += expected;
    }
    CHECK(overlapping > 50);
    CHECK(overlapping < 350);
}

TEST_CASE("a composite with a part of glass may overlap, and its parts are found wherever they are") {
    Scene scene = glass();
    scene.materials.push_back({.refraction = 0});
    const auto part = [](int material) { return Primitive{Sphere{{1, 0, 0}, 1}, material, {Rotate{{0, 0, 90}}}}; };
    for (const int inner : {0, 1}) {
        const Union pair{
            std::make_shared<const std::vector<strahl::Primitive>>(std::vector<Primitive>{part(1), part(inner)})};
        scene.primitives = {{pair, 1, {Translate{{5, 0, 0}}}}};
        CHECK(transparent(scene, scene.primitives[0]) == (inner == 0));
        CHECK(transparent_bodies_overlap(scene) == (inner == 0));
    }
    std::vector<int> materials;
    for_each_leaf(scene.primitives[0], [&](const Primitive& leaf, const glm::dmat4& whole) {
        materials.push_back(leaf.material);
        CHECK(transform_point(whole, {1, 0, 0}) == DVec3(5, 1, 0));
    });
    CHECK(materials == std::vector<int>{1, 1});
    CHECK(contains(scene.primitives[0], {5, 1.9, 0}));
    CHECK_FALSE(contains(scene.primitives[0], {5, 2.1, 0}));
}

TEST_CASE("a hundred thousand glass balls are searched in no time, along any axis") {
    for (const DVec3 step : {DVec3(3, 0, 0), DVec3(0, 3, 0), DVec3(0, 0, 3), DVec3(0, 3, 3), DVec3(0, 0, 0)}) {
        Scene scene = glass();
        const int balls = 100000;
        for (int i = 0; i < balls; ++i)
            if (step == DVec3(0, 0, 0))  // a block of them, each touching its neighbours
                add_ball(scene, {3. * (i % 46), 3. * (i / 46 % 46), 3. * (i / 2116)}, 1.5);
            else
                add_ball(scene, double(i) * step, 1);
        const std::clock_t start = std::clock();  // processor time, which other programs do not lengthen
        CHECK_FALSE(transparent_bodies_overlap(scene));
        CHECK(std::clock() - start < 10 * CLOCKS_PER_SEC);
        add_ball(scene, (balls - 1.) * step, 1);
        CHECK(transparent_bodies_overlap(scene));
    }
}

TEST_CASE("rays meet the same triangles of a mesh with and without a tree") {
    Dice dice(7);
    auto mesh = std::make_shared<MeshData>();
    const auto anywhere = [&](double size) { return dice.vector(-size, size); };
    for (std::int32_t i = 0; i < 300; ++i) {
        const DVec3 middle = anywhere(4);
        for (int k = 0; k < 3; ++k) mesh->points.push_back(middle + anywhere(1));
        mesh->triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const Primitive body{Mesh{mesh, ""}, 0, {Translate{DVec3(1, 0, 0)}, Scale{DVec3(1, 2, -1)}}};
    MeshTrees trees;
    std::size_t found = 0;
    for (int i = 0; i < 200; ++i) {
        const DVec3 from = anywhere(9);
        const Ray<double> ray{from, normalize(anywhere(3) - from), {}};
        const std::vector<RayHit> hits = ray_hits(body, ray, 0), again = ray_hits(body, ray, 0, 1e9, &trees);
        REQUIRE(hits.size() == again.size());
        found += hits.size();
        for (std::size_t k = 0; k < hits.size(); ++k) CHECK(hits[k].t == again[k].t);
    }
    CHECK(found > 200);
}

}  // namespace
}  // namespace strahl

TEST_CASE("a composite that is endless on one side moves with its transformations") {
    const auto half = std::make_shared<const std::vector<strahl::Primitive>>(
        std::vector<strahl::Primitive>{{strahl::Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0, {}}});
    const strahl::Box box = strahl::world_bounds({strahl::Intersection{half}, 0, {strahl::Translate{{0, 0, 5}}}});
    CHECK(box.high.z == 5);
    CHECK(box.low.z == -std::numeric_limits<double>::infinity());
}

TEST_CASE("a plane ends a composite's box only if it lies across an axis, up to rounding") {
    const auto upper = [](double lean, const strahl::Transformation& turn) {
        const strahl::Plane plane{{0, 0, 0}, {1, 0, lean}, {0, 1, 0}};
        const auto parts = std::make_shared<const std::vector<strahl::Primitive>>(
            std::vector<strahl::Primitive>{{strahl::Sphere{{0, 0, 0}, 1e9}, 0, {}}, {plane, 0, {}}});
        return strahl::world_bounds({strahl::Intersection{parts}, 0, {turn}}).high;
    };
    const strahl::Translate nowhere{{0, 0, 0}};
    CHECK(upper(0, nowhere).z == 0);
    CHECK(upper(1e-9, nowhere).z >= 1);  // its normal's z is 1 in double
    CHECK(upper(0, strahl::Rotate{{-90, 0, 0}}).y == 0);
}
