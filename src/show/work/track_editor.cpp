#include "show/work/track_editor.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "files/error.h"
#include "scene/moving_scene.h"

namespace strahl {

TrackEditor::TrackEditor(std::optional<int> port, Session& session, Notes& notes, Pace& pace,
                         std::function<void()> notify_function)
    : port(port),
      session(session),
      notes(notes),
      pace(pace),
      notify(notify_function),
      worker(std::move(notify_function)) {
    if (port) await_editor();
}

/// Tries to connect, a few times a second, until it succeeds or fails for another reason than before.
void TrackEditor::await_editor() {
    worker.add([port = *port, known = fault](const std::atomic<bool>& stop) {
        EditorSearch search;
        while (!stop) {
            try {
                search.found = std::make_unique<Rocket>(port);
                break;
            } catch (const FileError& error) {
                search.fault = error.what();
            }
            if (search.fault != known) break;
            for (int part = 0; part < 10 && !stop; ++part) std::this_thread::sleep_for(std::chrono::milliseconds(30));
        }
        return search;
    });
}

/// Takes over the connection, once there is one.
void TrackEditor::take_editor() {
    std::optional<EditorSearch> search = worker.take();
    if (!search) return;
    if (!search->fault.empty()) fault = search->fault;
    rocket = std::move(search->found);
    if (!rocket) {
        notes.announce(fault + "; waiting for one");
        return await_editor();
    }
    notes.announce("connected to the GNU Rocket editor");
    session.flight.driven = true;
    rocket->listen(notify);
    ask();
    if (!session.flight.under_way()) session.go_to(session.time, pace.now());
}

void TrackEditor::ask() {
    if (rocket) rocket->ask(followed_tracks(*session.scene)), take_tracks();
}

/// Makes the editor's tracks those of the pictures.
void TrackEditor::take_tracks() {
    session.tracks = std::make_shared<const std::vector<Track>>(with_tracks(session.scene->tracks, rocket->tracks()));
    if (session.flight.paused()) session.follow(pace.now());
}

bool TrackEditor::follow() {
    if (port && !rocket) take_editor();
    if (!rocket) return false;
    const RocketNews news = rocket->take();
    const Music& music = session.scene->music;
    const double time_before = session.time, now = pace.now();
    if (news.keys) take_tracks();
    if (news.row) {
        const bool running = session.flight.under_way();
        session.go_to(music.time_of(*news.row), now);
        if (running) session.perform({Action::pause}, now);
    }
    if (news.paused && *news.paused == session.flight.under_way()) session.perform({Action::pause}, now);
    if (news.keys || session.time != time_before) heard = now;
    if (!news.lost.empty()) {
        notes.fail("the Rocket editor is gone: " + news.lost + "; waiting for it");
        session.flight.driven = false;
        rocket.reset();
        await_editor();
        return news.save;
    }
    const double moment = session.flight.flying() ? session.flight.time(now) : session.time;
    rocket->tell_row(static_cast<int>(std::clamp(std::floor(music.row_at(moment)), 0., 1e9)));
    return news.save;
}

void TrackEditor::shown() {
    if (!heard) return;
    notes.log("the editor's change is on the screen after " + seconds_text(pace.now() - *heard));
    heard.reset();
}

}  // namespace strahl
