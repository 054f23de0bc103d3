// Scenes made by hand. Most use the same camera, in front and a little above.
#include "tests/referee/examples.h"

#include <memory>
#include <utility>

namespace strahl {
namespace {

Material paint(const Color& rgb) {
    return {
        .rgb = rgb, .reflection = 0, .refraction = 0, .diffuse = .8, .ambient = .1, .specular = 0, .pow = 1, .ior = 1};
}
Material mirror(double share) {
    Material m = paint({.2, .3, .4});
    m.reflection = share, m.specular = .5, m.pow = 40;
    return m;
}
Material glass(double ior, const Color& rgb = {.9, .8, .7}) {
    Material m = paint(rgb);
    m.reflection = .15, m.refraction = .8, m.diffuse = .1, m.ambient = 0, m.specular = .8, m.pow = 30, m.ior = ior;
    return m;
}
Material clear(double ior) {
    Material m = glass(ior);
    m.reflection = 0, m.refraction = 1, m.diffuse = 0, m.specular = 0;
    return m;
}
const Material white = paint({.9, .9, .9}), red = paint({.9, .2, .1}), blue = paint({.1, .3, .9});
const Plane ground{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}};  // normal up
const Sphere ball{{.3, 0, .1}, 1};
const Cylinder can{{-.4, .2, -.9}, {.5, -.3, .9}, .7};

/// A scene under construction.
struct Stage {
    Scene scene;
    Stage() {
        scene.camera = {{.4, -6, 2.1}, {0, .1, 0}, {0, 0, -1}, 24, {}};
        scene.background = {.1, .25, .4};
        scene.lights = {{{-3, -4, 5}, {.9, .8, .7}}};
    }
    Stage& put(const Shape& shape, const Material& material, std::vector<Transformation> steps = {}) {
        scene.primitives.push_back({shape, static_cast<int>(scene.materials.size()), std::move(steps)});
        scene.materials.push_back(material);
        return *this;
    }
    Stage& light(const DVec3& position, const Color& color) {
        scene.lights.push_back({position, color});
        return *this;
    }
    Stage& dark() {
        scene.lights.clear();
        return *this;
    }
    Stage& look(const DVec3& from, const DVec3& at, double fov, const DVec3& up = {0, 0, -1}) {
        scene.camera = {from, at, up, fov, {}};
        return *this;
    }
};

Material only(double Material::*share, double value) {
    Material m = paint({.7, .5, .3});
    m.diffuse = m.ambient = 0, m.pow = 20, m.ior = 1.4;
    m.*share = value;
    return m;
}
Material powered(double p) {
    Material m = only(&Material::specular, .8);
    m.pow = p;
    return m;
}

Scene crowd(bool transparent) {
    Stage stage;
    stage.put(ground, mirror(.3));
    for (int i = 0; i < 180; ++i) {
        const DVec3 at{(i % 10) * .37 - 1.8 + i % 7 * .01, (i / 10 % 6) * .4 - .8 + i % 5 * .02, (i / 60) * .6 - .7};
        const Material material = i % 11 == 0 ? mirror(.6) : i % 5 || !transparent ? white : glass(1.2);
        if (i % 3)
            stage.put(Sphere{at, .12 + .01 * (i % 4)}, material);
        else
            stage.put(Cylinder{at, at + DVec3{.1, .03 * (i % 4), .2}, .1}, material);
    }
    return stage.scene;
}

void terms(std::vector<Example>& list) {
    const auto add = [&](const char* name, Stage stage, int depth = 3) { list.push_back({name, stage.scene, depth}); };
    add("no objects", Stage());
    add("no lights", Stage().dark().put(ground, mirror(.5)).put(ball, red));
    add("nothing at all", Stage().dark());
    add("ambient", Stage().put(ground, white).put(ball, only(&Material::ambient, .6)));
    add("diffuse", Stage().put(ground, white).put(ball, only(&Material::diffuse, .9)));
    add("highlight", Stage().put(ground, white).put(ball, only(&Material::specular, .9)));
    add("highlight, pow 0", Stage().put(ground, white).put(ball, powered(0)));
    add("highlight, pow 2.5", Stage().put(ground, white).put(ball, powered(2.5)));
    add("highlight, pow 500", Stage().put(ground, white).put(ball, powered(500)));
    add("reflection", Stage().put(ground, white).put(ball, only(&Material::reflection, .7)));
    add("refraction", Stage().put(ground, white).put(ball, only(&Material::refraction, .7)), 4);
    add("refraction without bending", Stage().put(ground, white).put(ball, clear(1)), 4);
    add("reflection and refraction add up to more than 1",
        Stage().put(ground, mirror(.9)).put(ball, glass(1.5)).put(can, mirror(1)), 6);
    Material scattering = white;
    scattering.rgb = {1.5, 1.2, 2}, scattering.diffuse = 3, scattering.ambient = 2;
    add("brighter than white", Stage().put(ground, scattering).put(ball, mirror(1)));
    add("the defaults of the article", Stage().put(ground, {}).put(ball, {}).put(can, {}), 5);
    add("lights of three colours", Stage()
                                       .light({4, -3, 3}, {1, 0, 0})
                                       .light({0, 5, 5}, {0, .5, 2})
                                       .put(ground, white)
                                       .put(ball, mirror(.3))
                                       .put(can, blue));
    add("a black light, and one below the ground",
        Stage().light({2, -3, 4}, Color(0)).light({0, 0, -3}, {1, 1, 1}).put(ground, white).put(ball, red));
}

void shapes(std::vector<Example>& list) {
    const auto add = [&](const char* name, Stage stage, int depth = 4) { list.push_back({name, stage.scene, depth}); };
    const auto all = [](const Material& m) { return Stage().put(ground, m).put(ball, m).put(can, m); };
    add("matt shapes", all(red));
    add("mirror shapes", all(mirror(.8)), 6);
    add("glass shapes", all(glass(1.3)), 6);
    add("a plane from behind",
        Stage().look({0, -5, -3}, {0, 0, -1}, 30).light({2, -2, -4}, {1, 1, 1}).put(ground, red));
    add("a cylinder along its axis, eye outside",
        Stage().look({0, 0, 5}, {0, 0, 0}, 20, {0, 1, 0}).put(Cylinder{{0, 0, -1}, {0, 0, 1}, .8}, mirror(.4)));
    for (const Material& m : {mirror(.4), glass(1.5)}) {
        const Stage across = Stage().look({0, -4, 0}, {0, 0, 0}, 25).put(ground, white);
        add("cylinders across their axis", Stage(across).put(Cylinder{{0, 0, -.7}, {0, 0, .5}, .6}, m));
        add("cylinders across their axis, the other way", Stage(across).put(Cylinder{{0, 0, .5}, {0, 0, -.7}, .6}, m));
        add("a lying cylinder", Stage(across).put(Cylinder{{-.7, 0, 0}, {.8, 0, 0}, .6}, m));
        add("a cylinder inside",
            Stage(across).look({0, 0, 0}, {0, 1, 0}, 40).put(Cylinder{{0, 0, -.7}, {0, 0, .5}, .6}, m));
    }
}

/// Eyes in bodies and on them, bodies in one place, moved and out of shape.
void places(std::vector<Example>& list) {
    const auto add = [&](const char* name, Stage stage, int depth = 4) { list.push_back({name, stage.scene, depth}); };
    add("a plane through the eye, and parallel ones",
        Stage()
            .look({0, -5, 0}, {0, 0, 0}, 30)
            .put(Plane{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, red)
            .put(Plane{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, mirror(.6))
            .put(ground, mirror(.6)),
        6);
    add("glass cylinder along its axis",
        Stage()
            .look({0, 0, 5}, {0, 0, 0}, 20, {0, 1, 0})
            .put(Cylinder{{0, 0, 0}, {0, 0, 1}, .8}, glass(1.5))
            .put(Plane{{0, 0, -2}, {1, 0, -2}, {0, 1, -2}}, red),
        5);
    add("inside a ball",
        Stage()
            .look({.1, .2, -.1}, {1, 0, .2}, 50)
            .light({.2, -.3, .5}, {1, 1, 1})
            .put(Sphere{{0, 0, 0}, 2}, mirror(.6))
            .put(Sphere{{1, 0, 0}, .3}, red),
        7);
    add("inside a cylinder",
        Stage()
            .look({0, 0, .1}, {1, .3, .4}, 60)
            .light({.2, -.3, .5}, {1, 1, 1})
            .put(Cylinder{{0, -.2, -1.5}, {0, 0, 1.5}, 1.6}, mirror(.6)),
        7);
    add("an eye on a plane", Stage().look({0, -4, -1}, {0, 0, -1}, 30).put(ground, red).put(ball, mirror(.5)));
    const std::vector<Transformation> egg{Scale{{.5, 1, 1.6}}, Rotate{{20, 30, -40}}, Translate{{-.2, .1, .3}}};
    const std::vector<Transformation> flip{Scale{{1, 1, -1}}, Translate{{0, 0, -2}}};
    const std::vector<Transformation> turned{Rotate{{90, 0, 45}}, Scale{DVec3(-.8)}, Translate{{.3, 0, .2}}};
    add("an egg", Stage().put(ground, white).put(ball, mirror(.4), egg));
    add("a glass egg and a glass elliptic can",
        Stage().put(ground, white).put(ball, glass(1.4), egg).put(can, glass(1.2), {Scale{{1.5, .6, 1}}}), 6);
    add("a mirrored plane", Stage().put(ground, mirror(.4), flip).put(ball, red, turned).put(can, blue, turned));
    add("a slanted plane", Stage().put(ground, mirror(.4), {Rotate{{20, 10, 0}}, Scale{{1, 2, 3}}}).put(ball, red));
    add("coincident bodies, the first wins", Stage()
                                                 .dark()
                                                 .put(ball, only(&Material::ambient, .5))
                                                 .put(ball, red)
                                                 .put(can, blue)
                                                 .put(can, red)
                                                 .put(ground, blue)
                                                 .put(ground, red));
    Stage moved = Stage().put(ground, glass(1.3)).put(ball, glass(1.3)).put(can, glass(1.3));
    for (Primitive& p : moved.scene.primitives) p.transformations = {Scale{DVec3(100)}, Translate{{3e3, -5e3, 2e3}}};
    moved.look({3040, -5600, 2210}, {3000, -4990, 2000}, 24).dark().light({2700, -5400, 2500}, {1, .9, .8});
    add("far from the origin and large", moved);
    add("a crowd", {}), list.back().scene = crowd(false);
    add("a crowd with glass", {}), list.back().scene = crowd(true);
}

void media(std::vector<Example>& list) {
    const auto add = [&](const char* name, Stage stage, int depth = 8) { list.push_back({name, stage.scene, depth}); };
    const auto room = [] { return Stage().put(ground, white).put(Sphere{{-1.2, 2, 0}, .6}, red); };
    const Sphere inner{{.2, -.1, .2}, .5}, beside{{1.1, .2, .3}, .8};
    add("a bubble in glass", room().put(ball, clear(1.5)).put(inner, clear(1)));
    add("a bubble of less than air", room().put(ball, clear(.7)));
    add("three bodies in each other",
        room().put(inner, glass(2)).put(ball, glass(1.5)).put(Sphere{{.3, 0, .1}, 1.2}, glass(1.2)));
    add("overlapping glass", room().put(ball, clear(1.5)).put(beside, clear(1.3)).put(can, clear(1.7)));
    add("a mirror in glass", room().put(ball, glass(1.5)).put(inner, mirror(.9)));
    add("a matt body that crosses glass", room().put(ball, clear(1.5)).put(can, red));
    const auto pool = [](const Plane& water) {
        return Stage().put(Plane{{0, 0, -3}, {1, 0, -3}, {0, 1, -3}}, white).put(water, glass(1.33)).put(ball, red);
    };
    const Plane over{{0, 0, -.3}, {1, 0, -.3}, {0, 1, -.3}}, under{{0, 0, -.3}, {0, 1, -.3}, {1, 0, -.3}};
    add("water from above", pool(over));
    add("water from below, total reflection", pool(over).look({.4, -6, -2.5}, {0, 0, -.6}, 30));
    add("water whose inside is above", pool(under));
    add("water whose inside is above, from below", pool(under).look({.4, -6, -2.5}, {0, 0, -.6}, 30));
    Stage turned = pool(over);
    turned.scene.primitives[1].transformations = {Translate{{0, 0, .3}}, Scale{{1, 1, -1}}, Translate{{0, 0, -.3}}};
    add("water turned upside down by mirroring", turned);
    add("total reflection in a can", room().put(can, clear(2)));
    add("an eye in glass", room().look({.3, .1, .2}, {-1, 2, 0}, 40).put(ball, clear(1.5)));
    add("an eye in glass in glass",
        room().look({.3, .1, .2}, {-1, 2, 0}, 40).put(Sphere{{.3, 0, .1}, 1.3}, glass(1.2)).put(ball, glass(1.6)), 5);
    add("an eye in glass in glass, declared the other way round",
        room().look({.3, .1, .2}, {-1, 2, 0}, 40).put(ball, glass(1.6)).put(Sphere{{.3, 0, .1}, 1.3}, glass(1.2)), 5);
    add("an eye in a glass can", room().look({0, 0, .2}, {-1, 2, 0}, 40).put(can, clear(1.5), {Scale{{1.2, 1.1, 1}}}));
    const auto row = [](int bodies) {
        Stage stage;
        stage.put(ground, white).light({2, 4, 6}, {.4, .5, .9});
        const Color tints[]{{.9, .5, .5}, {.5, .9, .6}, {.6, .6, 1}};
        for (int i = 0; i < bodies; ++i)
            stage.put(Sphere{{-.3 * i, -.3 * i - .2, .4 * i - .3}, .5}, glass(1, tints[i % 3]));
        return stage;
    };
    add("shadow of one glass ball", row(1), 2);
    add("shadows through six glass balls", row(6), 2);
    add("an opaque body among them", row(5).put(Cylinder{{-2, -1, 1}, {2, -1.5, 1.2}, .3}, red), 2);
    add("a light in glass", room().put(Sphere{{-3, -4, 5}, .5}, glass(1.5)).put(ball, blue), 3);
    add("a light in an opaque ball", room().put(Sphere{{-3, -4, 5}, .5}, red), 3);
    add("black glass", room().put(ball, glass(1.2, Color(0))));
}

/// Beads on strings in a net of unions, more than one composite may have, and marbles with a mark that stands in one.
void unions(std::vector<Example>& list) {
    const auto united = [](std::vector<Primitive> parts) {
        return Union{std::make_shared<const std::vector<Primitive>>(std::move(parts))};
    };
    Material layered = paint({.9, .8, .6});
    layered.rgb = Pigment(Pattern{Gradient{{1, 2, .5}}, {{0, {.9, .3, .1}}, {1, {.2, .5, .9}}}, {Scale{DVec3(.7)}}});
    Stage stage;
    stage.put(ground, white).light({2, -5, 6}, {.4, .4, .5});
    const int plain = static_cast<int>(stage.scene.materials.size());
    stage.scene.materials.insert(stage.scene.materials.end(), {mirror(.3), layered, glass(1.4), red});
    std::vector<Primitive> strings, marbles;
    for (int string = 0; string < 4; ++string) {  // two of them of more bodies than stay together
        std::vector<Primitive> beads;
        for (int i = 0; i < (string < 2 ? 40 : 70); ++i)
            beads.push_back(
                {Sphere{{.03 * i - 1, 0, 0}, .08}, i % 3 ? plain + 1 : plain, {Translate{{0, 0, .01 * i}}}});
        beads.push_back({Cuboid{{-1.2, -.1, -.1}, {-1, .1, .1}}, plain + 1, {Rotate{{40, 0, 0}}}});
        strings.push_back({united(beads), string % 2 ? plain + 1 : plain, {Translate{{0, .3 * string, 0}}}});
    }
    for (int i = 0; i < 30; ++i)
        marbles.push_back({Sphere{{.3 * (i % 6), .3 * (i / 6), 0}, .13}, plain + 2, {Translate{{0, 0, .02 * i}}}});
    marbles.push_back({Cuboid{{.6, .3, 0}, {.8, .35, .9}}, plain + 3, {}});
    stage.scene.primitives.push_back({united(strings), plain + 1, {Rotate{{10, 0, 30}}, Translate{{0, -.5, 0}}}});
    stage.scene.primitives.push_back({united(marbles), plain + 2, {Translate{{-.2, -1.6, -.9}}}});
    list.push_back({"unions of many bodies", stage.scene, 5});
}

}  // namespace

Scene facing_mirrors() {
    Stage stage;
    stage.look({-1.5, -.2, .1}, {2, .1, 0}, 35).light({0, 1, 1.5}, {.5, .5, .6});
    stage.put(Plane{{2, 0, 0}, {2.01, 1, 0}, {2, 0, 1}}, mirror(.95))
        .put(Plane{{-2, 0, 0}, {-2, 1, .02}, {-2, 0, 1}}, mirror(.9));
    stage.put(Sphere{{.5, .6, -.4}, .3}, red).put(Cylinder{{0, -1, -1}, {0, -1, 1}, .1}, blue);
    return stage.scene;
}

std::vector<Example> examples() {
    std::vector<Example> list;
    terms(list), shapes(list), places(list), media(list), unions(list);
    list.push_back({"facing mirrors", facing_mirrors(), 20});
    return list;
}

}  // namespace strahl
