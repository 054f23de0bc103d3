// Finds the flythrough in a text and changes only what differs.
#include "text/edit_path.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "num/decimal.h"
#include "text/parse.h"
#include "text/reading/scene_tokens.h"
#include "text/text_changes.h"
#include "text/text_items.h"
#include "text/write.h"

namespace strahl {
namespace {

/// The numbers and keys of the block `flythrough` in the text.
struct PathSlices {
    TextSlice duration;
    std::optional<TextSlice> loop;
    std::vector<TextSlice> keys;
};

/// Finds them in `block`, a slice of the text.
PathSlices parts_of_path(const std::string& text, std::string_view block) {
    PathSlices slices;
    const TextItem path = item_of_block(block, "flythrough");
    for (const TextItem& item : path.items) {
        if (item.word == "key") slices.keys.push_back(slice_of(text, whole_block(item)));
        if (item.word == "loop") slices.loop = slice_of(text, item.word);
        if (item.word == "duration" && !item.numbers.empty()) slices.duration = slice_of(text, item.numbers[0]);
    }
    return slices;
}

/// The slice to remove for a key: its line, unless something else is on it.
TextSlice with_line(const std::string& text, TextSlice key) {
    const std::size_t next = text.find_first_not_of(" \t", key.end);
    return next == text.npos || text[next] == '\n' || text[next] == '\r' ? with_space(text, key) : key;
}

/// The line break and indentation before a key, as in the text or else as Strahl writes it.
std::string key_indentation(const std::string& text, const PathSlices& slices) {
    for (const TextSlice& key : slices.keys) {
        const std::size_t line = text.rfind('\n', key.begin) + 1;  // 0 if there is none
        const std::string before = text.substr(line, key.begin - line);
        if (line > 0 && before.find_first_not_of(" \t") == before.npos) return "\n" + before;
    }
    return "\n  ";
}

/// Changes keys. Those of the same time stay where they are, as do all if there are as many as before.
void edit_keys(std::vector<TextChange>& edits, const std::string& text, const PathSlices& slices,
               const std::vector<Keyframe>& old, const std::vector<Keyframe>& keys, EyeWords words) {
    const std::string indent = key_indentation(text, slices);
    const bool in_step = old.size() == keys.size();
    std::size_t i = 0, j = 0, after = std::max(slices.duration.end, slices.loop.value_or(TextSlice{}).end);
    if (!old.empty() && slices.keys[0].begin < after) after = slices.keys[0].begin;
    while (i < old.size() || j < keys.size()) {
        const bool both = i < old.size() && j < keys.size();
        if (both && (in_step || old[i].time == keys[j].time)) {
            if (old[i] != keys[j]) edits.push_back({slices.keys[i], write_key(keys[j], words)});
            after = slices.keys[i].end;
            ++i, ++j;
        } else if (j == keys.size() || (both && old[i].time < keys[j].time)) {
            edits.push_back({with_line(text, slices.keys[i++]), ""});
        } else {
            edits.push_back({{after, after}, indent + write_key(keys[j++], words)});
        }
    }
}

/// Parses the block alone; nothing if it has an error.
std::optional<Flythrough> path_of(const std::string& music, const std::string& block) try {
    return parse_scene(std::string(stand_in_camera) + music + block, "").flythrough;
} catch (const FileError&) {
    return std::nullopt;
}

}  // namespace

EyeWords eye_words(const std::string& text) {
    EyeWords words;
    SceneTokens tokens(block_of(text, "camera"));
    for (SceneToken token; (token = tokens.next()).kind != SceneToken::none;) {
        words.sky |= token.text == "sky";
        words.angle |= token.text == "angle";
    }
    return words;
}

std::string with_path(const std::string& text, const std::optional<Flythrough>& path, std::optional<EyeWords> given) {
    const std::string_view found = block_of(text, "flythrough");
    const EyeWords words = given ? *given : eye_words(text);
    if (found.empty()) {
        if (!path) return text;
        if (text.empty()) return write_flythrough(*path, words);
        return text + (text.back() == '\n' ? "\n" : "\n\n") + write_flythrough(*path, words);
    }
    const TextSlice block = slice_of(text, found);
    if (!path) return with_changes(text, {{with_space(text, block), ""}});
    const std::string music(block_of(text, "music"));
    const auto old = path_of(music, std::string(found));
    const std::string whole = write_flythrough(*path, words);
    const TextChange anew{block, whole.substr(0, whole.size() - 1)};
    const PathSlices slices = parts_of_path(text, found);
    if (!old || old->keys.size() != slices.keys.size()) return with_changes(text, {anew});

    std::vector<TextChange> edits;
    if (old->duration != path->duration) edits.push_back({slices.duration, text_of(path->duration)});
    if (path->loop && !old->loop) edits.push_back({{slices.duration.end, slices.duration.end}, "  loop"});
    if (!path->loop && old->loop) edits.push_back({with_space(text, *slices.loop), ""});
    edit_keys(edits, text, slices, old->keys, path->keys, words);
    std::string changed = with_changes(text, edits);
    const std::size_t length = changed.size() - (text.size() - (block.end - block.begin));
    // Nothing that was written in an unusual way may get lost.
    return path_of(music, changed.substr(block.begin, length)) == path ? changed : with_changes(text, {anew});
}

}  // namespace strahl
