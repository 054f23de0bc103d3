// What the window has other threads do, and what it does with their results.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "image/picture.h"
#include "show/viewer.h"

namespace strahl {
/// What the options ask of a scene that is shown for the first time.
void Viewer::start_scene() {
    if (options.play && !rocket) {
        // Paused at its start until the first picture is there.
        session.once = !options.loop, started = false;
        if (session.go_to(options.time.value_or(0), now())) return;
        session.perform({Action::play}, 0), session.perform({Action::pause}, 0);
        return;
    }
    if (rocket) return start_driven();
    if (options.time) session.go_to(*options.time, now());
    if (options.fly) log_line(session.perform({session.flying() ? Action::pause : Action::play}, now()).note);
}

void Viewer::add_still() {
    if (screen.width() == 0) return;  // an icon
    const Framing frame = framing(session.camera, screen.width(), screen.height(), fill);
    View view{.camera = frame.camera,
              .width = frame.area.width,
              .height = frame.area.height,
              .depth = session.depth(),
              .error = half_step({8, session.scene->settings.linear}),
              .time = session.time,
              .tracks = session.tracks};
    if (options.still_size.width > 0) view.width = options.still_size.width, view.height = options.still_size.height;
    const bool in_flight = session.flying() || session.time != 0;
    const std::string name = (std::filesystem::path(options.still_folder) /
                              still_name(path, in_flight ? std::optional(rounded_time(session.time)) : std::nullopt));
    if (const std::string why = folder_fault(name); !why.empty()) {
        failed = true;
        return announce(why);
    }
    stills.add({session.scene, view, name, options.still_ending});
    log_line("still queued: " + name + ", " + std::to_string(view.width) + "x" + std::to_string(view.height));
    still_told = now(), draws_due = 2;
}

void Viewer::handle_reload() {
    const auto loaded = reload.take();
    if (!loaded) return;
    draws_due = 2;
    fault = loaded->fault;
    if (!loaded->scene) {
        fault_until = loaded->opened && !waiting ? now() + 10 : forever;
        log_line((waiting ? "the scene has an error\n" : "the scene has an error; the picture stays\n") + fault);
        return;
    }
    const bool first = std::exchange(waiting, false);
    session.replace(loaded->scene, loaded->opened || first);
    ask_tracks();
    load_sound();
    if (first || (options.play && loaded->opened)) start_scene();
    if (session.paused()) session.follow(now());
    if (loaded->opened) glfwSetWindowTitle(screen.window(), window_title(path = loaded->path).c_str());
    log_line((loaded->opened ? "opened " : "read again: ") + path);
}

/// Marks belong to a picture at rest and are removed when it moves.
void Viewer::toggle_stability() {
    stability.cancel();
    marks = {}, draws_due = 2;
    if (!marked && moving) return note("X marks a picture at rest: Space pauses");
    marked = !marked && wanted.scene;
    if (!marked) return;
    View view = wanted.view;
    view.error = 0;
    stability.start(wanted.scene, view);
}

void Viewer::handle_stability() {
    if (stability.under_way()) draws_due = std::max(draws_due, 1);
    auto found = stability.take();
    if (!found) return;
    marks = std::move(*found);
    const auto& all = marks.marks;
    const auto in_double = std::count_if(all.begin(), all.end(), [](const Mark& m) { return m.in_double; });
    char proved[40] = "; this program was built without proofs";
    if (marks.proved) std::snprintf(proved, sizeof proved, "; %.6g %% are proved", 100 * *marks.proved);
    note("rounding decides " + std::to_string(all.size()) + " pixels in float, " + std::to_string(in_double) +
         " in double" + proved);
}

void Viewer::handle_stills() {
    for (const Stills::Outcome& outcome : stills.outcomes()) {
        const std::string text = outcome.fault.empty() ? "still saved: " + outcome.path : outcome.fault;
        failed |= !outcome.fault.empty();
        announce(text);
    }
    const int pending = stills.pending();
    if (pending > 0 && now() - still_told > 2) {
        still_told = now();
        log_line("still: " + std::to_string(int(100 * stills.progress())) + " %, " + std::to_string(pending) +
                 " waiting");
    }
    if (quitting && pending == 0) closed = true;
}

void Viewer::write_path() {
    const Flythrough& flythrough = session.editor.path();
    if (flythrough.keys.size() == 1) return note("a path needs two keys");
    reload.write(flythrough.keys.empty() ? std::nullopt : std::optional(flythrough), now() < write_until);
    write_until = -1;
}

void Viewer::handle_written() {
    const auto written = reload.take_written();
    if (!written) return;
    const std::string copy = written->copy.empty() ? "" : "; the file as it was is " + written->copy;
    if (written->asks) {
        write_until = now() + 10;
        announce(path + " has changed since it was read; F2 again writes the path into it");
    } else if (!written->fault.empty()) {
        announce(written->fault);
    } else {
        announce((written->file == path ? "path written into " : "tracks saved: ") + written->file + copy);
    }
}

}  // namespace strahl
