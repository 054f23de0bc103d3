// Scenes that proofs decide, and scenes that they leave undecided.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/proof/proved.h"
#include "tests/proof/worlds.h"
#include "tests/unit/scenes.h"

using namespace strahl;
using proof::prove, proof::Proved, proof::view_of;

namespace {

/// A dull ball before a floor, seen from 6 away.
Scene ball_on_floor() {
    Scene scene;
    scene.camera.position = {0, -6, 1}, scene.camera.look_at = {0, 0, 0}, scene.camera.up = {0, 0, -1};
    scene.camera.fov = 20;
    scene.background.color = {.2, .3, .4};
    scene.lights.push_back({.position = {3, -8, 9}, .color = Color(.71)});
    Material dull;
    dull.reflection = 0;
    scene.materials.push_back(dull);
    scene.primitives.push_back({Sphere{{0, 0, 0}, .7}, 0, {}});
    scene.primitives.push_back({Plane{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}, 0, {}});
    return scene;
}
/// Returns the share of pixels with a bound below 1e-9.
double share_bounded(const Scene& scene) {
    const Proved proved = prove(scene, view_of(scene, 64, 48));
    return static_cast<double>(std::ranges::count_if(proved.bounds, [](double b) { return b < 1e-9; })) /
           static_cast<double>(proved.bounds.size());
}

}  // namespace

TEST_CASE("what proofs do not know is undecided") {
    const Scene plain = ball_on_floor();
    CHECK(share_bounded(plain) > .97);
    Scene scene = plain;
    const auto parts = std::make_shared<const std::vector<Primitive>>(
        std::vector<Primitive>{{Mesh{}, 0, {}}, {Sphere{{0, 0, 0}, 2}, 0, {}}});
    scene.primitives.push_back({Intersection{parts}, 0, {Translate{{-.6, -1.5, -.5}}}});
    CHECK(share_bounded(scene) < .9);  // the body and its shadow
    CHECK(share_bounded(scene) > .3);
    scene = plain;
    for (const Shape& shape : {Shape(Prism{}), Shape(Lathe{}), Shape(Superellipsoid{}), Shape(Blob{}),
                               Shape(SphereSweep{}), Shape(JuliaFractal{})}) {
        const double size = std::holds_alternative<JuliaFractal>(shape) ? .3 : 1;  // it would be all around
        scene.primitives.push_back({shape, 0, {Scale{DVec3(size)}, Translate{{-.6, -1.5, -.5}}}});
        CHECK(share_bounded(scene) < .9);
        CHECK(share_bounded(scene) > .3);
        scene = plain;
    }
    scene.lights[0].area = Area{{1, 0, 0}, {0, 1, 0}};
    CHECK(share_bounded(scene) < .3);
    scene = plain;  // twice in the same place, by its numbers in double
    scene.primitives.push_back(scene.primitives[0]);
    CHECK(share_bounded(scene) < .9);
}

