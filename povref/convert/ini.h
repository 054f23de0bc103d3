// The .ini file that has POV-Ray render a scene.
#pragma once
#include <string>

#include "povref/convert/pov_scene.h"

namespace strahl {

/// What the .ini has to care for.
struct IniNeeds {
    bool inside = false;    // a camera is in a transparent body
    bool keyword = false;   // some material uses `refraction`
    bool moves = false;     // bodies or lights do, in an animation
    bool pictures = false;  // there are some beside the scene
};

/// Throws UsageError if a name can't be said in an .ini.
std::string ini_of(const Scene& scene, const PovRequest& request, const IniNeeds& needs);

/// Its path, from that of the scene.
std::string ini_beside(const std::string& pov_path);

}  // namespace strahl
