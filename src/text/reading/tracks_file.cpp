#include "text/reading/tracks_file.h"

#include <algorithm>
#include <filesystem>

#include "files/utf8.h"
#include "num/decimal.h"
#include "scene/moving_scene.h"
#include "text/reading/reader.h"
#include "text/reading/scene_files.h"

namespace strahl {
namespace {

constexpr std::array<std::string_view, 1> file_words{"track"};
constexpr std::array<std::string_view, interpolations> ways{"step", "linear", "smooth", "ramp"};
constexpr NumberRange row_numbers{0, 1e9, "a whole number from 0 to 1e9", true};

class TracksReader {
  public:
    TracksReader(std::string_view text, Diagnostics& diagnostics, SceneFiles& none)
        : reader(text, diagnostics, file_words, none), lexer(reader.lexer), diagnostics(diagnostics) {}

    std::vector<Track> read() {
        reader.blocks_to_end("track \"fade\" { 0 1 step }", [&](std::string_view word) {
            if (word != file_words[0]) {
                diagnostics.add(word, unknown_word(word, file_words, " in a file of tracks"));
                throw ParseAbort{};
            }
            track(word);
        });
        diagnostics.check();
        return std::move(tracks);
    }

  private:
    void track(std::string_view word) {
        const std::string_view name = lexer.quotation("the name of a track");
        if (std::ranges::find(tracks, name, &Track::name) != tracks.end())
            diagnostics.add(name, "a second track of this name");
        Track own{std::string(name), {}};
        Block block{word};
        reader.block(
            block, {},
            [&] {
                while (!lexer.at_end() && lexer.peek() != '}') key(own, block);
            },
            [](std::string_view) { return false; });
        tracks.push_back(std::move(own));
    }
    void key(Track& own, Block& block) {
        const std::string_view at = lexer.token();
        lexer.rewind(at);
        double row = 0, value = 0;
        reader.read(row, row_numbers, "row", block);
        reader.read(value, coordinates, "value", block);
        const std::string_view way = lexer.word();
        const auto known = std::ranges::find(ways, way);
        if (way.empty())
            diagnostics.add(at, "this key lacks the interpolation after it: 'step', 'linear', 'smooth' or 'ramp'");
        else if (known == ways.end())
            diagnostics.add(way, unknown_word(way, ways, " after a key"));
        if (known == ways.end() || !block.good()) return;
        if (!own.keys.empty() && !(row > own.keys.back().row))
            diagnostics.add(at, "rows must increase: the key before is in row " + std::to_string(own.keys.back().row));
        own.keys.push_back({static_cast<int>(row), value, static_cast<Interpolation>(known - ways.begin())});
    }

    BlockReader reader;
    Lexer& lexer;
    Diagnostics& diagnostics;
    std::vector<Track> tracks;
};

}  // namespace

std::string tracks_path(std::string_view scene) {
    std::filesystem::path path(scene);
    return path.extension() == ".rt" ? path.replace_extension(".tracks").string() : path.string() + ".tracks";
}

std::vector<Track> parse_tracks(std::string_view text, std::string_view file) {
    text = utf8_text(text, file);
    Diagnostics diagnostics(text, file);
    diagnostics.check_encoding();
    SceneFiles none("", {});
    return TracksReader(text, diagnostics, none).read();
}

std::vector<std::string> unfollowed_tracks(const Scene& scene) {
    const std::vector<std::string> followed = followed_tracks(scene);
    const std::vector<std::string_view> names(followed.begin(), followed.end());
    std::vector<std::string> messages;
    for (const Track& track : scene.tracks) {
        if (track.keys.empty() || std::ranges::find(followed, track.name) != followed.end()) continue;
        const std::string_view meant = nearest(track.name, names);
        messages.push_back("track " + strahl::quoted(track.name) + " is followed by nothing" +
                           (meant.empty() ? "" : "; did you mean " + strahl::quoted(meant) + "?"));
    }
    return messages;
}

std::string write_tracks(const std::vector<Track>& tracks) {
    std::string text = "// Tracks: rows, values, and interpolations to the next key.\n";
    for (const Track& track : tracks) text += write_track(track);
    return text;
}

std::string write_track(const Track& track) {
    std::string text = "track \"" + track.name + "\" {\n";
    for (const TrackKey& key : track.keys) text.append("  ").append(write_key(key)) += '\n';
    return text + "}\n";
}

std::string write_key(const TrackKey& key) {
    return std::to_string(key.row) + " " + text_of(key.value) + " " +
           std::string(ways[static_cast<std::size_t>(key.way)]);
}

}  // namespace strahl
