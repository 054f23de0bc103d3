// Names the files that the program keeps for its user.
#pragma once
#include <string>

namespace strahl::os {

/// Returns the path of a file below the folder that an environment variable names, or else below `usual` of the home
/// folder (XDG Base Directory Specification 0.8); empty if neither the variable nor HOME is set.
std::string user_file(const char* variable, const char* usual, const char* name);

}  // namespace strahl::os
