// Several bodies chosen together, the camera and the background chosen, and bodies that are put onto others, without a
// window.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "num/vec_math.h"
#include "scene/overlap.h"
#include "show/body_tools.h"
#include "show/session/drag.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "tests/unit/show/soon.h"
#include "text/light_text.h"

using namespace strahl;

namespace {

View small_view(const Scene& scene) { return {.camera = scene.camera, .width = 160, .height = 120}; }

const BodyValue& value_named(const BodyText& body, const std::string& name) {
    const auto found = std::ranges::find(body.values, name, &BodyValue::name);
    REQUIRE(found != body.values.end());
    return *found;
}

}  // namespace

TEST_CASE("with Shift a click chooses one body more, or one less") {
    const auto scene = shown_scene();
    const View view = small_view(*scene);
    BodyEditor editor;
    editor.open(scene_text);
    editor.click(*scene, *scene, view, 80, 50, {}, true);
    editor.click(*scene, *scene, view, 2, 100, {}, true);
    CHECK(editor.bodies() == std::vector<int>{0, 2});
    CHECK(editor.number() == 2);
    CHECK(editor.names() == "2 bodies");
    editor.click(*scene, *scene, view, 2, 100, {}, true);
    CHECK(editor.bodies() == std::vector<int>{0});
    CHECK(editor.body().kind == "sphere");
    editor.click(*scene, *scene, view, 80, 50, {}, true);
    CHECK(!editor.any());
    editor.add(0, {}, *scene), editor.add(1, {}, *scene);
    editor.click(*scene, *scene, view, 2, 100);
    CHECK(editor.bodies() == std::vector<int>{2});
    editor.choose(LightPoint{0, false}, *scene);
    editor.add(1, {}, *scene);
    CHECK(!editor.light());
    CHECK(editor.bodies() == std::vector<int>{1});
}

TEST_CASE("several bodies are moved, turned and scaled together, and keep their places to each other") {
    const Scene scene = *shown_scene();
    const std::vector<int> both{0, 1};
    const auto placed = PlacedBodies::find(scene_text, scene, both);
    REQUIRE(placed);
    const auto centres = [&](const Placing& placing) {
        const Scene now = parse_scene(placed->text(placing, 6), "test");
        return std::pair(world_bounds(now.primitives[0]).centre(), world_bounds(now.primitives[1]).centre());
    };
    const auto near = [](const DVec3& a, const DVec3& b) { return length(a - b) < 1e-4; };
    const auto moved = centres(MoveBy{{1, 2, -3}});
    CHECK(near(moved.first, {1, 2, -1}));
    CHECK(near(moved.second, {3.5, 0, -2}));
    const auto turned = centres(TurnBy{{0, 0, 1}, 90, {0, 0, 0}});
    CHECK(near(turned.first, {0, 0, 2}));
    CHECK(near(turned.second, {2, 2.5, 1}));
    const auto scaled = centres(ScaleBy{DVec3(2), {0, 0, 0}});
    CHECK(near(scaled.first, {0, 0, 4}));
    CHECK(near(scaled.second, {5, -4, 2}));
    CHECK(!PlacedBodies::find(scene_text, scene, std::vector{0, 7}));
}

TEST_CASE("what is moved onto a surface touches it") {
    const Scene scene = parse_scene(
        "camera { position <0,-20,5> look_at <0,0,0> sky <0,0,1> fov 20 }\n"
        "sphere { <4, 3, 9>, 1 }\n"
        "plane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\n"
        "box { <0, 0, 0>, <2, 2, 2> }\n"
        "plane { <9, 0, 9>, <10, 0, 8>, <9, 1, 9> }\n",  // its normal is <1, 0, 1> / sqrt(2)
        "test");
    const std::vector<Primitive> ball{scene.primitives[0]};
    const auto onto = [&](const DVec3& start, const DVec3& way, const std::set<int>& passed = {0}) {
        return way_onto(scene, ball, passed, Ray<double>{start, normalize(way), -1});
    };
    const auto near = [](const std::optional<DVec3>& by, const DVec3& centre) {
        return by && length(DVec3(4, 3, 9) + *by - centre) < 1e-6;
    };
    CHECK(near(onto({-3, -3, 5}, {0, 0, -1}), {-3, -3, 1}));      // the floor
    CHECK(near(onto({1, 1, 5}, {0, 0, -1}), {1, 1, 3}));          // the top of the box
    CHECK(near(onto({1, -5, 1}, {0, 1, 0}), {1, -1, 1}));         // its side
    CHECK(near(onto({1, 1, 5}, {0, 0, -1}, {0, 2}), {1, 1, 1}));  // without the box
    const double half = std::sqrt(.5);
    CHECK(near(onto({9, 0, 12}, {0, 0, -1}), {9 + half, 0, 9 + half}));  // a slope
    CHECK(!onto({0, 0, 5}, {-1, 0, .5}));
    // Upright: on the slope as if it were level.
    const auto upright = way_onto(scene, ball, {0}, Ray<double>{{9, 0, 12}, {0, 0, -1}, -1}, DVec3(0, 0, 1));
    CHECK(near(upright, {9, 0, 10}));
    const std::vector<Primitive> plane{scene.primitives[1]};
    CHECK(!way_onto(scene, plane, {0}, Ray<double>{{0, 0, 5}, {0, 0, -1}, -1}));
}

