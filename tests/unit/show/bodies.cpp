// Choosing bodies by a click, and changing their numbers, without a window.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "num/vec_math.h"
#include "pov/open_scene.h"
#include "scene/leaves.h"
#include "show/external_editor.h"
#include "show/session/body_editor.h"
#include "show/work/silhouette.h"
#include "tests/unit/scratch.h"
#include "tests/unit/show/show_scene.h"
#include "trace/tracer.h"

using namespace strahl;

namespace {

View shown_view(const Scene& scene) { return {.camera = scene.camera, .width = 160, .height = 120}; }

std::size_t number_of(const BodyEditor& editor, const std::string& name) {
    for (std::size_t i = 0; i < editor.body().values.size(); ++i)
        if (editor.body().values[i].name == name) return i;
    FAIL("no value " << name);
    return 0;
}
const BodyValue& value_of(const BodyEditor& editor, const std::string& name) {
    return editor.body().values[number_of(editor, name)];
}

}  // namespace

TEST_CASE("a click chooses the body that is seen there; again, the one behind it") {
    const auto scene = shown_scene();
    const View view = shown_view(*scene);
    BodyEditor editor;
    editor.open(scene_text);
    editor.click(*scene, *scene, view, 80, 50);
    REQUIRE(editor.choice());
    CHECK(editor.choice()->at.body == 0);
    CHECK(editor.body().kind == "sphere");
    CHECK(editor.body().line == 4);
    CHECK(std::abs(length(editor.choice()->point - DVec3(0, 0, 2)) - 2) < 1e-9);
    CHECK(dot_product(editor.choice()->at.hit.normal, editor.choice()->point - DVec3(0, 0, 2)) > 1.9);
    editor.click(*scene, *scene, view, 81, 50);
    CHECK(editor.body().kind == "plane");
    editor.click(*scene, *scene, view, 80, 50);
    CHECK(!editor.choice());
    editor.click(*scene, *scene, view, 80, 50);
    CHECK(editor.body().kind == "sphere");
    editor.click(*scene, *scene, view, 2, 100);
    CHECK(editor.body().kind == "plane");
    Camera up = view.camera;
    up.look_at = up.position + DVec3(0, .1, 5);
    editor.click(*scene, *scene, {.camera = up, .width = 160, .height = 120}, 80, 60);
    CHECK(!editor.choice());
}

TEST_CASE("the camera moves to where a body fills the picture, and looks into the same direction") {
    const auto scene = shown_scene();
    const DVec3 before = normalize(scene->camera.look_at - scene->camera.position);
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        Camera camera = scene->camera;
        camera.projection = projection;
        const Camera near = approached(camera, {{1, 2, 3}, {2, 4, 3.5}}, 4. / 3);
        CHECK(near.look_at == DVec3(1.5, 3, 3.25));
        CHECK(length(normalize(near.look_at - near.position) - before) < 1e-12);
        View view = shown_view(*scene);
        view.camera = near;
        // A ball around it is in the picture, and not far from its edges.
        const auto around = shown_scene("sphere { <1.5,3,3.25>, 1.1456 }");
        CHECK(bodies_along(*around, ray_at(view, 80, 12))[0].body == 3);
        for (const BodyHit& met : bodies_along(*around, ray_at(view, 80, 4))) CHECK(met.body != 3);
    }
}

TEST_CASE("a new body stands where a surface is seen, or as far away as the camera looks") {
    const auto scene = shown_scene();
    const View view = shown_view(*scene);
    const StandingPlace on_ball = standing_place(*scene, view, 80, 50);
    CHECK(std::abs(length(on_ball.point - DVec3(0, 0, 2)) - 2) < 1e-9);
    CHECK(length(on_ball.normal - normalize(on_ball.point - DVec3(0, 0, 2))) < 1e-9);
    // 24 degrees of view, at a distance of 25, are 120 pixels: a twelfth of these is .7 long.
    CHECK(on_ball.size == .5);
    CHECK(on_ball.decimals == 2);
    // A surface that is seen from below carries new bodies on its lower side.
    Camera below = view.camera;
    below.position.z = -18;
    CHECK(standing_place(*scene, {.camera = below, .width = 160, .height = 120}, 80, 60).normal == DVec3(0, 0, -1));
    Camera up = view.camera;
    up.look_at = up.position + DVec3(0, 0, 5), up.up = {0, 1, 0};
    const StandingPlace in_air = standing_place(*scene, {.camera = up, .width = 160, .height = 120}, 80, 60);
    CHECK(length(in_air.point - up.look_at) < 1e-9);
    CHECK(length(in_air.normal - DVec3(0, -1, 0)) < 1e-9);
}

