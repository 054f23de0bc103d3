// The main loop of the window, and what it does with the results of the other threads.
#include "show/viewer.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <utility>

#include "image/picture.h"

namespace strahl {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();
constexpr double note_seconds = 3;
constexpr double rest_interval = 0.05;  // seconds between drawings while a resting picture is refined

std::string title_of(const std::string& path) {
    const std::string name = path == "-" ? "standard input" : std::filesystem::path(path).filename().string();
    return name + " - strahl (H: help)";
}

PixelSize window_size(const ViewOptions& options, const Scene& scene) {
    if (options.size.width > 0) return options.size;
    constexpr int width = 960;
    const double height = width / scene.camera.aspectratio.value_or(4. / 3);
    return {width, static_cast<int>(std::lround(std::clamp(height, 240., 960.)))};
}

}  // namespace

Viewer::Viewer(const ViewOptions& o, std::shared_ptr<const Scene> scene, std::string text, Clock::time_point began)
    : options(o),
      start(began),
      path(o.scene),
      session(scene, o.depth),
      screen(title_of(path), window_size(o, *scene).width, window_size(o, *scene).height, o.size.width == 0,
             o.full_screen),
      tracing(o.threads, glfwPostEmptyEvent),
      stills(o.threads, glfwPostEmptyEvent),
      stability(o.threads, glfwPostEmptyEvent),
      reload(path, std::move(text), glfwPostEmptyEvent) {
    connect();
    if (options.time) session.go_to(*options.time, now());
    if (options.fly) perform({session.flying() ? Action::pause : Action::play});
}

Viewer::~Viewer() = default;

double Viewer::now() const { return std::chrono::duration<double>(Clock::now() - start).count(); }

void Viewer::add_still() {
    View view = wanted.view;
    view.camera = session.camera, view.depth = session.depth(), view.time = session.time;
    view.error = half_step({8, session.scene->settings.linear});
    if (options.still_size.width > 0) view.width = options.still_size.width, view.height = options.still_size.height;
    const std::string name = still_name(path);
    stills.add({session.scene, view, name});
    log_line("still queued: " + name + ", " + std::to_string(view.width) + "x" + std::to_string(view.height));
    still_told = now(), draws_due = 2;
}

void Viewer::handle_reload() {
    const auto loaded = reload.take();
    if (!loaded) return;
    draws_due = 2;
    fault = loaded->fault;
    if (!loaded->scene) {
        fault_until = loaded->opened ? now() + 10 : forever;
        log_line("the scene has an error; the picture stays\n" + fault);
        return;
    }
    session.replace(loaded->scene, loaded->opened);
    if (session.paused()) session.follow(now());
    if (loaded->opened) glfwSetWindowTitle(screen.window(), title_of(path = loaded->path).c_str());
    log_line((loaded->opened ? "opened " : "read again: ") + path);
}

/// Marks belong to a picture at rest and are removed when it moves.
void Viewer::toggle_stability() {
    stability.cancel();
    marks.clear(), draws_due = 2;
    marked = !marked && !moving && wanted.scene;
    if (!marked) return;
    View view = wanted.view;
    view.error = 0;
    stability.start(wanted.scene, view);
    note("rendering this view in float, double and long double");
}

void Viewer::handle_stability() {
    auto found = stability.take();
    if (!found) return;
    marks = std::move(*found);
    const auto in_double = std::count_if(marks.begin(), marks.end(), [](const Mark& m) { return m.in_double; });
    note("rounding decides " + std::to_string(marks.size()) + " pixels in float, " + std::to_string(in_double) +
         " in double");
}

void Viewer::handle_stills() {
    for (const Stills::Outcome& outcome : stills.outcomes()) {
        const std::string text = outcome.fault.empty() ? "still saved: " + outcome.path : outcome.fault;
        log_line(text);
        notes.push_back({text, now() + 2 * note_seconds});
        draws_due = 2;
    }
    const int pending = stills.pending();
    if (pending > 0 && now() - still_told > 2) {
        still_told = now();
        log_line("still: " + std::to_string(int(100 * stills.progress())) + " %, " + std::to_string(pending) +
                 " waiting");
    }
    if (quitting && pending == 0) closed = true;
}

void Viewer::note(const std::string& text) {
    if (text.empty()) return;
    if (options.verbose) log_line(text);
    if (notes.size() >= 3) notes.pop_front();
    notes.push_back({text, now() + note_seconds});
    draws_due = 2;
}

void Viewer::tell(const Answer& answer) {
    note(answer.note);
    if (!answer.print.empty()) std::fputs(answer.print.c_str(), stdout), std::fflush(stdout);
}

bool Viewer::in_motion() const { return session.under_way() || controls.active(now()); }

/// The time of the next drawing; infinite if there is nothing to draw.
double Viewer::next_draw() const {
    const double frame = 1 / options.fps;
    double at = forever;
    if (draws_due > 0 || tracing.has_update())
        at = last_draw + (moving || draws_due > 0 || tracing.finished() ? 0.9 * frame : rest_interval);
    for (const Note& n : notes) at = std::min(at, n.until);
    if (!fault.empty()) at = std::min(at, fault_until);
    if (stills.pending() > 0) at = std::min(at, last_draw + 0.25);
    return at;
}

void Viewer::wait() {
    double until = next_draw();
    if (moving || in_motion()) until = std::min(until, next_move);
    const double left = until - now();
    if (left == forever)
        glfwWaitEvents();
    else if (left > 0)
        glfwWaitEventsTimeout(left);
    else
        glfwPollEvents();
}

/// The camera at this moment.
void Viewer::move() {
    const double frame = 1 / options.fps, moment = now();
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
    const CameraInput input = controls.take(passed, moment);
    if (!(input == CameraInput{})) session.steer(input, moment);
    if (const auto ended = session.follow(moment)) tell(*ended);
    if (in_motion()) return;
    moving = false;
    told = 0;
    if (options.verbose) log_line("rest after " + motion.report(moment));
}

/// Orders the picture that should be on the screen.
void Viewer::order() {
    const int width = screen.width(), height = screen.height();
    if (width == 0 || height == 0) return;
    const View view{.camera = session.camera,
                    .width = width,
                    .height = height,
                    .depth = session.depth(),
                    .error = half_step({8, session.scene->settings.linear}),
                    .time = session.time};
    const bool same = wanted.scene == session.scene && wanted.view.camera == view.camera &&
                      wanted.view.width == width && wanted.view.height == height && wanted.view.depth == view.depth &&
                      wanted.view.time == view.time;
    if (same && wanted.moving == moving) return;
    if (!same && marked) toggle_stability();
    wanted = {wanted.number + (same ? 0 : 1), session.scene, view, moving, 0.8 / options.fps, session.finest};
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
    screen.draw([&] { draw_overlay(over); });
    last_draw = moment;
    if (draws_due > 0) --draws_due;
    motion.drawn(now() - moment);
    if (moving && state.number != before) motion.picture(now(), state.level);
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

void Viewer::run() {
    while (!closed) {
        move();
        order();
        draw();
        if (options.verbose) log_finished();
        wait();
        handle_reload();
        handle_stills();
        handle_stability();
    }
    if (options.verbose) log_line("quit");
}

}  // namespace strahl
