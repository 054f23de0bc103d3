// Finds the flythrough in a text and changes only what differs.
#include "text/edit_path.h"

#include <algorithm>
#include <vector>

#include "num/decimal.h"
#include "text/parse.h"
#include "text/reading/lexer.h"
#include "text/text_changes.h"
#include "text/write.h"

namespace strahl {
namespace {

/// The parts of the block `flythrough` in the text.
struct PathSlices {
    TextSlice block, duration;  // `duration` is its number alone
    std::optional<TextSlice> loop;
    std::vector<TextSlice> keys;
    std::string music;  // the block `music`
};

std::optional<PathSlices> find_path(const std::string& text) {
    Diagnostics diagnostics(text, "");
    Lexer lexer(text, diagnostics);
    std::optional<PathSlices> slices;
    const auto begin = [&](std::string_view slice) { return std::size_t(slice.data() - text.data()); };
    bool inside = false;  // is the token in the block of the flythrough?
    std::size_t music_begin = 0;
    std::string music;
    for (int depth = 0; !lexer.at_end();) {
        if (lexer.peek() == '"') {
            lexer.quotation("");
            continue;
        }
        const std::string_view token = lexer.token();
        const std::size_t start = begin(token), stop = start + token.size();
        lexer.rewind(token.substr(token.size()));
        if (token == "{") ++depth;
        if (token == "}") --depth;
        if (depth == 0 && token == "music") music_begin = start + 1;
        if (depth == 0 && token == "}" && music_begin > 0)
            music = text.substr(music_begin - 1, stop - music_begin + 1), music_begin = 0;
        if (depth == 0 && token == "flythrough") slices.emplace().block.begin = start, inside = true;
        if (!inside) continue;
        if (depth == 1 && token == "key") slices->keys.push_back({start, 0});
        if (depth == 1 && token == "}") slices->keys.back().end = stop;
        if (depth == 1 && token == "loop") slices->loop = {start, stop};
        if (depth == 1 && token == "duration") {
            const std::string_view number = lexer.token();
            slices->duration = {begin(number), begin(number) + number.size()};
        }
        if (depth == 0 && token == "}") slices->block.end = stop, inside = false;
    }
    if (slices) slices->music = music;
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
    Diagnostics diagnostics(text, "");
    Lexer lexer(text, diagnostics);
    EyeWords words;
    int depth = 0;
    for (bool camera = false; !lexer.at_end() && !(camera && depth == 0 && lexer.peek() != '{');) {
        if (lexer.peek() == '"') {
            lexer.quotation("");
            continue;
        }
        const std::string_view token = lexer.token();
        lexer.rewind(token.substr(token.size()));
        if (token == "{") ++depth;
        if (token == "}") --depth;
        if (depth == 0 && token == "camera") camera = true;
        if (camera && token == "sky") words.sky = true;
        if (camera && token == "angle") words.angle = true;
    }
    return words;
}

std::string with_path(const std::string& text, const std::optional<Flythrough>& path, std::optional<EyeWords> given) {
    const auto slices = find_path(text);
    const EyeWords words = given ? *given : eye_words(text);
    if (!slices) {
        if (!path) return text;
        if (text.empty()) return write_flythrough(*path, words);
        return text + (text.back() == '\n' ? "\n" : "\n\n") + write_flythrough(*path, words);
    }
    const TextSlice block = slices->block;
    if (!path) return with_changes(text, {{with_space(text, block), ""}});
    const auto old = path_of(slices->music, text.substr(block.begin, block.end - block.begin));
    const std::string whole = write_flythrough(*path, words);
    const TextChange anew{block, whole.substr(0, whole.size() - 1)};
    if (!old) return with_changes(text, {anew});

    std::vector<TextChange> edits;
    if (old->duration != path->duration) edits.push_back({slices->duration, text_of(path->duration)});
    if (path->loop && !old->loop) edits.push_back({{slices->duration.end, slices->duration.end}, "  loop"});
    if (!path->loop && old->loop) edits.push_back({with_space(text, *slices->loop), ""});
    edit_keys(edits, text, *slices, old->keys, path->keys, words);
    std::string changed = with_changes(text, edits);
    const std::size_t length = changed.size() - (text.size() - (block.end - block.begin));
    // Nothing that was written in an unusual way may get lost.
    return path_of(slices->music, changed.substr(block.begin, length)) == path ? changed : with_changes(text, {anew});
}

}  // namespace strahl
