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

/// Checks a scene as `strahl check` does: returns up to ten errors, or else warnings. `files` becomes the list of files
/// that were read, unless there is an error.
std::vector<Problem> check_scene(const std::string& text, const std::string& path, std::vector<std::string>& files);

}  // namespace strahl
