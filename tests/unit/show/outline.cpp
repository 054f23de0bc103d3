// The outline of a scene, and what is hidden there, without a window.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "show/body_tools.h"
#include "show/panels/outliner.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "tests/unit/show/soon.h"

using namespace strahl;

namespace {

const std::string more =
    "light { position <0,0,9> color <1,1,1> spot { look_at <0,0,0> } }\n"
    "difference { box { <-4,-4,0>, <-1,-1,3> } union { sphere { <-2,-4,2>, 1 } sphere { <-2,-3,2>, 1 } }"
    " cylinder { <-3,-3,-1>, <-3,-3,9>, .5 } }\n";

std::vector<std::string> names_of(const std::vector<OutlineRow>& rows, const std::string& words,
                                  const std::set<int>& open = {}) {
    std::vector<std::string> names;
    for (const std::size_t i : rows_shown(rows, words, open)) names.push_back(rows[i].name);
    return names;
}

}  // namespace

TEST_CASE("the outline has lights, bodies, and the parts of composites with their leaves") {
    const std::vector<OutlineRow> rows = outline_of(*shown_scene(more));
    using Names = std::vector<std::string>;
    CHECK(names_of(rows, "") ==
          Names{"camera", "background", "light 1", "spotlight 2", "sphere 1", "sphere 2", "plane 3", "difference 4"});
    CHECK(names_of(rows, "", {3}) == Names{"camera", "background", "light 1", "spotlight 2", "sphere 1", "sphere 2",
                                           "plane 3", "difference 4", "box", "union", "sphere", "sphere", "cylinder"});
    CHECK(names_of(rows, "SPHERE") == Names{"sphere 1", "sphere 2", "difference 4", "sphere", "sphere"});
    CHECK(names_of(rows, "4") == Names{"difference 4"});
    CHECK(names_of(rows, "light") == Names{"light 1", "spotlight 2"});
    CHECK(names_of(rows, "torus").empty());
    const auto& cylinder = rows.back();
    CHECK(cylinder.number == 3);
    CHECK(cylinder.leaf == 3);
    CHECK(cylinder.depth == 1);
    CHECK(rows[rows.size() - 2].depth == 2);
    CHECK(outline_of({}).size() == 2);
}

TEST_CASE("clicks and new bodies meet what is behind a hidden body") {
    const auto scene = shown_scene();
    const View view{.camera = scene->camera, .width = 160, .height = 120};
    BodyEditor editor;
    editor.open(scene_text);
    editor.click(*scene, *scene, view, 80, 50, {0});
    CHECK(editor.body().kind == "plane");
    CHECK(standing_place(*scene, view, 80, 50, {0}).normal == DVec3(0, 0, 1));
}

TEST_CASE("the picture lacks what is hidden, until bodies come or go; the outline chooses") {
    const Scratch folder;
    const std::string path = folder / "scene.rt";
    std::ofstream(path) << scene_text << more;
    Session session(shown_scene(more));
    Pace pace(Pace::Clock::now(), 60);
    Notes notes(pace, false);
    auto reload = std::make_unique<Reload>(path);
    const Loaded first = reload->take(60).value();
    WatchedScene file(first, false, std::move(reload), notes, pace, [] {});
    BodyTools tools(session, file, notes, pace, [] {});
    tools.loaded(first);
    const std::vector<OutlineRow> rows = outline_of(*session.scene);
    const auto row = [&](const std::string& name) { return *std::ranges::find(rows, name, &OutlineRow::name); };
    CHECK(tools.scene_shown() == session.scene);
    tools.apply(OutlinerInput{.hide = row("sphere 1")});
    const auto rest = tools.scene_shown();
    CHECK(rest->primitives.size() == 3);
    CHECK(rest->primitives[0] == session.scene->primitives[1]);
    CHECK(tools.scene_shown() == rest);
    tools.apply(OutlinerInput{.hide = row("sphere 1")});
    CHECK(tools.scene_shown() == session.scene);
    tools.apply(OutlinerInput{.alone = row("plane 3")});
    CHECK(tools.scene_shown()->primitives.size() == 1);
    tools.apply(OutlinerInput{.alone = row("sphere 2")});
    CHECK(tools.scene_shown()->primitives[0] == session.scene->primitives[1]);
    tools.apply(OutlinerInput{.alone = row("sphere 2")});
    CHECK(tools.scene_shown() == session.scene);
    tools.apply(OutlinerInput{.hide = row("plane 3")});
    tools.apply(OutlinerInput{.show_all = true});
    CHECK(tools.hidden().empty());

    tools.apply(OutlinerInput{.choose = row("cylinder")});
    REQUIRE(tools.editor().choice());
    CHECK(tools.editor().body().kind == "cylinder in difference");
    tools.apply(OutlinerInput{.choose = row("spotlight 2")});
    CHECK(tools.editor().light() == LightPoint{1, false});
    // Once the scene has other bodies, all are shown.
    tools.apply(OutlinerInput{.hide = row("sphere 1")});
    session.replace(shown_scene(), false);
    CHECK(tools.scene_shown() == session.scene);
    CHECK(tools.hidden().empty());
}
