// strahl view: reads the scene and opens the window.
#include "main/commands/command_view.h"

#include "files/read_file.h"
#include "scene/moving_scene.h"
#include "show/viewer.h"
#include "text/parse.h"

namespace strahl {
namespace {

Loaded load_first(const ViewOptions& options, std::string& text) try {
    const std::string& path = options.scene;
    text = read_text(path);
    const std::string name = path == "-" ? "standard input" : path;
    return {path, std::make_shared<const Scene>(scene_for_window(text, name)), "", true};
} catch (const FileError& error) {
    if (options.scene == "-" || options.play) throw;  // nobody mends it
    return {options.scene, nullptr, error.what(), true};
}

}  // namespace

int view_command(const ViewOptions& options, const std::atomic<bool>* interrupted) {
    const auto began = Pace::Clock::now();
    std::string text;
    const Loaded loaded = load_first(options, text);
    if (loaded.scene && options.time) flight_for("--time", *loaded.scene, options.scene);
    if (loaded.scene && options.rocket && followed_tracks(*loaded.scene).empty())
        throw UsageError("--rocket needs a scene with a track, and " + options.scene + " has none");
    std::unique_ptr<Rocket> rocket;
    if (options.rocket) rocket = std::make_unique<Rocket>(*options.rocket);
    try {
        return Viewer(options, loaded, std::move(text), began, std::move(rocket)).run(*interrupted);
    } catch (const WindowError&) {
        if (!loaded.scene) throw FileError(loaded.fault);
        throw;
    }
}

}  // namespace strahl