TEST_CASE("what is clicked is what is traced") {
    const auto scene = shown_scene(
        "difference { box { <-4,-4,0>, <-1,-1,3> } sphere { <-2,-4,2>, 1.5 } cylinder { <-3,-3,-1>, <-3,-3,9>, .5 } }"
        "torus { <3,3,1>, <0,0,1>, 2, .5 } cone { <4,-4,0>, 1, <4,-4,3>, .2 rotate <0,0,20> }");
    View view = shown_view(*scene);
    view.depth = 1;
    Scene painted = *scene;
    painted.lights.clear(), painted.materials.clear();
    for (std::size_t i = 0; i < painted.primitives.size(); ++i) {
        painted.materials.push_back({.rgb = {double(i + 1) / 8, 0, 0}, .reflection = 0, .ambient = 1});
        painted.primitives[i].material = static_cast<int>(i);
        change_parts(painted.primitives[i], [i](Primitive& part) { part.material = static_cast<int>(i); });
    }
    const Frame frame = render(painted, view);
    int wrong = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const std::vector<BodyHit> met = bodies_along(*scene, ray_at(view, x + .5, y + .5));
            const double seen = 8 * frame.rgb[std::size_t(3 * (y * view.width + x))];
            wrong += std::lround(seen) != (met.empty() ? 0 : met[0].body + 1);
        }
    CHECK(wrong == 0);
}

TEST_CASE("a number follows the panel, within its range, and undo takes back a whole drag") {
    const auto scene = shown_scene();
    BodyEditor editor;
    editor.open(scene_text);
    editor.click(*scene, *scene, shown_view(*scene), 80, 50);
    EditOrder order;
    const auto set = [&](const char* name, std::vector<double> numbers, bool merged = false) {
        const bool changed = editor.change(value_of(editor, name), numbers, order, merged);
        editor.look(*scene);
        return changed;
    };
    CHECK(set("radius", {2.5}));
    CHECK(set("radius", {2.75}, true));
    CHECK(editor.edited.text().find("sphere { <0,0,2>, 2.75 material") != std::string::npos);
    CHECK(!set("radius", {2.75}));
    CHECK(!set("radius", {std::numeric_limits<double>::quiet_NaN()}));
    CHECK(set("rgb", {1, -5, .2}));
    CHECK(value_of(editor, "rgb").numbers[1] == 0);
    CHECK(editor.edited.undo(true, order) == "rgb of sphere 1");
    CHECK(editor.edited.undo(true, order) == "radius of sphere 1");
    CHECK(editor.edited.text() == scene_text);
    CHECK(!editor.edited.undo(true, order));
    CHECK(editor.edited.undo(false, order) == "radius of sphere 1");
    editor.look(*scene);
    CHECK(value_of(editor, "radius").numbers[0] == 2.75);
    order.change();  // a change of something else: now there is nothing to redo
    CHECK(!editor.edited.undo(false, order));
    // A value that stands elsewhere is not touched before the user has said which is meant.
    CHECK(editor.open_to_change(value_of(editor, "ior")));  // asked twice, it becomes the body's own
    CHECK(set("ior", {1.2}));
    CHECK(set("ior", {1.3}, true));
    CHECK(editor.edited.text().find("rgb <1,.2,.2>  ior 1.3 }") != std::string::npos);
}

