// strahl check: reads scenes and lists what is in them, or prints them as text.
#pragma once
#include <string>
#include <vector>

#include "pov/open_scene.h"

namespace strahl {

struct CheckOptions {
    std::vector<std::string> scenes{};  // files, also .ini files of POV-Ray, or "-" for standard input
    OpeningOptions opening{};
    bool print = false;  // the scene as text instead of the summary
};

/// Returns the exit status. Throws FileError for errors in the only scene, or OutputError; of several scenes it prints
/// the errors and goes on with the next.
int check_command(const CheckOptions& options);

}  // namespace strahl
