#include "show/work/track_editor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/moving_scene.h"

namespace strahl {

TrackEditor::TrackEditor(std::unique_ptr<Rocket> connection, Session& session, Notes& notes, Pace& pace,
                         std::function<void()> notify)
    : rocket(std::move(connection)), session(session), notes(notes), pace(pace) {
    session.driven = connected();
    if (rocket) rocket->listen(std::move(notify));
}

void TrackEditor::ask() {
    if (rocket) rocket->ask(followed_tracks(*session.scene)), take_tracks();
}

/// Makes the editor's tracks those of the pictures.
void TrackEditor::take_tracks() {
    session.tracks = std::make_shared<const std::vector<Track>>(with_tracks(session.scene->tracks, rocket->tracks()));
    if (session.paused()) session.follow(pace.now());
}

bool TrackEditor::follow() {
    if (!rocket) return false;
    const RocketNews news = rocket->take();
    const Music& music = session.scene->music;
    const double time_before = session.time, now = pace.now();
    if (news.keys) take_tracks();
    if (news.row) {
        const bool running = session.under_way();
        session.go_to(music.time_of(*news.row), now);
        if (running) session.perform({Action::pause}, now);
    }
    if (news.paused && *news.paused == session.under_way()) session.perform({Action::pause}, now);
    if (news.keys || session.time != time_before) heard = now;
    if (!news.lost.empty()) {
        notes.announce("the Rocket editor is gone: " + news.lost);
        session.driven = false;
        rocket.reset();
        return news.save;
    }
    const double moment = session.flying() ? session.flight_time(now) : session.time;
    rocket->tell_row(static_cast<int>(std::min(std::floor(music.row_at(moment)), 1e9)));
    return news.save;
}

void TrackEditor::shown() {
    if (!heard) return;
    notes.log("the editor's change is on the screen after " + seconds_text(pace.now() - *heard));
    heard.reset();
}

}  // namespace strahl