TEST_CASE("a value of a definition is changed there or for one body, as the user says") {
    const std::string text =
        "define red material { rgb <1,0,0> }\n" + scene_text + "sphere { <0,0,2>, 2 material red }\n";
    const Scene scene = parse_scene(text, "");
    BodyEditor editor;
    editor.open(text);
    const View view = shown_view(scene);
    for (int i = 0; i < 2; ++i) editor.click(scene, scene, view, 80, 50);  // there are two at the same place
    REQUIRE(editor.choice()->at.body == 3);
    const std::size_t rgb = number_of(editor, "rgb");
    EditOrder order;
    const std::vector<double> green{0, 1, 0};
    CHECK(!editor.change(editor.body().values[rgb], green, order));
    CHECK(editor.make_own(editor.body().values[rgb], order));
    editor.look(scene);
    CHECK(editor.change(editor.body().values[rgb], green, order));
    CHECK(editor.edited.text().find("material red { rgb <0, 1, 0> } }") != std::string::npos);
    CHECK(editor.edited.undo(true, order));
    CHECK(editor.edited.undo(true, order));
    editor.look(scene);
    editor.allow("define red, line 1");
    CHECK(editor.change(editor.body().values[rgb], green, order));
    CHECK(editor.edited.text() == std::string(text).replace(text.find("<1,0,0>"), 7, "<0,1,0>"));
}

TEST_CASE("changes stay when others change other lines of the file, and give way in the same ones") {
    EditOrder order;
    EditedText edited;
    edited.open("a\nb\nc\nd\n");
    edited.change("a\nB\nc\nd\n", {order, "change"});
    edited.change("a\nB\nc\nD\n", {order, "change"});
    CHECK(!edited.reload("new\na\nb\nc\nd\n"));
    CHECK(edited.text() == "new\na\nB\nc\nD\n");
    CHECK(edited.unwritten() == std::vector<std::string>{"3: B", "5: D"});
    CHECK(edited.undo(true, order));
    CHECK(edited.text() == "new\na\nB\nc\nd\n");
    CHECK(edited.undo(false, order));
    CHECK(edited.reload("new\na\ntheirs\nc\nd\n"));
    CHECK(edited.text() == "new\na\ntheirs\nc\nD\n");
    CHECK(edited.undo(true, order));
    CHECK(!edited.changed());
    CHECK(!edited.undo(true, order));  // the line that was changed has other text now
    CHECK(edited.undo(false, order));
    CHECK(!edited.reload(edited.text()));  // the file has the changes: nothing is left to write
    CHECK(!edited.changed());
    CHECK(edited.undo(true, order));
    CHECK(edited.changed());
    edited.open("path\na\nb\n");
    edited.change("path\nA\nb\n", {order, "change"});
    CHECK(!edited.reload("new path\nA\nb\n"));  // written together with something else
    CHECK(!edited.changed());
    CHECK(edited.undo(true, order));
    CHECK(edited.text() == "new path\na\nb\n");
    edited.open("a\r\nb");
    edited.change("a\r\nB", {order, "change"});
    CHECK(text_of(rebased(edited.changes(), "x\r\na\r\nb").text.changed) == "x\r\na\r\nB");
    CHECK(text_of(rebased(edited.changes(), "").text.changed) == "");
    CHECK(rebased(edited.changes(), "").lost);
}

