#include "pov/open_scene.h"

#include <algorithm>

#include "pov/expand.h"
#include "text/parse.h"
#include "text/reading/other_files.h"

namespace strahl {

bool is_pov(const std::string& path) { return path.ends_with(".pov") || path.ends_with(".POV"); }

OpenedScene open_scene(const std::string& text, const std::string& path, const OpeningOptions& options,
                       const ReadPixels& read_pixels, FilesRead* read) {
    pov::InterpreterOptions how;
    how.file = path, how.library = options.library;
    for (const std::string& folder : pov::standard_library()) how.library.push_back(folder);
    how.clock = options.clock;
    if (!is_pov(path)) {
        FilesRead own;
        FilesRead& files = read ? *read : own;
        const std::string name = path == "-" ? "standard input" : path;
        OpenedScene result;
        refuse_other_files(text, name);
        if (pov::has_directives(text)) {
            const pov::ExpandedText expanded = pov::expand(text, how);
            result.scene = parse_scene(expanded.text, name, {}, read_pixels, &files, expanded.origins);
            result.files = expanded.files;
        } else {
            result.scene = parse_scene(text, name, {}, read_pixels, &files);
        }
        result.notes = files.warnings;
        return result;
    }
    pov::OpenedPov opened = open_pov(text, how, read_pixels);
    OpenedScene result{.scene = std::move(opened.scene),
                       .summary = opened.summary(),
                       .lines = std::move(opened.lines),
                       .mirrored = opened.mirrored,
                       .files = std::move(opened.files)};
    for (const pov::PovNote& note : opened.notes) result.notes.push_back(note.text);
    if (!options.strict || result.notes.empty()) return result;
    constexpr std::size_t most = 10;
    std::string all = "the scene cannot be shown as it is meant";
    for (std::size_t i = 0; i < std::min(most, result.notes.size()); ++i) all += "\n" + result.notes[i];
    if (result.notes.size() > most) all += "\nand " + std::to_string(result.notes.size() - most) + " more";
    throw FileError(all);
}

}  // namespace strahl
