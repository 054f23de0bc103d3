// strahl view: reads the scene and opens the window.
#include "main/commands/command_view.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "files/error.h"
#include "show/viewer.h"

namespace strahl {

bool window_possible() {
    const auto set = [](const char* name) { return std::getenv(name) && *std::getenv(name); };
    return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

int view_command(const ViewOptions& options, const std::atomic<bool>* interrupted) {
    if (options.list_keys) {
        const KeysRead read = user_keys();
        std::fputs(write_keys(read.keys).c_str(), stdout);
        return read.faults.empty() ? 0 : throw FileError(read.faults);
    }
    const auto began = Pace::Clock::now();
    OpeningOptions opening = options.opening;
    opening.time = options.time;
    opening.size = options.size.value_or(first_window_size(4. / 3));
    auto file = std::make_unique<Reload>(options.scene, opening);
    // The window does not wait longer than this for a scene.
    const bool none = options.scene.empty();
    Loaded loaded = file->take(none ? 0 : 0.4).value_or(Loaded{.path = options.scene});
    if (!loaded.fault.empty() && error_is_final(options)) throw FileError(loaded.fault);
    if (loaded.scene) check_options(options, *loaded.scene);
    try {
        return Viewer(options, loaded, file, began).run(*interrupted);
    } catch (const WindowError&) {
        if (!loaded.scene && loaded.fault.empty() && !none) loaded = file->take(10).value_or(loaded);
        if (!loaded.fault.empty()) throw FileError(loaded.fault);
        if (loaded.scene) check_options(options, *loaded.scene);
        throw;
    }
}

}  // namespace strahl