TEST_CASE("lines are added and removed, and undo and redo find them again") {
    EditOrder order;
    EditedText edited;
    edited.open("a\nb\nc\nd\n");
    edited.change("a\nb\nb2\nb3\nc\nd\n", {order, "change"});
    edited.change("a\nb\nb2\nb3\nd\n", {order, "change"});
    CHECK(edited.unwritten() == std::vector<std::string>{"3: b2", "4: b3", "5, removed: c"});
    EditedText copied;  // a copy of a line, in the same place, would be lost as well
    copied.open("a\nb\n");
    copied.change("a\na\nb\n", {order, "copy"});
    CHECK(copied.unwritten() == std::vector<std::string>{"2: a"});
    edited.change("a\nb\nb2\nB3\nd\n", {order, "change"});
    CHECK(!edited.reload("new\na\nb\nc\nd\n"));
    CHECK(edited.text() == "new\na\nb\nb2\nB3\nd\n");
    CHECK(!edited.reload("new\na\nb\nb2\nB3\nd\npath\n"));  // written together with something else
    CHECK(!edited.changed());
    for (int i = 0; i < 3; ++i) CHECK(edited.undo(true, order));
    CHECK(edited.text() == "new\na\nb\nc\nd\npath\n");
    CHECK(!edited.undo(true, order));
    for (int i = 0; i < 3; ++i) CHECK(edited.undo(false, order));
    CHECK(!edited.changed());
    edited.open("x");
    edited.change("", {order, "change"});
    edited.change("y\nz", {order, "change"});
    CHECK(edited.undo(true, order));
    CHECK(edited.undo(true, order));
    CHECK(edited.text() == "x");

    // Whatever is done and however often the file becomes what was written, undo leads back to the beginning.
    std::uint32_t state = 1;
    const auto random = [&](std::size_t n) { return ((state = state * 1664525 + 1013904223) >> 8) % n; };
    for (int run = 0; run < 200; ++run) {
        std::vector<std::string> lines{"a", "b", "c", "b", "a", ""};
        const auto text_now = [&] {
            std::string text;
            for (const std::string& line : lines) text.append(&line == &lines.front() ? "" : "\n").append(line);
            return text;
        };
        const std::string first = text_now();
        edited.open(first);
        std::vector<std::string> texts{first};
        for (int step = 0; step < 12; ++step) {
            const std::size_t at = random(lines.size());
            const auto place = lines.begin() + std::ptrdiff_t(at);
            if (random(3) == 0 && lines.size() > 2)
                lines.erase(place);
            else if (random(2) == 0)
                lines.insert(place, random(2) == 0 ? "b" : "n" + std::to_string(step));
            else
                lines[at] = "c" + std::to_string(step);
            edited.change(text_now(), {order, "change"});
            REQUIRE(edited.text() == text_now());
            if (texts.back() != text_now()) texts.push_back(text_now());
            if (random(4) == 0) CHECK(!edited.reload(text_now()));
        }
        for (std::size_t i = texts.size() - 1; i-- > 0;) {
            REQUIRE(edited.undo(true, order));
            CHECK(edited.text() == texts[i]);
        }
        CHECK(!edited.undo(true, order));
        for (std::size_t i = 1; i < texts.size(); ++i) REQUIRE(edited.undo(false, order));
        CHECK(edited.text() == text_now());
    }
}

TEST_CASE("the lines around a body are those between its pixels and others") {
    const std::vector<bool> inside{false, true, true,  false,  //
                                   false, true, false, false};
    CHECK(lines_around(inside, 4, 2) ==
          std::vector<SilhouetteLine>{{2, 1, 3, 1}, {1, 0, 1, 2}, {2, 1, 2, 2}, {3, 0, 3, 1}});
    CHECK(lines_around({true}, 1, 1).empty());
    const auto scene = shown_scene();
    std::atomic<bool> told = false;
    Silhouette silhouette([&] { told = true, told.notify_all(); });
    silhouette.want(scene, {0}, shown_view(*scene));
    told.wait(false);
    REQUIRE(silhouette.take());
    CHECK(silhouette.lines().size() > 20);
    for (const auto& [x0, y0, x1, y1] : silhouette.lines()) {
        CHECK((x0 > 30 && x1 < 130 && y0 > 5 && y1 < 110));
        CHECK((x0 == x1) != (y0 == y1));
    }
    CHECK(!silhouette.take());
    silhouette.drop();
    CHECK(silhouette.lines().empty());
}

TEST_CASE("a body of a scene of POV-Ray stands in a line of a text; those of other files only an editor changes") {
    const Scratch folder;
    std::ofstream(folder / "balls.inc") << "\r\n\r\n#macro Ball(P)\r\n  sphere { P, 1 }\r\n#end\r\n";
    const std::string text =
        "#version 3.7;\n#include \"balls.inc\"\ncamera { location <0, 0, -5> }\nbox { 5, 6 }\n"
        "// é\nBall(<0, 0, 0>) union { box { <-9, -9, 8>, <9, 9, 9> }\n sphere { 9, 1 } }";
    const OpenedScene opened = open_scene(text, folder / "scene.pov", {}, {});
    BodyEditor editor;
    editor.open(text, BodyEditor::TextKind::povray);
    editor.take_lines(opened.lines, text);
    const View view = shown_view(opened.scene);
    editor.click(opened.scene, opened.scene, view, 80, 60);
    REQUIRE(editor.choice());
    CHECK(editor.body().kind == "sphere");
    CHECK(editor.body().line == 4);
    CHECK(editor.file() == folder / "balls.inc");
    CHECK(editor.read_only());
    for (const BodyValue& value : editor.body().values) CHECK(!editor.open_to_change(value));
    editor.click(opened.scene, opened.scene, view, 80, 60);
    REQUIRE(editor.choice());
    CHECK(editor.body().line == 6);
    CHECK(editor.file() == folder / "scene.pov");
}

