// The referee, compared with pixels computed on paper, and with itself in 113 bits.
#include "tests/referee/referee.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/referee/random_scene.h"

using namespace strahl;

namespace {

/// All coefficients are 0 until a test sets them.
const Material dull{.rgb = {.5, .25, 1},
                    .reflection = 0,
                    .refraction = 0,
                    .diffuse = 0,
                    .ambient = 0,
                    .specular = 0,
                    .pow = 1,
                    .ior = 1};

Scene scene_of(std::initializer_list<std::pair<Shape, Material>> bodies) {
    Scene scene;
    scene.camera = {{0, 0, -5}, {0, 0, 0}, {0, -1, 0}, 45, {}};  // x to the left of the picture, y up
    scene.background = {.1, .2, .3};
    for (const auto& [shape, material] : bodies) {
        scene.primitives.push_back({shape, static_cast<int>(scene.materials.size()), {}});
        scene.materials.push_back(material);
    }
    return scene;
}
/// The light that reaches the eye from straight ahead.
std::array<long double, 3> ahead(const Scene& scene, int depth = 20) {
    return Referee<long double>(scene, scene.camera, 2, 2, depth).at(1, 1).rgb;
}
void check(const std::array<long double, 3>& seen, const DVec3& expected) {
    for (int c = 0; c < 3; ++c) CHECK(double(seen[c]) == doctest::Approx(expected[c]).epsilon(1e-14));
}
Material with(Material m, double Material::*share, double value) {
    m.*share = value;
    return m;
}
const Sphere unit_ball{{0, 0, 0}, 1};
const Plane wall{{0, 0, 3}, {0, 1, 3}, {1, 0, 3}};  // faces the eye

}  // namespace

TEST_CASE("a ray that hits nothing has the background colour") { check(ahead(scene_of({})), {.1, .2, .3}); }

TEST_CASE("ambient light") {
    Scene scene = scene_of({{unit_ball, with(dull, &Material::ambient, .6)}});
    scene.settings.ambient_light = {1, .5, 2};
    check(ahead(scene), {.6 * .5, .6 * .25 * .5, .6 * 2});
}

TEST_CASE("diffuse light falls off with the cosine and comes from the front only") {
    Scene scene = scene_of({{wall, with(dull, &Material::diffuse, .8)}});
    scene.lights = {{{4, 0, 0}, {1, .5, .25}}};  // 3 in front, 4 aside: cosine 3/5
    check(ahead(scene), {.8 * .6 * .5, .8 * .6 * .5 * .25, .8 * .6 * .25});
    scene.lights[0].position = {4, 0, 6};
    check(ahead(scene), {0, 0, 0});
}

TEST_CASE("the highlight follows the mirrored viewing ray and has the light's colour") {
    Material shiny = with(dull, &Material::specular, .5);
    shiny.pow = 3;
    Scene scene = scene_of({{wall, shiny}});
    scene.lights = {{{4, 0, 0}, {1, .5, .25}}};
    check(ahead(scene), {.5 * .216, .25 * .216, .125 * .216});
}

TEST_CASE("a camera's axes") {
    Scene scene = scene_of({{Sphere{{-2, 1, 0}, .1}, with(dull, &Material::ambient, 1)}});
    const Referee<long double> referee(scene, scene.camera, 10, 10, 1);
    // At distance 5 the picture is 10 wide; -x is to the right here (right-handed, looking along z, y up).
    check(referee.at(7, 4).rgb, {.5, .25, 1});
    check(referee.at(3, 4).rgb, {.1, .2, .3});
    check(referee.at(7, 6).rgb, {.1, .2, .3});
}

TEST_CASE("a mirror, which is black at the depth limit") {
    const Plane behind{{0, 0, -8}, {1, 0, -8}, {0, 1, -8}};
    Material mirror = with(dull, &Material::reflection, .5);
    const Scene scene = scene_of({{wall, mirror}, {behind, with(mirror, &Material::ambient, 1)}});
    check(ahead(scene, 1), {0, 0, 0});
    check(ahead(scene, 2), {.25, .125, .5});
    check(ahead(scene, 3), {.25, .125, .5});
    check(ahead(scene, 4), {.25 * 1.25, .125 * 1.25, .5 * 1.25});
    check(ahead(scene_of({{unit_ball, mirror}}), 2), {.05, .1, .15});
}