TEST_CASE("a drag along an axis puts a body onto what is below it") {
    const std::string text =
        "camera { position <0,-20,5> look_at <0,0,0> sky <0,0,1> fov 20 }\n"
        "sphere { <-3, 0, 5>, 1 }\nplane { <0, 0, 0>, <1, 0, 0>, <0, 1, 0> }\nbox { <2, -1, 0>, <4, 1, 2> }\n";
    const Scene scene = parse_scene(text, "test");
    BodyEditor editor;
    editor.open(text);
    editor.choose(0, {-3, 0, 5}, scene);
    const View view{.camera = scene.camera, .width = 640, .height = 480};
    const Handles handles(HandleMode::move, {-3, 0, 5}, {DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)}, 80, view);
    const glm::dvec2 from = *place_in(view, {-3, 0, 5});
    std::string why;
    const auto drag = Drag::begin(editor, scene, handles, Handle::x, from, why);
    REQUIRE(drag);
    const auto height = [&](const glm::dvec2& to) {
        const Scene now = parse_scene(drag->text(drag->placing_on_surface(to, scene, {}), false), "test");
        return world_bounds(now.primitives[0]).centre().z;
    };
    CHECK(height(from) == 1);
    CHECK(height(*place_in(view, {3, 0, 5})) == 3);
}

TEST_CASE("bodies chosen together are copied and removed, and get a material; one step each of undo") {
    const Scratch folder;
    const std::string path = folder / "scene.rt";
    std::ofstream(path) << scene_text;
    Session session(shown_scene());
    Pace pace(Pace::Clock::now(), 60);
    Notes notes(pace, false);
    auto reload = std::make_unique<Reload>(path);
    const Loaded first = reload->take(60).value();
    WatchedScene file(first, false, std::move(reload), notes, pace, [] {});
    BodyTools tools(session, file, notes, pace, [] {});
    tools.loaded(first);
    const View view = small_view(*session.scene);
    const auto text = [&]() -> const std::string& { return tools.editor().edited.text(); };
    const auto bodies_shown = [&](std::size_t count) {
        return soon([&] {
            tools.follow(view, 1);
            return session.scene->primitives.size() == count;
        });
    };
    tools.click(view, {80, 50}, 4);
    tools.click(view, {107, 73}, 4, true);
    REQUIRE(tools.editor().bodies() == std::vector<int>{0, 1});
    REQUIRE(tools.copy());
    REQUIRE(bodies_shown(5));
    CHECK(tools.editor().bodies() == std::vector<int>{1, 3});
    REQUIRE(tools.remove());
    REQUIRE(bodies_shown(3));
    CHECK(text() == scene_text);
    tools.click(view, {80, 50}, 4);
    tools.click(view, {107, 73}, 4, true);
    tools.apply(BodyInput{.preset = &material_presets[4]});
    const Scene golden = parse_scene(text(), "test");
    for (const int body : {0, 1})
        CHECK(golden.materials[std::size_t(golden.primitives[std::size_t(body)].material)].metallic == 1);
    CHECK(tools.undo(true));
    CHECK(text() == scene_text);
}

TEST_CASE("the numbers of the camera and of the background are changed in their blocks") {
    const auto scene = shown_scene();
    BodyEditor editor;
    editor.open(scene_text);
    EditOrder order;
    editor.choose(TopBlock::camera, *scene);
    CHECK(editor.body().kind == "perspective");
    CHECK(editor.body().line == 2);
    CHECK(editor.name() == "the camera");
    const double nearer[] = {1, 2, 3}, fov[] = {30};
    CHECK(editor.change(value_named(editor.body(), "position"), nearer, order));
    editor.look(*scene);
    CHECK(editor.change(value_named(editor.body(), "fov"), fov, order));
    editor.choose(TopBlock::background, *scene);
    CHECK(value_named(editor.body(), "color").source == no_source);
    const double sky[] = {.1, .2, .7}, night[] = {0, 0, .1};
    CHECK(editor.change(value_named(editor.body(), "color"), sky, order));
    const auto newer = std::make_shared<const Scene>(parse_scene(editor.edited.text(), "test"));
    CHECK(newer->camera.position == DVec3(1, 2, 3));
    CHECK(newer->camera.fov == 30);
    CHECK(newer->background.color == Color(.1, .2, .7));
    editor.look(*newer);
    CHECK(editor.body().line == 3);
    CHECK(editor.change(value_named(editor.body(), "color"), night, order));
    CHECK(parse_scene(editor.edited.text(), "test").background.color == Color(0, 0, .1));
    for (int i = 0; i < 4; ++i) CHECK(editor.edited.undo(true, order));
    CHECK(editor.edited.text() == scene_text);

    const std::string fish =
        "camera { position <0,0,1> look_at <0,1,1> sky <0,0,1> fisheye 180 }\n"
        "background { color checker { <1,1,1>, <0,0,0> } }\n";
    const Scene round = parse_scene(fish, "test");
    CHECK(camera_values(fish, round).kind == "fisheye");
    CHECK(value_named(camera_values(fish, round), "fisheye").numbers == std::vector<double>{180});
    CHECK(value_named(background_values(fish, round), "color").fixed == "a pattern");
    CHECK(value_named(camera_values("", round), "look_at").fixed == "from the file");
}
