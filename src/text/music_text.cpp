#include "text/music_text.h"

#include <algorithm>
#include <optional>
#include <variant>
#include <vector>

#include "files/error.h"
#include "files/words.h"
#include "num/decimal.h"
#include "text/blocks/blocks.h"
#include "text/reading/lexer.h"
#include "text/reading/tracks_file.h"
#include "text/text_changes.h"
#include "text/text_items.h"
#include "text/write.h"

namespace strahl {
namespace {

/// Returns the place of the name in quotes that follows a word.
TextSlice quoted_name(const std::string& text, std::string_view word) {
    const std::size_t open = text.find('"', slice_of(text, word).end);
    return {std::min(open, text.size() - 1) + 1, std::min(text.find('"', open + 1), text.size())};
}

/// Returns where the block ends: the closing brace.
std::size_t end_of(const std::string& text, const TextItem& item) { return slice_of(text, item.end).begin; }

/// A track in a text: its block from the word to the closing brace, and its keys.
struct TrackSlices {
    TextSlice block;
    std::vector<TextSlice> keys;
};
std::optional<TrackSlices> find_track(const std::string& text, std::string_view name) try {
    Diagnostics diagnostics(text, "");
    Lexer lexer(text, diagnostics);
    while (!lexer.at_end()) {
        TrackSlices found{slice_of(text, lexer.word()), {}};
        const bool sought = lexer.quotation("") == name;
        lexer.accept('{');
        while (lexer.peek() != '}') {
            const std::string_view row = lexer.number("", "").at;
            lexer.number("", "");
            found.keys.push_back({slice_of(text, row).begin, slice_of(text, lexer.word()).end});
        }
        found.block.end = slice_of(text, lexer.token()).end;
        lexer.accept('}');
        if (sought) return found;
    }
    return std::nullopt;
} catch (const ParseAbort&) {
    return std::nullopt;
}

/// Returns the white space between the first two keys, or else as Strahl writes it.
std::string space_between(const std::string& text, const std::vector<TextSlice>& keys) {
    if (keys.size() < 2) return "\n  ";
    const std::string space = text.substr(keys[0].end, keys[1].begin - keys[0].end);
    return space.find_first_not_of(" \t\r\n") == space.npos ? space : "\n  ";
}

}  // namespace

std::string with_music(const std::string& text, const Music& music) {
    const TextItem item = item_of_block(text, "music");
    if (item.word.empty()) {
        const TextItem camera = item_of_block(text, "camera");
        const std::size_t behind = camera.end.empty() ? text.size() : rest_of_line(text, end_of(text, camera) + 1);
        const std::string block = write_music(music);
        return with_changes(text, {{{behind, behind}, "\n" + block.substr(0, block.size() - 1)}});
    }
    const std::size_t end = end_of(text, item);
    std::vector<TextChange> changes;
    const auto add = [&](const std::string& words) { changes.push_back({{end, end}, " " + words + " "}); };
    Music wanted = music, usual;
    const auto parameters = music_parameters(wanted), defaults = music_parameters(usual);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const double value = *std::get<double*>(parameters[i].value);
        double before = *std::get<double*>(defaults[i].value);
        const TextItem* const given = item.item(parameters[i].name);
        const bool written = given && !given->numbers.empty();
        if (written) read_number(given->numbers[0], before);
        if (value == before) continue;
        if (written)
            changes.push_back({slice_of(text, given->numbers[0]), text_of(value)});
        else
            add(std::string(parameters[i].name) + " " + text_of(value));
    }
    if (const TextItem* const given = item.item(music_words[0])) {
        const TextSlice name = quoted_name(text, given->word), word = slice_of(text, given->word);
        if (music.sound.empty())
            changes.push_back({with_space(text, {word.begin, name.end + 1}), ""});
        else
            changes.push_back({name, music.sound});
    } else if (!music.sound.empty()) {
        add(std::string(music_words[0]) + " \"" + music.sound + "\"");
    }
    return with_changes(text, std::move(changes));
}

std::string with_keys(const std::string& text, const Track& track) {
    const auto found = find_track(text, track.name);
    if (!found && track.keys.empty()) return text;
    if (!found && text.empty()) return write_tracks({track});
    if (!found) return text + (text.back() == '\n' ? "" : "\n") + write_track(track);
    if (track.keys.empty()) return with_changes(text, {{with_space(text, found->block), ""}});
    const std::vector<Track> all = parse_tracks(text, "");
    const std::vector<TrackKey>& old = std::ranges::find(all, track.name, &Track::name)->keys;
    const std::vector<TrackKey>& keys = track.keys;
    const std::vector<TextSlice>& slices = found->keys;
    const std::string space = space_between(text, slices);
    const bool in_step = old.size() == keys.size();  // a key that is moved stays where it is written
    std::vector<TextChange> changes;
    std::size_t after = slices.empty() ? text.find('{', found->block.begin + track.name.size()) + 1 : slices[0].begin;
    for (std::size_t i = 0, j = 0; i < old.size() || j < keys.size();) {
        const bool both = i < old.size() && j < keys.size();
        if (both && (in_step || old[i].row == keys[j].row)) {
            if (old[i] != keys[j]) changes.push_back({slices[i], write_key(keys[j])});
            after = slices[i].end;
            ++i, ++j;
        } else if (j == keys.size() || (both && old[i].row < keys[j].row)) {
            changes.push_back({with_space(text, slices[i++]), ""});
        } else if (slices.empty() || after != slices[0].begin) {
            changes.push_back({{after, after}, space + write_key(keys[j++])});
        } else {
            changes.push_back({{after, after}, write_key(keys[j++]) + space});
        }
    }
    return with_changes(text, std::move(changes));
}

}  // namespace strahl
