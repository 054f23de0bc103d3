#include "show/body_tools.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "pov/open_scene.h"
#include "scene/overlap.h"
#include "show/external_editor.h"
#include "text/camera_text.h"

namespace strahl {

void BodyTools::loaded(const Loaded& scene) {
    if (scene.moved) {
        good = scene.text;
        bodies.take_lines(scene.lines, scene.text);
        return bodies.look(*session.scene);
    }
    // The file may have the text already that is still read for the window: what is to follow that follows.
    const bool on_its_way = !scene.opened && scene.text == bodies.edited.text();
    if (scene.opened) not_shown.show_all();
    if (scene.opened)
        bodies.open(scene.text, is_model(scene.path) ? BodyEditor::TextKind::model
                                : is_pov(scene.path) ? BodyEditor::TextKind::povray
                                                     : BodyEditor::TextKind::scene);
    else
        reload(scene.text);
    handles.let_go();
    if (!on_its_way) awaited.reset();
    good = scene.text;
    bodies.take_lines(scene.lines, scene.text);
    if (bodies.edited.changed()) return show_anew();  // there may be other bodies than in the file
    bodies.look(*session.scene);
}

/// Takes the text that the file has now. Prints what was changed and is lost by that.
void BodyTools::reload(const std::string& text) {
    const std::vector<std::string> yours = bodies.edited.unwritten();
    if (!bodies.edited.reload(text)) return;
    notes.announce("the file has other numbers now, which replace yours");
    for (const std::string& line : yours) log_line("changed and not written, line " + line);
}

void BodyTools::click(const View& view, const glm::dvec2& point, double reach, bool adds) {
    pace.redraw(3);
    if (to_add) return add(view, point);
    if (to_focus) return focus_on(view, point);
    // Makes the marks of this view: those drawn may be of an earlier one, or not be there yet, right after a key.
    const auto mark = marks ? mark_at(light_marks(scene_seen(view), view), point, reach) : std::nullopt;
    if (mark)
        bodies.choose(*mark, *session.scene);
    else
        bodies.click(scene_seen(view), *session.scene, view, point.x, point.y, hidden(), adds);
    log_choice();
    if (bodies.any() && view.camera.projection != Projection::orthographic && !in_perspective(view.camera))
        notes.note("handles are there in perspective and orthographic views of one eye only");
}

void BodyTools::log_drawn() {
    for (const std::string& line : std::exchange(to_log, {})) notes.log(line);
}

void BodyTools::log_choice() {
    if (!bodies.any()) return;
    const BodyText& text = bodies.body();
    const std::string number = std::to_string(bodies.number() + 1);
    const std::size_t count = bodies.bodies().size();
    to_log.push_back("chosen: " +
                     (bodies.block()   ? bodies.name()
                      : bodies.light() ? "light " + number
                                       : "body " + number) +
                     ", " + text.kind + (text.line > 0 ? ", line " + std::to_string(text.line) : "") +
                     (count > 1 ? ", the last of " + std::to_string(count) + " bodies" : ""));
}

void BodyTools::choose_camera() {
    bodies.choose(TopBlock::camera, *session.scene);
    log_choice();
    pace.redraw(3);
}

void BodyTools::apply(const BodyInput& input) {
    if (!input.refused.empty()) notes.note(input.refused);
    if (input.close) bodies.close(), pace.redraw();
    if (input.allow) bodies.allow(*input.allow), pace.redraw();
    if (changing() || !bodies.any()) return;
    const auto& values = bodies.body().values;
    bool changed = false;
    if (const auto& change = input.change)
        changed = bodies.change(values[change->value], change->numbers, session.edits, change->merged);
    if (input.own) changed = bodies.make_own(values[*input.own], session.edits);
    if (changed) show();
    if (input.track) follow_track(*input.track);
    if (input.preset) give_material(*input.preset);
    if (input.place) place(*input.place);
    if (input.free)
        change_text(without_tracks(bodies.edited.text(), values[*input.free]),
                    values[*input.free].name + " of " + bodies.name() + " follows no track");
}

/// Gives all bodies chosen a material, if they have a place for one of their own.
void BodyTools::give_material(const MaterialPreset& preset) {
    std::string text = bodies.edited.text();
    const std::string before = text;
    const std::vector<int> all = bodies.bodies();
    // From the last to the first: what is known of those before stays right.
    for (auto i = all.rbegin(); i != all.rend(); ++i) {
        const BodyText body =
            body_text(before, *session.scene, *i, *i == bodies.number() ? bodies.choice()->at.hit.leaf : 0);
        if (!body.material) continue;
        const Box box = world_bounds(session.scene->primitives[std::size_t(*i)]);
        const double size = box.finite() ? round_length(length(box.high - box.low) / 2) : 1;
        text = with_material(text, body, preset, size);
    }
    change_text(text, bodies.names() + " of " + preset.name);
}

/// Moves, turns or scales the bodies chosen by numbers.
void BodyTools::place(const BodyInput::NewPlace& place) {
    const std::vector<int> all = bodies.bodies();
    if (!place.merged || !placed) placed = PlacedBodies::find(bodies.edited.text(), *session.scene, all);
    if (!placed) return notes.note("the text does not say where this body is");
    if (!place.merged) {
        const Box box = bounds_of(*session.scene, all);
        placed_about = box.finite() ? box.centre() : bodies.choice()->point;
    }
    Placing placing = place.placing;
    if (auto* const turn = std::get_if<TurnBy>(&placing)) turn->about = placed_about;
    if (auto* const scale = std::get_if<ScaleBy>(&placing)) scale->about = placed_about;
    const char* const what = std::holds_alternative<MoveBy>(placing)   ? " moved"
                             : std::holds_alternative<TurnBy>(placing) ? " turned"
                                                                       : " scaled";
    constexpr int decimals = 6;  // of numbers that a person types
    if (bodies.edited.change(placed->text(placing, decimals), {session.edits, bodies.names() + what, place.merged}))
        show();
}

/// Has a number follow a track. One without keys gets the number as its first key. False if the name cannot be one.
bool BodyTools::follow_track(const BodyInput::NewTrack& track) {
    const BodyValue& value = bodies.body().values[track.value];
    if (track.name.empty() || track.name.size() > 255 || track.name.find_first_of("\"\n\r") != std::string::npos)
        return notes.fail("the name of a track has 1 to 255 characters, and no quotes"), false;
    const double number = value.numbers[std::size_t(std::max(track.component, 0))];
    change_text(with_track(bodies.edited.text(), value, track.component, track.name),
                value.name + " of " + bodies.name() + " follows the track " + track.name);
    if (session.track_keys.track(track.name).keys.empty() && !session.keys_elsewhere)
        session.change_track({track.name, {{0, number, Interpolation::linear}}}, false, pace.now());
    notes.announce("follows the track " + track.name + ", whose keys are on the timeline");
    return true;
}

bool BodyTools::change_text(const std::string& newer, const std::string& what, bool merged) {
    if (bodies.read_only()) return notes.note("the text of this scene is changed in an editor"), false;
    bodies.edited.change(newer, {session.edits, what, merged});
    show_anew();
    return true;
}

void BodyTools::apply(const OutlinerInput& input) {
    if (const auto& row = input.choose; row && !changing()) {
        if (row->what == TopBlock::light) {
            if (!marks) marks.emplace();
            bodies.choose({row->number, false}, *session.scene);
        } else if (row->what == TopBlock::body) {
            const Box box = world_bounds(session.scene->primitives[std::size_t(row->number)]);
            const DVec3 middle = box.finite() ? box.centre() : session.camera.look_at;
            if (input.adds)
                bodies.add(row->number, middle, *session.scene);
            else
                bodies.choose(row->number, middle, *session.scene, row->leaf);
        } else {
            bodies.choose(row->what, *session.scene);
        }
        log_choice();
    }
    if (!input.choose && !input.hide && !input.alone && !input.show_all) return;
    pace.redraw(3);
    not_shown.apply(input, session.scene);
}

/// Shows the text as it is now, in which bodies and lights have the numbers that they had.
void BodyTools::show() {
    bodies.look(*session.scene);
    file.show(bodies.edited.text(), changed_body());
    pace.redraw(3);
}

/// Returns the body chosen, if the text of the scene on the screen differs from that to be shown in its block only.
std::optional<ChangedBody> BodyTools::changed_body() const {
    const BodyText& body = bodies.body();
    const std::string& text = bodies.edited.text();
    if (!bodies.choice() || body.block_end == 0) return std::nullopt;
    const std::size_t begin = body.block_begin, behind = text.size() - body.block_end;
    if (good.size() <= begin + behind || good.compare(0, begin, text, 0, begin) != 0 ||
        good.compare(good.size() - behind, behind, text, body.block_end, behind) != 0)
        return std::nullopt;
    return ChangedBody{session.scene, bodies.number(), body.context, text.substr(begin, body.block_end - begin)};
}

/// Shows a text in which there may be more bodies and lights, or fewer. `next` is what to choose then.
void BodyTools::show_anew(std::optional<NextChoice> next, bool undone) {
    handles.let_go();
    awaited = {std::move(next), undone, awaited ? awaited->later : std::nullopt};
    file.show(bodies.edited.text());
    pace.redraw(3);
}

bool BodyTools::undo(bool back) {
    if (bodies.edited.next_step(back, session.edits) <= session.next_step(back)) return false;
    const auto what = bodies.edited.undo(back, session.edits);
    notes.note((back ? "undone: " : "redone: ") + what.value_or(""));
    show_anew({}, true);
    return true;
}

void BodyTools::begin_adding(const NewBlock& block) {
    pace.redraw(3);
    if (bodies.read_only()) return notes.note("the text of this scene is changed in an editor");
    end_adding(), to_add = &block, bodies.close();
}

void BodyTools::begin_focusing() {
    pace.redraw(3);
    if (bodies.read_only() && session.bound()) return notes.note("the flight has the camera: its lens is the file's");
    if (session.camera.projection > Projection::orthographic)
        return notes.note("only perspective and orthographic cameras have a lens");
    end_adding(), to_focus = true;
    notes.log("a click chooses what is sharp");
}

bool BodyTools::end_adding() {
    pace.redraw();
    return std::exchange(to_add, nullptr) || std::exchange(to_focus, false);
}

/// Adds what the user has chosen from the list at a point of the view's picture.
void BodyTools::add(const View& view, const glm::dvec2& point) {
    if (awaited) return;
    const NewBlock& block = *std::exchange(to_add, nullptr);
    const bool light = block.what == TopBlock::light;
    const StandingPlace place = standing_place(scene_seen(view), view, point.x, point.y, hidden());
    const int count = static_cast<int>(light ? session.scene->lights.size() : session.scene->primitives.size());
    bodies.edited.change(
        with_new_block(bodies.edited.text(), block, count, place.point, place.normal, place.size, place.decimals),
        {session.edits, std::string(block.name) + " added"});
    if (light && !marks) marks.emplace();
    notes.announce(std::string(block.name) + " added: drag its handles; " + notes.key(Action::write_path) +
                   " writes it into the file");
    show_anew(NextChoice{block.what, {count}, place.point});
}

/// Brings the point of the view's picture into focus. A camera without a lens gets one, by which what is twice as far
/// is blurred over about a thirtieth of the picture's width. Where the text is read only, the window's camera alone
/// gets it.
void BodyTools::focus_on(const View& view, const glm::dvec2& point) {
    if (awaited) return;
    to_focus = false;
    const StandingPlace place = standing_place(scene_seen(view), view, point.x, point.y, hidden());
    DVec3 sharp;
    for (int i = 0; i < 3; ++i) sharp[i] = rounded(place.point[i], 0, place.decimals);
    Camera camera = view.camera;
    camera.focus_on = sharp;
    const double width = 2 * frame_of(camera, double(view.width) / view.height).tan_x;
    const double across = camera.projection == Projection::orthographic ? width : width * focal_distance(camera);
    const double aperture = round_length(across / 30);
    if (bodies.read_only()) {
        if (!has_lens(camera)) camera.aperture = aperture;
        session.camera.aperture = camera.aperture;
        session.camera.focus.reset(), session.camera.focus_on = sharp;
        return notes.announce("in focus: " + text_of(sharp));
    }
    const auto newer = with_focus_on(bodies.edited.text(), sharp, aperture);
    if (!newer) return notes.note("the lens of this scene is changed in its text");
    if (change_text(*newer, "focus of the camera")) notes.announce("in focus: " + text_of(sharp));
}

/// Chooses the body or the light that was copied or added.
void BodyTools::choose(const NextChoice& chosen) {
    const bool light = chosen.what == TopBlock::light;
    const std::size_t count = light ? session.scene->lights.size() : session.scene->primitives.size();
    const int last = chosen.numbers.back();
    if (std::size_t(last) >= count) return bodies.close();
    if (!chosen.added_at) return bodies.choose_next(chosen.numbers, *session.scene);
    if (light) return bodies.choose({last, false}, *session.scene);
    bodies.choose(last, *chosen.added_at, *session.scene);
}

void BodyTools::note_editor() {
    notes.note("the text of this scene is changed in an editor: " + notes.key(Action::open_text) + " opens it");
}

bool BodyTools::copy() { return change_block(true); }
bool BodyTools::remove() {
    for (const int body : bodies.bodies())
        if (hidden().contains(body)) return notes.note("this body is hidden: show it before you remove it"), true;
    return change_block(false);
}

bool BodyTools::step_back() {
    if (end_adding()) return true;
    if (bodies.any()) return bodies.close(), true;
    if (marks) return toggle_lights(), true;
    return false;
}

/// Copies or removes what is chosen. False if nothing is chosen.
bool BodyTools::change_block(bool copies) {
    if (!bodies.any()) return false;
    if (awaited) return awaited->later = copies, true;
    if (bodies.block()) return notes.note("every scene has a camera and a background"), true;
    if (bodies.read_only()) return note_editor(), true;
    const bool light = bodies.light().has_value();
    std::vector<int> numbers = light ? std::vector{bodies.number()} : bodies.bodies();
    const std::string name =
        numbers.size() > 1 ? bodies.names() : (light ? "light " : "body ") + std::to_string(bodies.number() + 1);
    const TopBlock what = light ? TopBlock::light : TopBlock::body;
    std::string text = bodies.edited.text();
    // From the last to the first: the numbers of those before stay.
    for (auto i = numbers.rbegin(); i != numbers.rend(); ++i) {
        std::string newer = copies ? with_copy(text, what, *i) : without_block(text, what, *i);
        if (newer == text) return note_editor(), true;
        text = std::move(newer);
    }
    bodies.edited.change(text, {session.edits, name + (copies ? " copied" : " removed")});
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] += static_cast<int>(i) + 1;
    notes.announce(copies ? name + " copied; the copy is in the same place: drag its handles"
                          : name + " removed; " + notes.key(Action::undo) + " brings it back");
    show_anew(copies ? std::optional(NextChoice{what, std::move(numbers)}) : std::nullopt);
    return true;
}

