// Converts a scene to a POV-Ray scene, and an .ini file that renders it.
#pragma once
#include <string>
#include <vector>

#include "povref/convert/images.h"
#include "scene/scene.h"

namespace strahl {

struct PovRequest {
    std::string title{};            // for the comment at the top
    std::string pov_path{};         // of the scene file, as the .ini names it
    std::string picture_path{};     // a .png
    std::vector<Camera> cameras{};  // one for a still; one per frame for an animation
    double fps = 0;                 // of the animation
    double time = 0;                // of moving bodies, in a still
    int width = 640, height = 480;
    int depth = 20;  // generations of rays
    int bits = 16;   // per channel, 8 or 16
    int grid = 0;    // n > 0, for run_povray: the average of n x n rays in each pixel and the one through its middle
};

/// Both files, and warnings of what POV-Ray cannot express exactly, which are also in the scene's comments.
struct PovFiles {
    std::string pov, ini;
    std::vector<std::string> warnings;
    std::vector<PovPicture> pictures;
};
/// Writes all files: the pictures into the folder of the .pov.
void write(const PovFiles& files, const std::string& pov_path);

/// Converts a scene. POV-Ray 3.7 renders it to the same picture as Strahl, up to rounding: the scene is equal term by
/// term, and its camera's axes are written out, so that the handedness of the world does not matter.
PovFiles write_pov(const Scene& scene, const PovRequest& request);

/// Returns the block of a camera for pictures of these proportions (width / height); `mirrored` in z.
std::string pov_camera(const Camera& camera, double aspect, bool mirrored);

}  // namespace strahl
