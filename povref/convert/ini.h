// Writes the .ini file that makes POV-Ray render a scene.
#pragma once
#include <string>

#include "povref/convert/pov_scene.h"

namespace strahl {

/// Properties of the scene that need options in the .ini file.
struct IniNeeds {
    bool inside = false;    // a camera is in a transparent body
    bool keyword = false;   // some material uses `refraction`
    bool moves = false;     // bodies or lights move, in an animation
    bool pictures = false;  // there are picture files beside the scene
};

/// Throws UsageError for a name that an .ini file cannot hold.
std::string ini_of(const Scene& scene, const PovRequest& request, const IniNeeds& needs);

/// Returns the path of the .ini file beside a .pov file.
std::string ini_beside(const std::string& pov_path);

}  // namespace strahl