void BodyTools::toggle_lights() {
    pace.redraw();
    if (!marks) return marks.emplace(), notes.note("lights are shown: click their marks");
    marks.reset();
    if (bodies.light()) bodies.close();
    notes.note("lights are hidden");
}

void BodyTools::change_handles(std::optional<HandleMode> mode) {
    pace.redraw();
    if (!bodies.choice() && !bodies.light())
        return notes.note("click a body first; its handles then move, turn or scale it");
    if (bodies.read_only()) return note_editor();
    notes.note(handles.change_mode(mode));
}

void BodyTools::approach(const View& view) {
    if (!bodies.choice() || awaited)
        return notes.note("click a body first; " + notes.key(Action::approach) + " then moves the camera to it");
    const Box box = bounds_of(scene_seen(view), bodies.bodies());
    if (!std::isfinite(length(box.high - box.low))) return notes.note("this body has no end");
    notes.tell(session.steer({}, pace.now()));
    session.camera = approached(session.camera, box, double(view.width) / view.height);
}

std::string BodyTools::file_name() const {
    return bodies.file().empty() ? file.name() : std::filesystem::path(bodies.file()).filename().string();
}

void BodyTools::open_text() {
    if (!bodies.any())
        return notes.note("click a body first; " + notes.key(Action::open_text) +
                          " then opens its line in your editor");
    if (bodies.body().line == 0 || file.path() == "-") return notes.note("no line of a file is known for it");
    const std::string fault = open_in_editor(bodies.file().empty() ? file.path() : bodies.file(), bodies.body().line);
    if (!fault.empty()) notes.fail(fault);
}