TEST_CASE("glass takes two generations and does not colour what is seen through it") {
    const Scene scene = scene_of({{unit_ball, with(with(dull, &Material::refraction, .5), &Material::ior, 1.5)}});
    check(ahead(scene, 2), {0, 0, 0});
    check(ahead(scene, 3), {.025, .05, .075});
}

TEST_CASE("shadows: opaque bodies block light, glass colours it at every surface") {
    Scene scene = scene_of({{wall, with(dull, &Material::diffuse, 1)}, {Sphere{{2, 0, 1.5}, .5}, dull}});
    scene.lights = {{{4, 0, 0}, {1, 1, 1}}};
    check(ahead(scene), {0, 0, 0});
    scene.materials[1].refraction = .5;
    const double lit = .6;
    check(ahead(scene), {.5 * lit * .0625, .25 * lit * .015625, lit * .25});
    scene.primitives[1].shape = Cylinder{{2, -1, 1.5}, {2, 1, 1.5}, .5};
    check(ahead(scene), {.5 * lit * .0625, .25 * lit * .015625, lit * .25});
    scene.primitives[1].shape = Plane{{0, 0, 1.5}, {0, 1, 1.5}, {1, 0, 1.5}};
    scene.materials[1].diffuse = 0;
    check(Referee<long double>(scene, scene.camera, 2, 2, 1).at(1, 1).rgb, {0, 0, 0});  // the sheet itself is dull
    CHECK(ahead(scene, 2)[2] == doctest::Approx(.5 * lit * .5));
}

TEST_CASE("Snell's law: the ray through a sheet of water meets the ground where it should") {
    // The eye looks down at 45 degrees onto water 1 deep; refracted by 4/3, sin = 3/4 sin 45.
    Material water = with(with(dull, &Material::refraction, 1), &Material::ior, 4. / 3);
    Scene scene = scene_of({{Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, water}});
    const double sine = .75 * std::sqrt(.5), x = sine / std::sqrt(1 - sine * sine);
    for (const bool hit : {true, false}) {
        scene.materials.push_back(with(dull, &Material::ambient, 1));
        scene.primitives.push_back({Sphere{{hit ? x : x + .02, 0, -1}, .01}, 1, {}});
        scene.camera = {{-1, 0, 1}, {0, 0, 0}, {0, 0, -1}, 10, {}};
        check(ahead(scene), hit ? DVec3(.5, .25, 1) : DVec3(.1, .2, .3));
        scene.primitives.pop_back();
    }
}

TEST_CASE("total reflection adds the transmitted share to the reflected one") {
    Material water = with(with(dull, &Material::refraction, .5), &Material::ior, 4. / 3);
    water.reflection = .25;
    Scene scene = scene_of({{Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, water}});
    scene.camera = {{-1.2, 0, -1}, {0, 0, 0}, {0, 0, -1}, 10, {}};  // sine .768 > 3/4
    check(ahead(scene), {.075, .15, .225});
    scene.camera.position.x = -1.1;  // sine .74
    check(ahead(scene), {.075, .15, .225});
    scene.primitives.push_back({Plane{{0, 0, -9}, {1, 0, -9}, {0, 1, -9}}, 1, {}});  // now the two shares differ
    scene.materials.push_back(with(dull, &Material::ambient, 1));
    check(ahead(scene), {.05 + .125, .1 + .0625, .15 + .25});
    scene.camera.position.x = -1.2;
    check(ahead(scene), {.375, .1875, .75});
}

TEST_CASE("an eye inside a body hits its far side and has it on its medium stack") {
    Scene scene = scene_of({{Sphere{{0, 0, -4}, 3}, with(dull, &Material::ambient, 1)}});
    check(ahead(scene), {.5, .25, 1});
    // From the centre of a ball of glass every ray leaves straight; wrongly "entering" would total-reflect none either,
    // so look from aside, where only ratio 1.5 reflects totally.
    Material glass = with(with(dull, &Material::refraction, 1), &Material::ior, 1.5);
    scene = scene_of({{Sphere{{.75, 0, -5}, 1}, glass}});
    const double sine = .75;
    CHECK(sine * 1.5 > 1);
    check(ahead(scene, 2), {0, 0, 0} /* reflected for ever */);
    scene.primitives[0].shape = Sphere{{.6, 0, -5}, 1};
    check(ahead(scene, 2), {.1, .2, .3});
}

