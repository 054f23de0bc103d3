// The main loop of the window, and what it does with the results of the other threads.
#include "show/viewer.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "files/output_file.h"
#include "image/picture.h"
#include "text/write.h"

namespace strahl {
namespace {

constexpr double rest_interval = 0.05;   // seconds between drawings while a resting picture is refined
constexpr double signal_interval = 0.2;  // seconds until a signal is noticed

}  // namespace

std::string window_title(const std::string& path) {
    const std::string name = path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
    return name + " - strahl (H: help)";
}

namespace {

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

Viewer::Viewer(const ViewOptions& o, const Loaded& first, std::string text, Clock::time_point began,
               const std::atomic<bool>* signal, std::unique_ptr<Rocket> editor)
    : options(o),
      start(began),
      interrupted(signal),
      path(o.scene),
      session(scene_to_show(first), o.depth),
      screen(window_title(path), window_size(o, *session.scene).width, window_size(o, *session.scene).height,
             o.size.width == 0, o.full_screen),
      tracing(o.threads, glfwPostEmptyEvent),
      stills(o.threads, glfwPostEmptyEvent),
      stability(o.threads, glfwPostEmptyEvent),
      reload(path, std::move(text), glfwPostEmptyEvent),
      rocket(std::move(editor)) {
    connect();
    session.driven = rocket != nullptr;
    if (rocket) rocket->listen(glfwPostEmptyEvent);
    quiet = options.play;
    waiting = !first.scene;
    if (!waiting) load_sound(), start_scene();
    fault = first.fault, fault_until = forever;
    if (waiting) log_line("waiting until the scene has no error\n" + fault);
}

Viewer::~Viewer() = default;

double Viewer::now() const { return std::chrono::duration<double>(Clock::now() - start).count(); }

void Viewer::show(const std::string& text, double seconds) {
    if (notes.size() >= 3) notes.pop_front();
    notes.push_back({text, now() + seconds});
    draws_due = 2;
}

void Viewer::note(const std::string& text) {
    if (text.empty()) return;
    if (options.verbose) log_line(text);
    show(text, 3);
}

void Viewer::announce(const std::string& text) { log_line(text), show(text, 6); }

void Viewer::tell(const Answer& answer) {
    note(answer.note);
    if (answer.text.empty()) return;
    glfwSetClipboardString(screen.window(), answer.text.c_str());
    std::fputs(answer.text.c_str(), stdout), std::fflush(stdout);
}

bool Viewer::in_motion() const { return session.under_way() || controls.active(now()); }

/// The time of the next drawing; infinite if there is nothing to draw.
double Viewer::next_draw() const {
    const double frame = 1 / options.fps;
    double at = forever;
    if (draws_due > 0 || tracing.has_update())
        at = last_draw + (moving || change_heard || draws_due > 0 || tracing.finished() ? 0.9 * frame : rest_interval);
    for (const Note& n : notes) at = std::min(at, n.until);
    if (!fault.empty()) at = std::min(at, fault_until);
    if (stills.pending() > 0) at = std::min(at, last_draw + 0.25);
    return at;
}

void Viewer::wait() {
    double until = next_draw();
    if (moving || in_motion()) until = std::min(until, next_move);
    // A gamepad has no events.
    const double left = std::min(until - now(), gamepad() ? 1 / options.fps : signal_interval);
    if (left > 0)
        glfwWaitEventsTimeout(left);
    else
        glfwPollEvents();
}

/// The camera at this moment.
void Viewer::move() {
    const double frame = 1 / options.fps, moment = now();
    if (!options.play) read_gamepad();
    const bool begins = in_motion() && !moving;
    if (begins) {
        moving = true;
        motion.begin(moment);
        next_move = moment, last_move = moment - frame;
    }
    // Before a picture is drawn, the next one is ordered, so that it is traced in the meantime.
    if (!moving || moment < next_move - (tracing.has_update() ? 0.5 * frame : 0)) return;
    next_move = std::max(next_move + frame, moment);
    // If the machine can't keep up, the camera slows down instead of jumping; a flight follows the clock in any case.
    const double passed = std::min(moment - std::exchange(last_move, moment), 0.1);
    if (begins) session.observe(moment - frame);
    const CameraInput input = controls.take(passed);
    if (!(input == CameraInput{})) tell(session.steer(input, moment));
    if (const auto full = session.observe(moment)) tell(*full);
    if (const auto ended = session.follow(moment)) flight_ended(*ended);
    if (in_motion()) return;
    moving = false;
    told = 0;
    if (options.verbose) log_line("rest after " + motion.report(moment) + sound_report());
}

void Viewer::flight_ended(const Answer& answer) {
    if (!options.play) return tell(answer);
    if (!options.loop)
        closed = true;
    else
        start_scene();
}

/// Orders the picture that should be on the screen.
void Viewer::order() {
    const int width = screen.width(), height = screen.height();
    if (width == 0 || height == 0) return;
    const Framing frame = framing(session.camera, width, height, fill);
    const View view{.camera = frame.camera,
                    .width = frame.area.width,
                    .height = frame.area.height,
                    .depth = session.depth(),
                    .error = half_step({8, session.scene->settings.linear}),
                    .time = session.time,
                    .tracks = session.tracks};
    const View& last = wanted.view;
    const bool same = wanted.scene == session.scene && last.camera == view.camera && last.width == view.width &&
                      last.height == view.height && last.depth == view.depth && last.time == view.time &&
                      last.tracks == view.tracks;
    if (same && wanted.moving == moving) return;
    if (!same && marked) toggle_stability();
    // Where drawing limits the rate there is more time to trace.
    const double interval = std::clamp(draw_seconds, 1 / options.fps, 2 / options.fps);
    wanted = {wanted.number + (same ? 0 : 1), session.scene, view, moving, 0.8 * interval, session.finest};
    ordered[wanted.number % ordered.size()] = session.time;
    tracing.want(wanted);
}

void Viewer::draw() {
    if (now() < next_draw()) return;
    const double moment = now();
    std::erase_if(notes, [&](const Note& n) { return n.until <= moment; });
    if (fault_until <= moment) fault.clear();
    const std::uint64_t before = state.number;
    const auto update = tracing.take([this](const Fresh& fresh) { screen.upload(fresh); });
    if (update) state = *update;
    const Overlay over = overlay();
    TimelineInput input;
    screen.draw([&] {
        draw_overlay(over);
        if (!with_timeline || quiet) return;
        const auto flight = session.flight();
        input = timeline.draw({.editor = session.editor,
                               .scene_camera = session.scene->camera,
                               .time = session.flight_time(moment),
                               .duration = flight ? flight->duration : session.editor.path().duration,
                               .running = session.under_way()});
    });
    last_draw = moment;
    if (draws_due > 0) --draws_due;
    motion.drawn(now() - moment);
    draw_seconds += 0.2 * (now() - moment - draw_seconds);
    if (moving && state.number != before) picture_shown(ordered[state.number % ordered.size()]);
    if (moving && state.number != before)
        motion.picture(shown_picture(now(), state.level, state.width, state.height));
    if (options.play && !rocket && state.number > 0 && !(sound && sound->loading()) && !std::exchange(started, true))
        session.perform({Action::pause}, now());
    apply(input);
    if (change_heard && update && state.number == wanted.number) {
        if (options.verbose)
            log_line("the editor's change is on the screen after " + seconds_text(now() - *change_heard));
        change_heard.reset();
    }
    if (options.verbose && update && before == 0) {
        char text[80];
        std::snprintf(text, sizeof text, "first picture after %.3f s, %s", now(), resolution_text(state.level).c_str());
        log_line(text);
    }
}

/// Once per rest; the picture may have been finished before the rest began.
void Viewer::log_finished() {
    if (moving || !state.finished() || state.number != wanted.number || state.number == told) return;
    told = state.number;
    char text[120];
    std::snprintf(text, sizeof text, "finished %dx%d: traced in %.4f s, %.3f million rays", state.width, state.height,
                  state.seconds, static_cast<double>(state.rays.total()) / 1e6);
    log_line(text);
}

/// A signal ends the window as Esc does, but the next one ends the program at once.
void Viewer::handle_interrupt() {
    if (!*interrupted || std::exchange(signalled, true)) return;
    log_line("interrupted");
    quit();
}

/// In full screen, when it has not moved for a while.
void Viewer::hide_pointer() {
    const bool hide = screen.full_screen() && (options.play || now() > pointer_moved + 2);
    if (hide == std::exchange(pointer_hidden, hide)) return;
    glfwSetInputMode(screen.window(), GLFW_CURSOR, hide ? GLFW_CURSOR_HIDDEN : GLFW_CURSOR_NORMAL);
}

void Viewer::report_benchmark() const {
    const Benchmark benchmark = benchmark_of(motion.pictures());
    const BenchmarkSetting setting{.scene = path,
                                   .precision = name(Precision::float32),
                                   .simd = name(best_simd()),
                                   .width = state.width,
                                   .height = state.height,
                                   .depth = session.depth(),
                                   .threads = tracing.threads(),
                                   .fps = options.fps,
                                   .draw_seconds = motion.draw_seconds()};
    std::fputs(text_of(benchmark, setting).c_str(), stdout), std::fflush(stdout);
    if (!options.stats.empty()) write_file(options.stats, json_of(benchmark, setting));
}

int Viewer::run() {
    while (!closed) {
        follow_sound();
        move();
        order();
        draw();
        if (options.verbose) log_finished();
        hide_pointer();
        wait();
        handle_reload();
        handle_stills();
        handle_stability();
        handle_written();
        handle_rocket();
        handle_interrupt();
    }
    if (session.editor.changed() && session.editor.path().keys.size() >= 2 && !options.play) {
        log_line("the path was not written into the file; here it is:");
        std::fputs(write_flythrough(session.editor.path()).c_str(), stdout), std::fflush(stdout);
    }
    if (options.benchmark) report_benchmark();
    if (options.size.width == 0 && !options.play) screen.remember();
    if (options.verbose) log_line("quit");
    return failed ? 1 : 0;
}

}  // namespace strahl
