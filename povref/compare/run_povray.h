// Runs POV-Ray.
#pragma once
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "image/picture.h"
#include "povref/convert/pov_scene.h"

namespace strahl {

/// Thrown when `stop` became true.
struct Stopped {};

struct PovRun {
    Picture picture;       // values clamped, in 16 bits
    double seconds = 0;    // its "Trace Time"
    std::string warnings;  // its warnings, except about the keyword `refraction`
};

/// Renders the one camera of `request`, whose paths are ignored. `threads` 0 means all processors. Throws
/// std::runtime_error with advice if povray is not installed, or with its messages if it fails. When `stop` becomes
/// true it ends povray, removes its files, and throws Stopped.
PovRun run_povray(const Scene& scene, PovRequest request, int threads, const std::atomic<bool>* stop = nullptr);

/// A part of a picture: its first and last columns and rows, counted from 0.
struct PicturePart {
    int left, top, right, bottom;
};

/// A scene file of POV-Ray's own, as it is.
struct PovFile {
    std::string path;
    int width = 320, height = 240;
    double gamma = 0;                    // the `assumed_gamma` of its scene
    std::vector<std::string> library{};  // folders of included files
    std::optional<double> clock{};
    int grid = 0;  // n > 0: as in PovRequest
    /// If given, this camera of the Scene that was made of the file replaces the file's own. `mirrored`: that scene is
    /// the file's mirror image in z.
    std::optional<Camera> camera{};
    bool mirrored = false;
    double moved = 0;      // > 0: averages of that ray and one up to so many pixels beside it, instead of a grid
    bool by_tree = false;  // bodies are found by POV-Ray's other hierarchy of boxes
    std::optional<PicturePart> part{};  // if given, only this is rendered, and the rest of the picture is black
};

/// Renders a file with the files of its folder; without a grid one ray through the middle of each pixel. What the scene
/// writes in its folder is kept in a temporary one, and elsewhere it cannot write. Throws as run_povray does.
PovRun run_povray_file(const PovFile& file, int threads, const std::atomic<bool>* stop = nullptr);

}  // namespace strahl
