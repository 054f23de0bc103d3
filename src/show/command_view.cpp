// The window's command: reads the scene, opens the window.
#include "show/command_view.h"

#include <iostream>

#include "show/viewer.h"
#include "text/parse.h"
#include "text/utf8.h"

namespace strahl {

int view_command(const ViewOptions& options) {
    const auto began = Viewer::Clock::now();
    std::string text = read_text(options.scene);
    const auto scene =
        std::make_shared<const Scene>(parse_scene(text, options.scene == "-" ? "standard input" : options.scene));
    if (options.time && !scene->flythrough) {
        std::cerr << "strahl: --time needs a scene with a flythrough { }, and " << printable(options.scene)
                  << " has none\n";
        return 2;
    }
    Viewer(options, scene, std::move(text), began).run();
    return 0;
}

}  // namespace strahl
