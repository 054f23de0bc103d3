// Scene -> POV-Ray scene and the .ini that renders it.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace strahl {

struct PovRequest {
    std::string title{};            // what the scene is called, for the comment at the top
    std::string pov_path{};         // of the scene file, as the .ini shall name it
    std::string picture_path{};     // a .png
    std::vector<Camera> cameras{};  // one for a still; one per frame for an animation
    double fps = 0;                 // of the animation
    int width = 640, height = 480;
    int depth = 20;  // generations of rays
    int bits = 16;   // per channel, 8 or 16
};

/// Both files, and in `warnings` what POV-Ray can't express exactly (also told in the scene's own comments).
struct PovFiles {
    std::string pov, ini;
    std::vector<std::string> warnings;
};

/// The picture that POV-Ray 3.7 makes of these is the one that strahl makes, up to rounding: term by term, with the
/// camera's axes written out, so that it doesn't matter which way round the world's axes are.
PovFiles write_pov(const Scene& scene, const PovRequest& request);

}  // namespace strahl
