#include "show/session/track_keys.h"

#include <algorithm>

#include "files/error.h"
#include "text/music_text.h"
#include "text/reading/tracks_file.h"

namespace strahl {
namespace {

/// Texts with an error have no tracks: the scene is not read then either.
std::vector<Track> tracks_of(const std::string& text) try { return parse_tracks(text, ""); } catch (const FileError&) {
    return {};
}

}  // namespace

void TrackKeys::open(const std::string& text) {
    edited.open(text);
    saved = present = tracks_of(text);
}

bool TrackKeys::reload(const std::string& text) {
    const std::vector<Track> before = present;
    const bool lost = edited.reload(text);
    saved = tracks_of(text), present = tracks_of(edited.text());
    return lost && present != before;
}

Track TrackKeys::track(const std::string& name) const {
    const auto found = std::ranges::find(present, name, &Track::name);
    return found == present.end() ? Track{name, {}} : *found;
}

std::vector<Track> TrackKeys::changes() const {
    std::vector<Track> list;
    for (const Track& track : present)
        if (std::ranges::find(saved, track) == saved.end()) list.push_back(track);
    for (const Track& track : saved)
        if (std::ranges::find(present, track.name, &Track::name) == present.end()) list.push_back({track.name, {}});
    return list;
}

void TrackKeys::change(const Track& track, const Edit& edit) {
    edited.change(with_keys(edited.text(), track), edit);
    present = tracks_of(edited.text());
}

std::optional<std::string> TrackKeys::undo(bool back, EditOrder& order) {
    const auto done = edited.undo(back, order);
    if (done) present = tracks_of(edited.text());
    return done;
}

Track repeated(const Track& track, int beat, int end) {
    Track all{track.name, {}};
    for (const TrackKey& key : track.keys)
        if (key.row >= end) all.keys.push_back(key);
    for (int row = 0; row < end; row += beat)
        for (const TrackKey& key : track.keys)
            if (key.row < beat && row + key.row < end) set_key(all, {row + key.row, key.value, key.way});
    return all;
}

}  // namespace strahl
