// Checks the text of a scene, and says where in it each error and each warning is.
#pragma once
#include <string>
#include <vector>

#include "files/error.h"

namespace strahl {

struct Problem {
    bool warning;  // else an error
    Message message;
};

/// Checks a scene as `strahl check` does: returns up to ten errors, or else warnings. Of a .pov each block of the top
/// level has one error at most. `files` becomes the list of files that were read, unless errors leave nothing to read.
std::vector<Problem> check_scene(const std::string& text, const std::string& path, std::vector<std::string>& files);

}  // namespace strahl