TEST_CASE("what proofs know is decided") {
    Scene scene = ball_on_floor();
    scene.lights[0].spot = Spot{.look_at = {0, 0, -1}, .radius = 3, .falloff = 5};
    const DVec3 at{-.9, -.5, -.4}, beside{.6, -.9, -1};
    const auto put = [&](const Shape& shape) { scene.primitives.push_back({shape, 0, {Rotate{{10, 20, 30}}}}); };
    put(Disc{at, {1, -1, .5}, .4, .1});
    put(Triangle{beside, {.9, -.9, -.8}, {.7, -.6, -.3}});
    put(Mesh{});
    scene.primitives.back().transformations = {Scale{{.2, .3, .4}}, Translate{{-1, -1, -.9}}};
    put(Cone{beside, .2, {.3, -1.2, -.3}, .05});
    put(Cuboid{{.5, .2, -.8}, {.9, .5, .3}});
    put(Difference{});
    scene.primitives.back().transformations = {Scale{DVec3(.3)}, Translate{{.2, -1.3, -.2}}};
    for (Primitive& primitive : scene.primitives) {
        if (std::holds_alternative<Plane>(primitive.shape)) continue;
        primitive.transformations.push_back(Scale{{1, 1.5, .7}});
        CHECK(share_bounded(scene) > .97);
    }
    put(Torus{{-.2, -1.4, .5}, {1, 1, 1}, .3, .1});
    CHECK(share_bounded(scene) > .97);
    scene.primitives.back().transformations.push_back(Scale{{1, 1.2, .9}});
    CHECK(share_bounded(scene) > .97);
    const std::vector<ColorStop> colors{{0, Color(.2)}, {1, Color(.8)}};
    scene.background = Pigment(Pattern{Checker{}, colors, {Scale{DVec3(.3)}}});
    for (const PatternKind& kind : {PatternKind(Checker{}), {Gradient{}}, {Brick{}}, {Noise{}}, {Marble{}}, {Wood{}}}) {
        scene.materials[0].rgb = Pigment(Pattern{kind, colors, {Rotate{{5, 6, 7}}}});
        CHECK(share_bounded(scene) > .97);
    }
    scene.fog = Fog{10, Color(.5)};
    CHECK(share_bounded(scene) > .97);
    for (Primitive& primitive : scene.primitives)
        if (Mesh* const mesh = std::get_if<Mesh>(&primitive.shape)) {
            MeshData data = *mesh->data;
            for (const DVec3& point : data.points) data.places.push_back({point.x, point.z});
            mesh->data = std::make_shared<const MeshData>(data);
            primitive.material = 1;
        }
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].rgb = Pigment(Pattern{Checker{}, colors, {Scale{DVec3(.1)}}, true});
    CHECK(share_bounded(scene) > .97);
}

TEST_CASE("bumps and normal maps are decided") {
    const Scene plain = ball_on_floor();
    Dice dice(1);
    for (int i = 0; i < 6; ++i) {
        Scene scene = plain;
        scene.materials[0].bump = random_bump(dice);
        CHECK(share_bounded(scene) > .8);
        scene.materials[0].normal = random_normal_map(dice);
        CHECK(share_bounded(scene) > .8);
        scene.materials[0].reflection = .2;
        CHECK(share_bounded(scene) > .7);
    }
}

TEST_CASE("glass that overlaps or is in fog is decided if it is certain where the eye is") {
    Scene scene = ball_on_floor();
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].refraction = .8, scene.materials[1].ior = 1.3;
    const DVec3 left{-.3, -2, .2}, right{.3, -2, .2};
    scene.primitives.push_back({Sphere{left, .5}, 1, {}});
    scene.primitives.push_back({Sphere{right, .5}, 1, {}});
    scene.primitives.push_back({Disc{{0, -3, .4}, {0, 1, .1}, .6}, 1, {}});
    CHECK(share_bounded(scene) > .97);
    scene.primitives.push_back({Sphere{scene.camera.position, .5}, 1, {}});
    CHECK(share_bounded(scene) > .97);
    const auto in_fog = [&] {
        Scene foggy = scene;
        foggy.fog = Fog{10, Color(.5)};
        return share_bounded(foggy);
    };
    CHECK(in_fog() > .97);
    scene.primitives.back().shape = Torus{scene.camera.position, {0, 1, 0}, .5, .1};
    CHECK(share_bounded(scene) < .95);
    CHECK(in_fog() == 0);
}

TEST_CASE("a picture with bounds is that of double") {
    for (int seed = 0; seed < 20; ++seed) {
        const Scene scene = proof::random_world(seed);
        const View view = view_of(scene, 48, 36);
        CAPTURE(seed);
        const Proved proved = prove(scene, view);
        const std::vector<double> plain = render(scene, view).rgb;
        // Glass is multiplied in another order, and flat faces of composites are met by their own formulas.
        double most = 0;
        for (std::size_t i = 0; i < plain.size(); ++i)
            most = std::max(most, std::abs(proved.rgb[i] - plain[i]) - proved.bounds[i / 3]);
        CHECK(most < 1e-15);
    }
}
