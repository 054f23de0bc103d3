// strahl view: reads the scene and opens the window.
#include "show/command_view.h"

#include "scene/motion.h"
#include "show/reload.h"
#include "show/viewer.h"
#include "text/parse.h"

namespace strahl {

int view_command(const ViewOptions& options) {
    const auto began = Viewer::Clock::now();
    std::string text = read_text(options.scene);
    const auto scene =
        std::make_shared<const Scene>(scene_for_window(text, options.scene == "-" ? "standard input" : options.scene));
    if (options.time) flight_for("--time", *scene, options.scene);
    Viewer(options, scene, std::move(text), began).run();
    return 0;
}

}  // namespace strahl