void BodyTools::open_text(const Message& message) {
    if (message.line == 0) return;
    const std::string fault = open_in_editor(message.file, static_cast<int>(message.line));
    if (!fault.empty()) notes.fail(fault);
}

/// Takes over the scene of a changed text once it is read.
void BodyTools::take_shown() {
    auto shown = file.take_shown();
    if (!shown) return;
    const bool newest = shown->text == bodies.edited.text(), right = shown->scene != nullptr;
    if (right) {
        // A text that was read before the path was written would bring the old path back; the next one follows.
        if (shown->scene->flythrough == session.scene->flythrough) {
            const bool other_bodies = shown->scene->primitives.size() != session.scene->primitives.size() ||
                                      shown->scene->lights.size() != session.scene->lights.size();
            session.replace(std::move(shown->scene), false);
            good = shown->text;
            bodies.take_lines(std::move(shown->lines), good);
            if (other_bodies && !(awaited && awaited->next)) bodies.close();
        }
    } else if (newest) {
        notes.fail(shown->fault.substr(0, shown->fault.find('\n')));
        bodies.edited.change(good, {session.edits, "change with an error", true});
        handles.let_go();
    }
    Awaited due;
    if (newest) {
        to_log.emplace_back("the changed text is shown");
        due = std::exchange(awaited, std::nullopt).value_or(Awaited());
        if (due.undone) bodies.find_point(*session.scene);
        if (due.next && right) choose(*due.next), log_choice();
    }
    if (!awaited) bodies.look(*session.scene);
    if (due.later) change_block(*due.later);
    pace.redraw();
}

void BodyTools::follow(const View& view, double scale) {
    take_shown();
    drag_on(view);
    if (marks) marks = light_marks(scene_seen(view), view);
    handles.hide();
    if ((bodies.choice() || bodies.light()) && !bodies.read_only() && !awaited)
        handles.place(scene_seen(view), view, scale);
    if (!bodies.choice())
        silhouette.drop();
    else if (!pace.moving() && !awaited)
        silhouette.want(session.scene, bodies.bodies(), view);
    if (silhouette.take()) pace.redraw();
}

void BodyTools::hold(const glm::dvec2& point, double reach) {
    if (!points_at(point, reach) || awaited) return;
    if (const std::string why = handles.hold(point); !why.empty()) notes.note(why);
}

void BodyTools::let_go(const View& view) {
    drag_on(view);
    handles.let_go();
    pace.redraw();
}

/// Shows what the drag has changed up to now.
void BodyTools::drag_on(const View& view) {
    if (handles.held() && handles.change_text(scene_seen(view), hidden())) show();
}

Overlay::Tools BodyTools::drawn() const {
    Overlay::Tools tools;
    if (marks) tools.marks = *marks;
    tools.chosen = bodies.light();
    handles.draw(tools);
    return tools;
}

}  // namespace strahl
