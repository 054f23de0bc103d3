#include "show/viewer.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "scene/moving_scene.h"
#include "show/info.h"
#include "show/welcome/help_panel.h"
#include "text/camera_text.h"
#include "text/music_text.h"
#include "text/reading/tracks_file.h"
#include "text/write.h"

namespace strahl {
namespace {

constexpr double signal_interval = 0.2;  // seconds until a signal is noticed
constexpr double panels_alone = 0.5;     // seconds from the start on until panels are drawn without a picture

std::string window_title(const std::string& path, const KeyMap& keys) {
    const std::string help = " (" + keys.first_key(Action::help) + ": help)";
    if (path.empty()) return "strahl" + help;
    const std::string name = path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
    return name + " - strahl" + help;
}

std::string whole_seconds(double seconds) { return std::to_string(static_cast<int>(seconds)) + " s"; }

PictureSize window_size(const ViewOptions& options, const Scene& scene) {
    return options.size.value_or(first_window_size(scene.camera.aspectratio.value_or(4. / 3)));
}

/// The first scene; or an empty one, until there is one without an error.
std::shared_ptr<const Scene> scene_to_show(const Loaded& loaded) {
    if (loaded.scene) return loaded.scene;
    Scene empty;
    empty.camera.look_at = {0, 1, 0};
    return std::make_shared<const Scene>(std::move(empty));
}

}  // namespace

Viewer::Viewer(const ViewOptions& o, const Loaded& first, std::unique_ptr<Reload>& reload,
               Pace::Clock::time_point began)
    : options(o),
      pace(began, o.fps),
      notes(pace, o.verbose, keys.keys),
      session(scene_to_show(first), o.depth),
      screen(window_title(first.path, keys.keys), window_size(o, *session.scene), !o.size, o.full_screen, !o.benchmark),
      panels(pace, o.play, o.scene.empty()),
      input(screen, session, panels, pace, keys.keys, o.play, *this),
      picture(o.threads, notes, pace, glfwPostEmptyEvent),
      recordings(options, notes, pace, glfwPostEmptyEvent),
      file(first, error_is_final(o), std::move(reload), notes, pace, glfwPostEmptyEvent),
      bodies(session, file, notes, pace, glfwPostEmptyEvent),
      side(o.threads, notes, pace, glfwPostEmptyEvent),
      chooser(o.threads, file, panels, notes, pace, glfwPostEmptyEvent,
              [this](std::function<void()> go) { leave(std::move(go)); }),
      playback(options, session, notes, pace, glfwPostEmptyEvent) {
    pace.motion.keeps_all = options.benchmark;
    if (!keys.faults.empty()) notes.fail(keys.faults);
    session.editor.words = first.words, session.exposure = o.exposure;
    session.keys = keys.keys;
    session.keys_elsewhere = playback.tracks.wanted();
    if (first.scene) session.take_tracks(first.tracks, true);
    for (const std::string& warning : first.warnings) notes.announce(warning);
    if (first.scene) bodies.loaded(first), side.loaded(first), chooser.opened(first.path);
    if (!file.waiting()) playback.start_scene();
}

bool Viewer::browse(int key) {
    if (leaving.asking()) {
        const Leaving::Decision given = Leaving::answer_of(key);
        return answer(given), given != Leaving::Decision::none;
    }
    if (key != GLFW_KEY_ESCAPE || file.waiting()) return chooser.key(key);
    return perform({Action::gallery}), true;
}

void Viewer::turn_wheel(double notches, bool with_control) {
    notes.tell(session.turn_wheel(notches, with_control, pace.now()));
}

void Viewer::drop(const std::string& path) {
    const bool sound = !panels.gallery && std::filesystem::path(path).extension() == ".ogg";
    sound ? take_sound(path) : chooser.open(path);
}

void Viewer::hold(glm::dvec2 point) { bodies.hold(in_picture(point), screen.pixels_to_reach()); }

void Viewer::pull(Hold what, glm::dvec2 point, Snap snap) {
    what == Hold::divider ? side.pull(screen.area(), point.x) : bodies.pull(in_picture(point), snap);
}

void Viewer::let_go() { bodies.let_go(session.view(std::max(screen.width(), 1), std::max(screen.height(), 1))); }

void Viewer::perform(Command command) {
    if (leaving.asking())
        return answer(command.action == Action::write_path ? Leaving::Decision::write
                      : command.action == Action::save_as  ? Leaving::Decision::save_as
                                                           : Leaving::Decision::none);
    const bool playing = command.action == Action::quit || command.action == Action::back ||
                         command.action == Action::full_screen ||
                         (command.action == Action::pause && !options.benchmark);
    if (options.play && !playing) return;
    const bool in_gallery = playing || command.action == Action::open_file || command.action == Action::help ||
                            command.action == Action::gallery;
    if (panels.gallery && !in_gallery) return;
    switch (command.action) {
        case Action::back:
            return back();
        case Action::quit:
            return quit();
        case Action::still:
            if (screen.width() == 0 || file.waiting()) return;  // an icon, or nothing to see
            return recordings.stills.add(session, file.path(), session.view(screen.width(), screen.height()),
                                         command.number == 1 ? ".png" : options.still_ending);
        case Action::film:
            if (screen.width() == 0 || file.waiting()) return;
            if (file.uses_clock())
                return notes.note("a scene that uses POV-Ray's clock is filmed by: strahl render SCENE -o FILM.mp4");
            return recordings.film.toggle(session, file.path(), screen.width(), screen.height());
        case Action::open_file:
            return chooser.ask();
        case Action::gallery:
            return chooser.toggle_gallery();
        case Action::write_path:
            return write();
        case Action::keep_view:
            return keep_view();
        case Action::save_as:
            if (!file.waiting()) chooser.ask_where_to_save();
            return;
        case Action::undo:
        case Action::redo:
            if (!bodies.undo(command.action == Action::undo)) notes.tell(session.perform(command, pace.now()));
            return;
        case Action::open_text:
            return bodies.open_text();
        case Action::handles:
            return bodies.change_handles(command.number == 0 ? std::nullopt
                                                             : std::optional(HandleMode(command.number - 1)));
        case Action::lights:
            return bodies.toggle_lights();
        case Action::edit_camera:
            if (!file.waiting()) bodies.choose_camera(), panels.prefer_body();
            return;
        case Action::focus:
            if (!file.waiting()) bodies.begin_focusing();
            return;
        case Action::add_block:
            if (!bodies.end_adding()) panels.toggle(command.action);
            return;
        case Action::copy_body:
            if (!bodies.copy()) notes.note("click a body first; " + notes.key(Action::copy_body) + " then copies it");
            return;
        case Action::delete_key:
            if (panels.delete_clicked_key() || (!panels.quiet && bodies.remove())) return;
            if (panels.timeline_shown()) return notes.tell(session.perform(command, pace.now()));
            return notes.note("nothing is chosen: click a body, or a key on the timeline");
        case Action::approach:
            if (screen.width() > 0) bodies.approach(session.view(screen.width(), screen.height()));
            return;
        case Action::second:
        case Action::difference:
            side.toggle(command);
            if (side.divider().other_view() && session.bound())
                notes.tell(session.perform({Action::outside}, pace.now()));
            return;
        case Action::stability:
            return picture.toggle_marks();
        case Action::full_screen:
            input.release_pointer();
            return screen.toggle_full_screen();
        default:
            if (!panels.toggle(command.action)) notes.tell(session.perform(command, pace.now()));
    }
}

/// Goes one step back: closes what was opened last, ends what is under way, and at last leaves.
void Viewer::back() {
    if (options.play || panels.gallery || ending) return quit();
    if (panels.step_back_from_popup() || bodies.end_adding()) return;
    if (session.recording()) return notes.tell(session.perform({Action::record}, pace.now()));
    if (!panels.quiet && (bodies.step_back() || panels.step_back())) return;
    if (side.divider().shown()) return side.toggle({Action::second, int(side.divider().second)});
    if (picture.marks().active()) return picture.toggle_marks();
    if (screen.full_screen()) return perform({Action::full_screen});
    if (session.outside) return notes.tell(session.perform({Action::outside}, pace.now()));
    if (session.flight.flying()) return notes.tell(session.end_flight(pace.now()));
    quit();
}

/// Writes what has changed into its files; of scenes that have none of the user's own, a copy.
void Viewer::write() {
    const bool of_tracks = session.track_keys.changed(), of_program = installed(file.path());
    if ((of_program || file.path() == "-") && unsaved()) {
        notes.announce(of_program ? "this scene belongs to the program and stays as it is: a copy is yours"
                                  : "this scene came from standard input: choose a file for it");
        return chooser.ask_where_to_save();
    }
    if (of_tracks) file.write(session.track_keys.changes());
    const bool of_scene = session.editor.changed() || bodies.editor().edited.changed();
    if (of_scene || !of_tracks) file.write(session.editor.path(), bodies.changes());
}

/// Makes the view the camera of the scene's text.
void Viewer::keep_view() {
    if (file.waiting()) return;
    const Keyframe view = key_of(session.camera, session.scene->camera, 0);
    const std::string& text = bodies.editor().edited.text();
    const bool fixed = bodies.editor().read_only() || !session.scene->camera_follows.empty();
    const auto newer = fixed ? std::nullopt : with_camera(text, view);
    if (!newer) return notes.note("the camera of this scene is changed in its text");
    if (bodies.change_text(*newer, "the scene's camera")) notes.note("this view is the scene's camera now");
}

/// Would changes be lost now?
bool Viewer::unsaved() const {
    return session.editor.changed() || bodies.editor().edited.changed() || session.track_keys.changed();
}

/// Calls the function once the scene may be left: at once, or after a question if changes are not written, or never.
void Viewer::leave(std::function<void()> go) {
    notes.tell(session.end_recording(pace.now()));
    if (options.play || file.waiting() || !unsaved()) return go();
    std::vector<std::string> list;
    const std::size_t count = session.editor.path().keys.size();
    if (session.editor.changed())
        list.push_back(count == 1 ? "the path's only key; it needs two"
                                  : "the path, of " + std::to_string(count) + " keys");
    for (const std::string& line : bodies.editor().edited.unwritten()) list.push_back("line " + line);
    for (const Track& track : session.track_keys.changes()) list.push_back("keys of the track " + track.name);
    leaving.ask(file.name(), std::move(list), std::move(go));
    notes.log(file.name() + " is not written: Enter writes it, D drops it, Esc stays");
    panels.asking = true;
    pace.redraw(3);
}

void Viewer::answer(Leaving::Decision given) {
    if (leaving.take(given)) write();
    if (given == Leaving::Decision::save_as) chooser.ask_where_to_save();
    panels.asking = leaving.asking();
    pace.redraw(3);
}

/// Makes a file the music of the scene, by its name relative to the scene's folder.
void Viewer::take_sound(const std::string& path) {
    Music music = session.scene->music;
    std::error_code error;
    const auto folder = std::filesystem::absolute(file.path(), error).parent_path();
    std::filesystem::path name = path;
    if (name.is_absolute()) name = name.lexically_proximate(folder);
    music.sound = name.generic_string();
    take_music(music, false);
}

void Viewer::take_music(const Music& music, bool merged) {
    if (music.sound.find_first_of("\"\n\r") != std::string::npos)
        return notes.fail("the name of the music has quotes in it: give the file another one");
    bodies.change_text(with_music(bodies.editor().edited.text(), music), "music", merged);
}

void Viewer::apply(const TimelineInput& done) {
    if (done.music) take_music(done.music->music, done.music->merged);
    if (const auto& change = done.motion) {
        using Change = TimelineInput::MotionChange;
        const std::string& text = bodies.editor().edited.text();
        const auto& [what, motion, key, seconds, merged] = *change;
        const std::string newer = what == Change::move  ? with_key_time(text, *session.scene, motion, key, seconds)
                                  : what == Change::add ? with_motion_key(text, *session.scene, motion, seconds)
                                                        : without_motion_key(text, motion, key);
        if (newer != text)
            bodies.change_text(newer, "keys of the motion of " + motion.name, merged),
                session.go_to(seconds, pace.now());
        else if (what == Change::remove && motion.times.size() == 2)
            notes.note("a motion has two keys at least");
        else if (what != Change::move)
            notes.note("this motion stands in a definition, and is changed in the text");
    }
    if (done.choose_sound) chooser.ask_for_sound();
    if (!done.refused.empty()) notes.note(done.refused);
    if (const auto& change = done.track) session.change_track(change->track, change->merged, pace.now());
    if (done.music || done.track || done.motion) pace.redraw(3);
    if (done.path) session.change_path(done.path->path, done.path->what, done.path->merged, pace.now());
    if (!done.command && !done.go_to && !done.change && !done.path) return;
    if (done.command && done.command->action == Action::delete_key)
        notes.tell(session.perform(*done.command, pace.now()));  // it deletes a key of the timeline, not the body
    else if (done.command)
        perform(*done.command);
    if (done.go_to) session.go_to(*done.go_to, pace.now());
    if (const auto& change = done.change)
        notes.tell(session.change_key(change->number, change->key, change->merged, pace.now()));
    pace.redraw(3);
}

void Viewer::apply(const BodyInput& done) {
    if (done.command) perform(*done.command);
    if (done.track) panels.prefer_timeline();
    bodies.apply(done);
}

void Viewer::apply(const OutlinerInput& done) {
    if (done.message) bodies.open_text(*done.message);
    if (done.choose) panels.forget_key(), panels.prefer_body();
    bodies.apply(done);
}

/// Chooses the body at a point of the window; with `adds` besides the others.
void Viewer::click(glm::dvec2 point, bool with_shift) {
    const double x = point.x, y = point.y;
    const ScreenArea area = screen.area();
    const bool on_picture = x >= area.x && y >= area.y && x < area.x + area.width && y < area.y + area.height;
    if (file.waiting() || screen.width() == 0 || !on_picture || in_other_view(x)) return;
    panels.forget_key(), panels.keep_clear(x), panels.prefer_body();
    const View view = session.view(screen.width(), screen.height());
    bodies.click(view, in_picture(point), 2 * screen.pixels_to_reach(), with_shift);
}

/// Is another view than that of the picture seen in this column of the window?
bool Viewer::in_other_view(double x) const {
    return side.divider().other_view() && x >= side.divider().column(screen.area());
}

Hold Viewer::points_at(glm::dvec2 point) {
    const ScreenArea area = screen.area();
    side.point((point.x - area.x) / std::max(area.width, 1), (point.y - area.y) / std::max(area.height, 1));
    if (side.divider().reached(area, point.x, point.y, screen.pixels_to_reach())) return Hold::divider;
    const bool handle =
        !panels.quiet && !in_other_view(point.x) && bodies.points_at(in_picture(point), screen.pixels_to_reach());
    return handle ? Hold::handle : Hold::nothing;
}

/// Returns the point of the picture at a point of the window, in pixels of the view.
glm::dvec2 Viewer::in_picture(glm::dvec2 point) const {
    const ScreenArea area = screen.area();
    const View view = session.view(std::max(screen.width(), 1), std::max(screen.height(), 1));
    return {(point.x - area.x) * view.width / area.width, (point.y - area.y) * view.height / area.height};
}

/// Moves the camera to where it should be now.
void Viewer::move() {
    if (!options.play) input.read_gamepad();
    const auto due = pace.move(in_motion(), picture.has_update());
    if (!due) return;
    if (due->first) session.observe(due->now - pace.frame_seconds());
    const CameraInput moved = input.take(due->passed);
    if (!(moved == CameraInput{})) notes.tell(session.steer(moved, due->now));
    if (const auto full = session.observe(due->now)) notes.tell(*full);
    if (const auto ended = session.follow(due->now))
        if (playback.flight_ended(*ended)) recordings.finish();
    if (in_motion()) return;
    pace.rest(), picture.rest();
    notes.log("rest after " + pace.motion.report(due->now) + playback.sound.report());
}

/// The time of the next drawing; infinite if there is nothing to draw.
double Viewer::next_draw() const {
    const double for_picture = pace.next_draw(picture.has_update(), playback.tracks.awaited() || picture.finished());
    const bool counting = recordings.under_way() || file.reading() || picture.seconds_built() > 0 || side.under_way();
    const double for_count = counting ? pace.last_draw() + 0.25 : Pace::forever;
    const double next = std::min({for_picture, for_count, notes.next_change(), file.next_change()});
    const bool awaited = picture.state().number == 0 && !picture.has_update() && !file.waiting() && !panels.gallery;
    return awaited ? std::max(next, panels_alone) : next;
}

/// Shows the first picture before what is drawn on it, for which a font and shaders have to be made.
void Viewer::show_first_picture() {
    screen.draw_picture();
    char text[80];
    std::snprintf(text, sizeof text, "first picture after %.3f s, %s", pace.now(),
                  resolution_text(picture.state().level).c_str());
    notes.log(text);
}

void Viewer::draw() {
    const double began = pace.now();
    const bool notes_gone = notes.expire();
    file.expire();
    panels.toolbar_rests = pace.moving() && input.pointer_rests();
    const std::uint64_t before = picture.state().number;
    const bool update = picture.take([this](const Fresh& fresh) {
        screen.upload(fresh);
        side.keep(fresh);
        if (options.benchmark) recordings.keep_flown(fresh, session);
    });
    if (update && before == 0) show_first_picture();
    screen.show_second(side.image(), side.divider().second_area(screen.area()), side.divider().other_view());
    panels.arrange(bodies.editor());
    const Overlay over = overlay();
    TimelineInput done;
    BodyInput on_body;
    const NewBlock* added = nullptr;
    std::optional<Command> on_toolbar;
    OutlinerInput on_outline;
    std::optional<GalleryItem> from_gallery;
    Leaving::Decision answered = Leaving::Decision::none;
    screen.draw([&] {
        draw_overlay(over);
        if (leaving.asking()) answered = leaving.draw(keys.keys);
        if (panels.help_shown()) return draw_help(keys.keys, panels.sought());
        if (panels.gallery) return void(from_gallery = chooser.draw_gallery(keys.keys));
        on_toolbar = panels.draw_toolbar(keys.keys, toolbar());
        done = panels.draw_timeline(session, playback.sound.peaks(), !bodies.editor().read_only(),
                                    side.divider().other_view());
        on_body = panels.draw_body(bodies.editor(), bodies.file_name());
        added = panels.draw_add();
        if (!file.waiting())
            on_outline = panels.draw_outline(session, bodies.editor(), bodies.hidden(), file.messages());
    });
    input.release_keys();
    bodies.log_drawn();
    if (notes_gone) notes.log("notes have disappeared");
    pace.drawn(began);
    const Refinement& state = picture.state();
    if (pace.moving() && state.number != before) {
        playback.sound.picture_shown(session, state.view.time);
        pace.motion.picture(shown_picture(pace.now(), state.level, state.view.width, state.view.height));
    }
    if (state.number > 0) playback.picture_shown();
    apply(done), apply(on_body), apply(on_outline);
    if (on_toolbar) perform(*on_toolbar);
    if (added) bodies.begin_adding(*added);
    if (from_gallery && !leaving.asking()) chooser.take(*from_gallery);
    if (answered != Leaving::Decision::none) answer(answered);
    if (update && picture.newest()) playback.tracks.shown();
}

/// Waits for events, and processes them.
void Viewer::wait() {
    double until = next_draw();
    if (pace.moving() || in_motion()) until = std::min(until, pace.next_move());
    // A gamepad has no events.
    const double left = std::min(until - pace.now(), gamepad() ? pace.frame_seconds() : signal_interval);
    if (left > 0)
        glfwWaitEventsTimeout(left);
    else
        glfwPollEvents();
}

/// Shows a scene that was read meanwhile.
void Viewer::take_scene() {
    const bool first = file.waiting();
    const auto loaded = file.take();
    if (!loaded) return;
    if (first || loaded->opened || loaded->renamed) chooser.opened(loaded->path);
    if (loaded->moved) {
        session.replace_reread(loaded->scene, loaded->picture);
        return bodies.loaded(*loaded), side.loaded(*loaded);
    }
    if (loaded->opened && !first) print_paths();
    const std::vector<std::string> unfollowed = first ? std::vector<std::string>() : unfollowed_tracks(*session.scene);
    if (session.replace(loaded->scene, loaded->opened || first, loaded->picture))
        notes.announce("the file has another path now, which replaces yours; " + notes.key(Action::undo) +
                       " brings yours back");
    take_tracks(loaded->tracks, loaded->opened || first);
    for (const std::string& warning : loaded->warnings) notes.announce(warning);
    session.editor.words = loaded->words;
    bodies.loaded(*loaded), side.loaded(*loaded);
    if (first || (options.play && loaded->opened))
        playback.start_scene();
    else
        playback.scene_changed(unfollowed);
    if (session.flight.paused()) session.follow(pace.now());
    if (loaded->opened || loaded->renamed)
        glfwSetWindowTitle(screen.window(), window_title(file.path(), keys.keys).c_str());
}

/// Takes the text that the file of tracks has now.
void Viewer::take_tracks(const std::string& text, bool opened) {
    const std::vector<std::string> yours = session.track_keys.unwritten();
    if (!session.take_tracks(text, opened)) return;
    notes.announce("the file has other keys of tracks now, which replace yours");
    for (const std::string& line : yours) log_line("keys of tracks that were not written, line " + line);
}

/// Says what the user waits for, if that takes long; else "".
std::string Viewer::work_under_way() const {
    if (file.reading()) return "reading " + file.name() + ", " + whole_seconds(pace.now());
    const double seconds = picture.seconds_built();
    if (seconds < 0.5) return "";
    return "building the scene, " + whole_seconds(seconds);
}

ToolbarView Viewer::toolbar() const {
    const BodyEditor& editor = bodies.editor();
    return {.handles = editor.choice() || editor.light() ? std::optional(bodies.handle_mode()) : std::nullopt,
            .lights = bodies.lights_shown(),
            .camera = editor.block() == TopBlock::camera,
            .playing = session.flight.under_way(),
            .recording = session.recording(),
            .unsaved = unsaved()};
}

Overlay Viewer::overlay() const {
    const Refinement& state = picture.state();
    const StabilityCheck& check = picture.marks();
    Overlay overlay;
    overlay.marks = check.found(), overlay.width = state.view.width, overlay.height = state.view.height;
    overlay.area = screen.area();
    const std::string work = work_under_way();
    if (side.divider().shown()) overlay.sides = side.sides(overlay.area);
    if (panels.quiet && overlay.sides) overlay.sides->left = overlay.sides->right = "";
    if (!work.empty() && (!panels.quiet || state.number == 0)) overlay.notes.push_back({work});
    if (panels.quiet) return overlay;
    overlay.reserved = panels.reserved(), overlay.reserved_left = panels.reserved_left();
    overlay.reserved_right = panels.reserved_right(), overlay.reserved_top = panels.reserved_top();
    if (!pace.moving()) overlay.silhouette = bodies.lines();
    overlay.tools = bodies.drawn();
    if (panels.timeline_shown() && !session.bound() && screen.width() > 0)
        overlay.path = path_marks(session.editor.path(), session.scene->camera,
                                  session.flight.flying() ? std::optional(session.time) : std::nullopt,
                                  session.view(screen.width(), screen.height()));
    overlay.share = state.share, overlay.notes_below = panels.gallery;
    overlay.fault = file.fault(), overlay.fault_title = file.fault_title();
    overlay.quiet_key = notes.key(Action::quiet);
    if (panels.info_shown()) overlay.info = info_lines(session, pace, picture);
    if (session.recording()) overlay.notes.push_back({"recording; " + notes.key(Action::record) + " ends it"});
    if (bodies.focusing())
        overlay.notes.push_back({"click what is to be sharp; " + notes.key(Action::back) + " ends this"});
    if (bodies.adding())
        overlay.notes.push_back({std::string("click where the ") + bodies.adding() + " is to stand; " +
                                 notes.key(Action::back) + " ends this"});
    overlay.notes.insert(overlay.notes.end(), notes.shown().begin(), notes.shown().end());
    overlay.bars = recordings.bars();
    if (check.under_way()) overlay.bars.push_back({"checking rounding", check.progress()});
    return overlay;
}

int Viewer::run(const std::atomic<bool>& interrupted) {
    bool signalled = false, done = false;
    while (!done) {
        playback.follow_sound(file.path());
        move();
        if (screen.width() > 0) file.move_to({session.time, screen.width(), screen.height()});
        if (!file.waiting() && !panels.gallery && screen.width() > 0) {
            const View view = session.view(screen.width(), screen.height());
            bodies.follow(view, screen.pixels_to_reach() / 6);
            picture.order(session, bodies.scene_shown(), screen.width(), screen.height());
            side.follow(session, view, !pace.moving() && picture.finished());
        }
        if (pace.now() >= next_draw()) draw();
        picture.log_finished();
        input.hide_pointer();
        wait();
        while (const auto written = file.tell_written())  // before the scene is taken that the file has now
            if (written->tracks) take_tracks(*written->tracks, false);
        take_scene();
        leaving.follow(unsaved());
        panels.asking = leaving.asking();
        picture.tell_marks();
        const auto [music, copy] = chooser.take(screen);
        if (!music.empty()) take_sound(music);
        if (!copy.empty())
            file.write_as(copy, bodies.editor().edited.text(), session.editor.path(), session.track_keys.changes());
        if (playback.tracks.follow()) save_editors_tracks();
        // A signal ends the window as Esc does; the next one ends the program at once.
        if (interrupted && !std::exchange(signalled, true)) {
            log_line("interrupted");
            recordings.finish();
        }
        done = recordings.tell_done();
    }
    end(interrupted);
    return recordings.failed() ? 1 : 0;
}

/// Ends the program as soon as all stills and the film are done. Asks first if something is not written.
void Viewer::quit() {
    leave([this] {
        ending = true;
        recordings.finish();
    });
}

/// Saves the tracks of the GNU Rocket editor, which asks for it.
void Viewer::save_editors_tracks() {
    if (installed(file.path()))
        return notes.fail("this scene belongs to the program and stays as it is; " + notes.key(Action::save_as) +
                          " makes a copy that is yours");
    file.write(*session.tracks);
}

/// Prints the paths that would be lost now.
void Viewer::print_paths() {
    notes.tell(session.end_recording(pace.now()));
    for (const Flythrough& path : session.editor.unwritten()) {
        log_line("a path that was not written into the file:");
        std::fputs(write_flythrough(path, session.editor.words).c_str(), stdout), std::fflush(stdout);
    }
    for (const std::string& line : bodies.editor().edited.unwritten())
        log_line("changed and not written, line " + line);
    for (const std::string& line : session.track_keys.unwritten())
        log_line("keys of tracks that were not written, line " + line);
}

void Viewer::end(const std::atomic<bool>& interrupted) {
    while (file.tell_written()) {
    }
    print_paths();
    if (!options.play) chooser.remember();
    if (!options.size && !options.play) screen.remember();
    screen.hide();
    if (options.benchmark)
        recordings.report_benchmark({.scene = file.path(),
                                     .precision = name(Precision::float32),
                                     .simd = name(best_simd()),
                                     .width = picture.state().view.width,
                                     .height = picture.state().view.height,
                                     .window = {screen.width(), screen.height()},
                                     .wanted = options.size,
                                     .depth = session.depth(),
                                     .threads = picture.threads(),
                                     .fps = options.fps,
                                     .draw_seconds = pace.motion.draw_seconds()},
                                    session.exposure, interrupted);
    notes.log("quit");
}

}  // namespace strahl
