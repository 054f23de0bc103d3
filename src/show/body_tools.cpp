#include "show/body_tools.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "num/vec_math.h"
#include "scene/moving_scene.h"
#include "scene/overlap.h"
#include "show/external_editor.h"

namespace strahl {

void BodyTools::loaded(const Loaded& scene) {
    if (scene.opened)
        bodies.open(scene.text);
    else if (bodies.edited.reload(scene.text))
        notes.announce("the file has other numbers now, which replace yours");
    good = scene.text;
    bodies.take_lines(scene.lines);
    bodies.look(*session.scene);
    if (bodies.edited.changed()) file.show(bodies.edited.text());
}

/// The scene at the moment of the view.
Scene BodyTools::scene_seen(const View& view) const {
    Scene scene = *session.scene;
    if (view.tracks) scene.tracks = *view.tracks;
    return at(scene, view.time);
}

void BodyTools::click(const View& view, double x, double y) {
    pace.redraw(3);
    bodies.click(scene_seen(view), *session.scene, view, x, y);
    if (!bodies.choice()) return;
    const BodyText& body = bodies.body();
    notes.log("chosen: body " + std::to_string(bodies.choice()->at.body + 1) + ", " + body.kind +
              (body.line > 0 ? ", line " + std::to_string(body.line) : ""));
}

void BodyTools::apply(const BodyInput& input) {
    if (input.close) bodies.close(), pace.redraw();
    if (input.allow) bodies.allow(*input.allow), pace.redraw();
    const std::size_t others = session.editor.steps();
    const auto& values = bodies.body().values;
    bool changed = false;
    if (const auto& change = input.change)
        changed = bodies.change(values[change->value], change->numbers, change->merged, others);
    if (input.own) changed = bodies.make_own(values[*input.own], others);
    if (changed) show();
}

void BodyTools::show() {
    bodies.look(*session.scene);
    file.show(bodies.edited.text());
    pace.redraw(3);
}

bool BodyTools::undo(Action action) {
    const std::size_t others = session.editor.steps();
    const bool done = action == Action::undo ? bodies.edited.undo(others) : bodies.edited.redo(others);
    if (!done) return false;
    notes.note(action == Action::undo ? "undone" : "redone");
    show();
    return true;
}

void BodyTools::approach(const View& view) {
    if (!bodies.choice()) return notes.note("click a body first; B then moves the camera to it");
    const Box box = world_bounds(scene_seen(view).primitives[std::size_t(bodies.choice()->at.body)]);
    if (!std::isfinite(length(box.high - box.low))) return notes.note("this body has no end");
    notes.tell(session.steer({}, pace.now()));
    session.camera = approached(session.camera, box, double(view.width) / view.height);
}

std::string BodyTools::file_name() const {
    return bodies.file().empty() ? file.name() : std::filesystem::path(bodies.file()).filename().string();
}

void BodyTools::open_text() {
    if (!bodies.choice()) return notes.note("click a body first; F4 then opens its line in your editor");
    if (bodies.body().line == 0 || file.path() == "-") return notes.note("no line of a file is known for this body");
    const std::string fault =
        open_in_editor(bodies.file().empty() ? file.path() : bodies.file(), bodies.body().line);
    if (!fault.empty()) notes.fail(fault);
}

void BodyTools::follow(const View& view) {
    if (auto shown = file.take_shown()) {
        if (shown->scene) {
            // One that was read before the path was written would bring the old path back; the next one follows.
            if (shown->scene->flythrough == session.scene->flythrough) {
                session.replace(std::move(shown->scene), false);
                good = shown->text;
            }
        } else if (shown->text == bodies.edited.text()) {
            notes.fail(shown->fault.substr(0, shown->fault.find('\n')));
            bodies.edited.change(good, true, session.editor.steps());
        }
        bodies.look(*session.scene);
        pace.redraw();
    }
    if (!bodies.choice())
        silhouette.drop();
    else if (!pace.moving())
        silhouette.want(session.scene, bodies.choice()->at.body, view);
    if (silhouette.take()) pace.redraw();
}

bool BodyTools::asks() {
    if (!bodies.edited.changed() || asked_about == bodies.edited.text()) return false;
    asked_about = bodies.edited.text();
    return true;
}

void BodyTools::print_unwritten() const {
    for (const std::string& line : bodies.edited.unwritten()) log_line("changed and not written, line " + line);
}

}  // namespace strahl
