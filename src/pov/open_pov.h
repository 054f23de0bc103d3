// Opens scenes of POV-Ray.
#pragma once
#include <string>
#include <vector>

#include "pov/language/interpreter_options.h"
#include "scene/scene.h"
#include "text/reading/scene_files.h"

namespace strahl::pov {

/// A difference between a file and its scene.
struct PovNote {
    bool left_out;     // else approximated
    std::string text;  // "scene.pov:12: left out: media"
};

struct OpenedPov {
    Scene scene;
    std::vector<PovNote> notes;         // in the order of files and lines, each once
    std::vector<std::string> warnings;  // about the text itself
    std::vector<std::string> files;     // all that were read, the scene's first
    /// Sums up the notes: "opens whole", "approximated: 3 things, left out: 1".
    std::string summary() const;
};

/// Reads a scene. Throws FileError, whose message says where the text is wrong.
OpenedPov open_pov(std::string text, const InterpreterOptions& options, const ReadPixels& read_pixels);

}  // namespace strahl::pov
