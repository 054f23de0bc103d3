// What an editor of tracks has the window do.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/moving_scene.h"
#include "show/viewer.h"

namespace strahl {

/// Begins with the editor's tracks, at rest until it says otherwise.
void Viewer::start_driven() {
    ask_tracks();
    session.go_to(options.time.value_or(0), now());
}

/// Those that the scene follows.
void Viewer::ask_tracks() {
    if (rocket) rocket->ask(followed_tracks(*session.scene)), take_tracks();
}

/// Makes the editor's tracks those of the pictures.
void Viewer::take_tracks() {
    session.tracks =
        std::make_shared<const std::vector<Track>>(with_tracks(session.scene->tracks, rocket->tracks()));
    if (session.paused()) session.follow(now());
}

void Viewer::handle_rocket() {
    if (!rocket) return;
    const RocketNews news = rocket->take();
    const Music& music = session.scene->music;
    const double time_before = session.time;
    if (news.keys) take_tracks();
    if (news.row) {
        const bool running = session.under_way();
        session.go_to(music.time_of(*news.row), now());
        if (running) session.perform({Action::pause}, now());
    }
    if (news.paused && *news.paused == session.under_way()) session.perform({Action::pause}, now());
    if (news.keys || session.time != time_before) change_heard = now();
    if (news.save && !waiting) reload.write(*session.tracks);
    if (!news.lost.empty()) {
        announce("the Rocket editor is gone: " + news.lost);
        session.driven = false;
        return rocket.reset();
    }
    const double moment = session.flying() ? session.flight_time(now()) : session.time;
    rocket->tell_row(static_cast<int>(std::min(std::floor(music.row_at(moment)), 1e9)));
}

}  // namespace strahl