TEST_CASE("numbers that stand in a text for POV-Ray are changed there; of several bodies only when that is meant") {
    const Scratch folder;
    const std::string text =
        "#declare R = 1;\ncamera { location <0, 0, -5> }\nsphere { 0, R pigment { rgb <1, 0, 0> } }\n"
        "#for (I, 1, 2) box { -9, <9, 9, 9> translate 30*z*I } #end\n";
    const auto open = [&](const std::string& now) { return open_scene(now, folder / "scene.pov", {}, {}); };
    const OpenedScene opened = open(text);
    BodyEditor editor;
    editor.open(text, BodyEditor::TextKind::povray);
    editor.take_lines(opened.lines, text);
    editor.choose(0, {}, opened.scene);
    const auto value = [&](const std::string& name) {
        const auto& values = editor.body().values;
        return *std::ranges::find(values, name, &BodyValue::name);
    };
    CHECK(editor.open_to_change(value("pigment rgb")));
    CHECK(!editor.open_to_change(value("rgb")));  // the scene's default colour
    CHECK(!editor.open_to_change(value("radius")));
    editor.allow("declare R, line 1");
    EditOrder order;
    CHECK(editor.change(value("radius"), std::array{1.25}, order));
    editor.look(opened.scene);  // the changed text has not been read yet
    CHECK(editor.change(value("pigment rgb"), std::array{1., .5, 0.}, order));
    const std::string& changed = editor.edited.text();
    CHECK(changed.starts_with("#declare R = 1.25;\n"));
    CHECK(changed.find("sphere { 0, R pigment { rgb <1, 0.5, 0> } }\n#for") != changed.npos);
    const OpenedScene now = open(changed);
    editor.take_lines(now.lines, changed);
    editor.look(now.scene);
    CHECK(value("rgb").numbers == std::vector<double>{1, .5, 0});
    CHECK(value("pigment rgb").numbers == value("rgb").numbers);
    editor.choose(2, {}, now.scene);
    CHECK(value("opposite corner").source == "line 4, which makes 2 bodies");
    CHECK(!editor.open_to_change(value("opposite corner")));
    CHECK(editor.edited.undo(true, order));
    CHECK(editor.edited.undo(true, order));
    CHECK(editor.edited.text() == text);
}

TEST_CASE("editors are started as each of them wants the line") {
    using Words = std::vector<std::string>;
    CHECK(editor_command("gedit", "xterm", "a b.rt", 7) == Words{"gedit", "+7", "a b.rt"});
    CHECK(editor_command("/usr/bin/vim -n", "xterm", "a.rt", 7) ==
          Words{"xterm", "-e", "/usr/bin/vim", "-n", "+7", "a.rt"});
    CHECK(editor_command("code -w", "xterm", "a.rt", 7) == Words{"code", "-w", "--goto", "a.rt:7"});
    CHECK(editor_command(" ", "xterm", "a.rt", 7).empty());
    ::unsetenv("VISUAL"), ::unsetenv("EDITOR");
    CHECK(open_in_editor("a.rt", 7).starts_with("no editor is known: set EDITOR"));
    ::setenv("EDITOR", "no-such-editor", 1);
    CHECK(open_in_editor("a.rt", 7) == "the editor cannot be started: there is no 'no-such-editor'");
    ::setenv("EDITOR", "true", 1);
    CHECK(open_in_editor("a.rt", 7) == "");
    ::unsetenv("EDITOR");
}
