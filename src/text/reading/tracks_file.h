// The file beside a scene that holds its tracks.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "scene/motion/track.h"
#include "scene/scene.h"

namespace strahl {

/// The path of that file: "demo.tracks" for the scene "demo.rt".
std::string tracks_path(std::string_view scene);

/// Parses a text such as `track "fade" { 0 1 linear  64 0 step }`: row, value, and interpolation to the next key.
/// Throws FileError as parse_scene does; `file` is the name in messages.
std::vector<Track> parse_tracks(std::string_view text, std::string_view file);
/// Returns a message for each track with keys that no number of the scene follows: "track 'zom' is followed by nothing;
/// did you mean 'zoom'?"
std::vector<std::string> unfollowed_tracks(const Scene& scene);
/// Text that parses to the same tracks, or to the same track, or key: "16 3 smooth".
std::string write_tracks(const std::vector<Track>& tracks);
std::string write_track(const Track& track);
std::string write_key(const TrackKey& key);

}  // namespace strahl
