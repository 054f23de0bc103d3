// strahl check: reads a scene and lists what is in it, or prints it as text.
#pragma once
#include <string>

#include "pov/open_scene.h"

namespace strahl {

struct CheckOptions {
    std::string scene;   // a file, or "-" for standard input
    OpeningOptions opening{};
    bool print = false;  // the scene as text instead of the summary
};

/// Returns the exit status. Throws FileError for errors in the scene, or OutputError.
int check_command(const CheckOptions& options);

}  // namespace strahl