TEST_CASE("the first declared of two coincident bodies wins, whatever the depth of the camera") {
    Scene scene = scene_of({{wall, with(dull, &Material::ambient, 1)}, {wall, with(dull, &Material::ambient, .5)}});
    check(ahead(scene), {.5, .25, 1});
    std::swap(scene.primitives[0], scene.primitives[1]);
    check(ahead(scene), {.25, .125, .5});
}

TEST_CASE("transformed bodies: an egg, a mirrored half-space") {
    Scene scene = scene_of({{unit_ball, with(dull, &Material::diffuse, 1)}});
    scene.primitives[0].transformations = {Scale{{2, 1, .5}}, Rotate{{0, 0, 90}}, Translate{{0, 0, .5}}};
    scene.lights = {{{0, 3, -4}, {1, 1, 1}}};  // the egg's top is at 0: 4 in front, 3 aside
    check(ahead(scene), {.4, .2, .8});
    const Referee<long double> referee(scene, scene.camera, 100, 100, 1);
    CHECK(double(referee.at(50, 33).rgb[2]) != .3);  // 1.7 up: its long axis
    CHECK(double(referee.at(50, 23).rgb[2]) == .3);  // 2.7 up: beside it
    CHECK(double(referee.at(67, 50).rgb[2]) == .3);  // 1.7 aside
}

namespace {

std::shared_ptr<const std::vector<Primitive>> list(std::vector<Primitive> parts) {
    return std::make_shared<const std::vector<Primitive>>(std::move(parts));
}
/// A composite of material 0, seen from in front.
Scene made(const Shape& whole, std::initializer_list<Material> materials) {
    Scene scene = scene_of({});
    scene.materials = materials;
    scene.primitives = {{whole, 0, {}}};
    return scene;
}
const Material glow = with(dull, &Material::ambient, 1);
Material pane(double share) { return with(dull, &Material::refraction, share); }

}  // namespace

TEST_CASE("a lens refracts at both its faces as a whole, and a union has no surface inside") {
    Material glass = pane(1);
    glass.ior = 1.5;
    const auto two = list({{Sphere{{0, 0, -.6}, 1}, 0, {}}, {Sphere{{0, 0, .6}, 1}, 0, {}}});
    Scene lens = made(Intersection{two}, {glass, glow});
    check(ahead(lens, 3), {.1, .2, .3});
    check(ahead(lens, 2), {0, 0, 0});  // a ray through two faces needs three generations
    // A thin lens of radii 1 has the focal length 1: a ray parallel to the axis, .1 aside, crosses it there.
    lens = made(Intersection{list({{Sphere{{0, 0, -.99}, 1}, 0, {}}, {Sphere{{0, 0, .99}, 1}, 0, {}}})}, {glass, glow});
    lens.primitives.push_back({Sphere{{0, 0, 1}, .01}, 1, {}});
    lens.camera = {{.1, 0, -5}, {.1, 0, 0}, {0, -1, 0}, 10, {}};
    check(ahead(lens), {.5, .25, 1});
    lens.primitives.erase(lens.primitives.begin());
    check(ahead(lens), {.1, .2, .3});

    check(ahead(made(Union{two}, {pane(.5)})), {.025, .05, .075});
    check(ahead(made(Union{two}, {pane(.5)}), 3), {.025, .05, .075});
}

TEST_CASE("a hollow ball has four faces, each of its part's material") {
    const Shape hollow = Difference{list({{Sphere{{0, 0, 0}, 2}, 0, {}}, {Sphere{{0, 0, 0}, 1}, 1, {}}})};
    Scene scene = made(hollow, {pane(.5), pane(.25)});
    const double share = .25 * .0625;
    check(ahead(scene), {.1 * share, .2 * share, .3 * share});
    check(ahead(scene, 4), {0, 0, 0});
    scene.camera.position = {0, 0, 0};
    scene.camera.look_at = {0, 0, 1};
    check(ahead(scene), {.0125, .025, .0375});  // from the middle, which is not in it
    scene.materials[1] = glow;
    check(ahead(scene), {.5, .25, 1});
}

