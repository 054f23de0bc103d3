#include "show/viewer.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "files/output_file.h"
#include "show/info.h"
#include "text/write.h"

namespace strahl {
namespace {

constexpr double signal_interval = 0.2;  // seconds until a signal is noticed

std::string window_title(const std::string& path) {
    const std::string name = path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
    return name + " - strahl (H: help)";
}

PixelSize window_size(const ViewOptions& options, const Scene& scene) {
    if (options.size.width > 0) return options.size;
    constexpr int width = 960;
    const double height = width / scene.camera.aspectratio.value_or(4. / 3);
    return {width, static_cast<int>(std::lround(std::clamp(height, 240., 960.)))};
}

/// The first scene; or an empty one, until there is one without an error.
std::shared_ptr<const Scene> scene_to_show(const Loaded& loaded) {
    if (loaded.scene) return loaded.scene;
    Scene empty;
    empty.camera.look_at = {0, 1, 0};
    return std::make_shared<const Scene>(std::move(empty));
}

}  // namespace

Viewer::Viewer(const ViewOptions& o, const Loaded& first, std::string text, Pace::Clock::time_point began,
               std::unique_ptr<Rocket> rocket)
    : options(o),
      pace(began, o.fps),
      notes(pace, o.verbose),
      session(scene_to_show(first), o.depth),
      screen(window_title(first.path), window_size(o, *session.scene), o.size.width == 0, o.full_screen),
      panels(pace, o.play),
      input(screen, session, panels, pace, o.play,
            {.perform = [this](Command command) { perform(command); },
             .turn_wheel = [this](double n) { notes.tell(session.change_speed(std::pow(1.25, n), pace.now())); },
             .drop = [this](std::string path) { file.open(std::move(path)); }}),
      picture(o.threads, notes, pace, glfwPostEmptyEvent),
      stills(options, notes, pace, glfwPostEmptyEvent),
      file(first, std::move(text), notes, pace, glfwPostEmptyEvent),
      tracks(std::move(rocket), session, notes, pace, glfwPostEmptyEvent),
      sound(pace) {
    if (!file.waiting()) start_scene();
}

void Viewer::perform(Command command) {
    const bool playing = command.action == Action::quit || command.action == Action::full_screen ||
                         (command.action == Action::pause && !options.benchmark);
    if (options.play && !playing) return;
    switch (command.action) {
        case Action::quit:
            return stills.finish();
        case Action::still:
            if (screen.width() == 0) return;  // an icon
            return stills.add(session, file.path(), session.view(screen.width(), screen.height()));
        case Action::write_path:
            return file.write(session.editor.path());
        case Action::stability:
            return picture.toggle_marks();
        case Action::full_screen:
            input.release_pointer();
            return screen.toggle_full_screen();
        case Action::help:
        case Action::info:
        case Action::quiet:
        case Action::timeline:
            return panels.toggle(command.action);
        default:
            notes.tell(session.perform(command, pace.now()));
    }
}

void Viewer::apply(const TimelineInput& done) {
    if (!done.command && !done.go_to && !done.change) return;
    if (done.command) perform(*done.command);
    if (done.go_to) session.go_to(*done.go_to, pace.now());
    if (const auto& change = done.change)
        notes.tell(session.change_key(change->number, change->key, change->merged, pace.now()));
    pace.redraw(3);
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
    if (const auto ended = session.follow(due->now)) flight_ended(*ended);
    if (in_motion()) return;
    pace.rest(), picture.rest();
    notes.log("rest after " + pace.motion.report(due->now) + sound.report());
}

/// The time of the next drawing; infinite if there is nothing to draw.
double Viewer::next_draw() const {
    const double for_picture = pace.next_draw(picture.has_update(), tracks.awaited() || picture.finished());
    const double for_still = stills.progress_text().empty() ? Pace::forever : pace.last_draw() + 0.25;
    return std::min({for_picture, for_still, notes.next_change(), file.next_change()});
}

void Viewer::draw() {
    const double began = pace.now();
    if (began < next_draw()) return;
    notes.expire(), file.expire();
    const std::uint64_t before = picture.state().number;
    const bool update = picture.take([this](const Fresh& fresh) { screen.upload(fresh); });
    const Overlay over = overlay();
    TimelineInput done;
    screen.draw([&] {
        draw_overlay(over);
        done = panels.draw_timeline(session);
    });
    pace.drawn(began);
    const Refinement& state = picture.state();
    if (pace.moving() && state.number != before) {
        sound.picture_shown(session, picture.moment());
        pace.motion.picture(shown_picture(pace.now(), state.level, state.width, state.height));
    }
    if (options.play && !tracks.connected() && state.number > 0 && !sound.loading() && !std::exchange(started, true))
        session.perform({Action::pause}, pace.now());
    apply(done);
    if (update && picture.newest()) tracks.shown();
    if (!update || before > 0) return;
    char text[80];
    std::snprintf(text, sizeof text, "first picture after %.3f s, %s", pace.now(),
                  resolution_text(state.level).c_str());
    notes.log(text);
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
    session.replace(loaded->scene, loaded->opened || first);
    if (first || (options.play && loaded->opened)) {
        start_scene();
    } else {
        tracks.ask();
        sound.load(*session.scene, file.path(), glfwPostEmptyEvent);
    }
    if (session.paused()) session.follow(pace.now());
    if (loaded->opened) glfwSetWindowTitle(screen.window(), window_title(file.path()).c_str());
}

/// Does with a scene that is shown for the first time what the options ask for.
void Viewer::start_scene() {
    tracks.ask();
    sound.load(*session.scene, file.path(), glfwPostEmptyEvent);
    const double now = pace.now();
    if (tracks.connected()) return static_cast<void>(session.go_to(options.time.value_or(0), now));
    if (options.play) return start_playing();
    if (options.time) session.go_to(*options.time, now);
    if (options.fly) log_line(session.perform({session.flying() ? Action::pause : Action::play}, now).note);
}

/// Pauses at the start of the flight until the first picture is there.
void Viewer::start_playing() {
    session.once = !options.loop, started = false;
    if (session.go_to(options.time.value_or(0), pace.now())) return;
    session.perform({Action::play}, 0), session.perform({Action::pause}, 0);
}

void Viewer::flight_ended(const Answer& answer) {
    if (!options.play) return notes.tell(answer);
    if (options.loop)
        start_playing();
    else
        closed = true;
}

Overlay Viewer::overlay() const {
    const Refinement& state = picture.state();
    const StabilityCheck& check = picture.marks();
    Overlay overlay;
    overlay.marks = check.found(), overlay.width = state.width, overlay.height = state.height;
    overlay.area = screen.area();
    if (panels.quiet) return overlay;
    overlay.reserved = panels.reserved();
    overlay.help = panels.help, overlay.share = state.share;
    overlay.fault = file.fault(), overlay.fault_title = file.fault_title();
    if (panels.info) overlay.info = info_lines(session, pace, picture);
    overlay.notes = notes.shown();
    if (session.recording()) overlay.notes.insert(overlay.notes.begin(), "recording; K ends it");
    if (const std::string text = stills.progress_text(); !text.empty())
        overlay.bars.push_back({text, stills.progress()});
    if (check.under_way()) overlay.bars.push_back({"checking rounding", check.progress()});
    return overlay;
}

void Viewer::report_benchmark() const {
    const Benchmark benchmark = benchmark_of(pace.motion.pictures());
    const BenchmarkSetting setting{.scene = file.path(),
                                   .precision = name(Precision::float32),
                                   .simd = name(best_simd()),
                                   .width = picture.state().width,
                                   .height = picture.state().height,
                                   .depth = session.depth(),
                                   .threads = picture.threads(),
                                   .fps = options.fps,
                                   .draw_seconds = pace.motion.draw_seconds()};
    std::fputs(report_of(benchmark, setting).c_str(), stdout), std::fflush(stdout);
    if (!options.stats.empty()) write_file(options.stats, json_of(benchmark, setting));
}

int Viewer::run(const std::atomic<bool>& interrupted) {
    bool signalled = false;
    while (!closed) {
        sound.follow(session);
        move();
        picture.order(session, screen.width(), screen.height());
        draw();
        picture.log_finished();
        input.hide_pointer();
        wait();
        take_scene();
        picture.tell_marks();
        file.tell_written();
        if (tracks.follow()) file.write(*session.tracks);
        // A signal ends the window as Esc does; the next one ends the program at once.
        if (interrupted && !std::exchange(signalled, true)) {
            log_line("interrupted");
            stills.finish();
        }
        closed |= stills.finished();
        stills.tell_done();
    }
    end();
    return stills.failed() ? 1 : 0;
}

void Viewer::end() const {
    if (session.editor.changed() && session.editor.path().keys.size() >= 2 && !options.play) {
        log_line("the path was not written into the file; here it is:");
        std::fputs(write_flythrough(session.editor.path()).c_str(), stdout), std::fflush(stdout);
    }
    if (options.benchmark) report_benchmark();
    if (options.size.width == 0 && !options.play) screen.remember();
    notes.log("quit");
}

}  // namespace strahl
