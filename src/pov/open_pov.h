// Opens scenes of POV-Ray.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "files/error.h"
#include "pov/language/interpreter_options.h"
#include "scene/scene.h"
#include "text/reading/scene_files.h"

namespace strahl::pov {

/// A difference between a file and its scene.
struct PovNote {
    Message message;  // "scene.pov:12: left out: media"
    bool left_out;    // else approximated
};

/// The places of the bodies and lights of a scene in the texts that it was made of.
struct SourceLines {
    struct BlockLine {
        std::uint32_t file = 0;           // its number in `files`
        int number = 0;                   // counted from 1
        std::optional<std::size_t> at{};  // where the word of the block stands in the scene's own text, if it does
    };
    std::vector<std::string> files{};           // their paths
    std::vector<BlockLine> bodies{}, lights{};  // by the number of the body or the light
    std::vector<std::string> names{};           // of the first bodies of a model; may be empty
};

struct OpenedPov {
    Scene scene;
    SourceLines lines{};
    bool mirrored = false;           // the scene is the file's mirror image in z
    double background_opacity = 0;   // in a picture with alpha; skies are opaque from version 3.7 on
    bool clock_used = false;         // the text asks for the clock or the number of a frame
    bool size_used = false;          // it asks for image_width or image_height
    std::vector<PovNote> notes;      // in the order of files and lines, each once
    std::vector<Message> warnings;   // about the text itself
    std::vector<std::string> files;  // all that were read, the scene's first
    /// Sums up the notes: "opens whole", "approximated: 3 things, left out: 1".
    std::string summary() const;
};

/// Reads a scene. Throws FileError, whose message says where the text is wrong.
OpenedPov open_pov(std::string text, const InterpreterOptions& options, const ReadPixels& read_pixels);

}  // namespace strahl::pov