TEST_CASE("a box minus a box that ends where it does is open there") {
    const Cuboid whole{{-1, -1, -1}, {1, 1, 1}}, lower{{-.5, -.5, -1}, {.5, .5, 0}};
    const Material ground = with(dull, &Material::ambient, .5);
    Scene scene = made(Difference{list({{whole, 0, {}}, {lower, 1, {}}})}, {ground, glow});
    check(ahead(scene), {.5, .25, 1});  // the end of the hollow, not the face that both have
    // Turns both by a quarter and moves them on two levels: the same is seen.
    for (const bool turned : {false, true}) {
        const std::vector<Transformation> steps =
            turned ? std::vector<Transformation>{Rotate{{0, 0, 90}}, Scale{DVec3(.5)}} : std::vector<Transformation>{};
        scene.primitives = {
            {Difference{list({{Union{list({{whole, 0, steps}})}, 0, {Translate{{0, 0, 1}}}},
                              {lower, 1,
                               turned ? std::vector<Transformation>{Scale{DVec3(.5)}, Translate{{0, 0, 1}}}
                                      : std::vector<Transformation>{Translate{{0, 0, 1}}}}})},
             0,
             {Translate{{0, 0, .25}}}}};
        check(ahead(scene), {.5, .25, 1});
    }
    // Puts two faces in one place: the first declared is seen, unless the other body continues behind it.
    const Cuboid upper{{-1, -1, 1}, {1, 1, 2}};
    for (const int first : {0, 1})
        check(ahead(made(Union{list({{whole, first, {}}, {whole, 1 - first, {}}})}, {ground, glow})),
              first == 0 ? DVec3(.25, .125, .5) : DVec3(.5, .25, 1));
    check(ahead(made(Union{list({{whole, 0, {}}, {upper, 0, {}}})}, {pane(.5)}), 3), {.025, .05, .075});
    check(ahead(made(Intersection{list({{whole, 0, {}}, {upper, 0, {}}})}, {glow})), {.1, .2, .3});
}

TEST_CASE("a ray that starts on a face in one place with another one does not meet that") {
    // A mirror that is the common face of two parts shows what is behind the eye.
    const Material mirror = with(dull, &Material::reflection, 1);
    const Cuboid whole{{-1, -1, -1}, {1, 1, 1}}, half{{-1, -1, -1}, {1, 1, 0}};
    check(ahead(made(Union{list({{whole, 0, {}}, {half, 1, {}}})}, {mirror, glow}), 2), {.1, .2, .3});
    check(ahead(made(Union{list({{half, 0, {}}, {whole, 1, {}}})}, {pane(1), glow}), 2), {.5, .25, 1});
}

TEST_CASE("long double and 113 bits agree on random scenes") {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const Scene scene = random_scene(seed, {.camera_inside = seed % 3 == 2});
        const Referee<long double> extended(scene, scene.camera, 8, 6, 5);
        const Referee<Quadruple> quad(scene, scene.camera, 8, 6, 5);
        for (int j = 0; j < 6; ++j)
            for (int i = 0; i < 8; ++i) {
                const Sample a = extended.at(i + .5, j + .5), b = quad.at(i + .5, j + .5);
                CHECK(a.signature == b.signature);
                for (int c = 0; c < 3; ++c) CHECK(std::abs(a.rgb[c] - b.rgb[c]) < 1e-15);
            }
    }
}

TEST_CASE("a shift explains only edges") {
    Scene scene =
        scene_of({{Plane{{-5. / 64, 0, 0}, {-5. / 64, 1, 0}, {-5. / 64, 0, 1}}, with(dull, &Material::ambient, 1)}});
    const Referee<long double> referee(scene, scene.camera, 64, 64, 1);
    const double far[3]{.9, .9, .9};
    int edges = 0;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) edges += referee.explains(i, j, far, 1e-9, .6);
    CHECK(edges == 2 * 64);
    const double same[3]{.1, .2, .3};
    CHECK(referee.explains(0, 0, same, 1e-15, 1e-9));
    const double off[3]{.1, .2, .3001};
    CHECK(!referee.explains(0, 0, off, 1e-5, 1e-9));
}
