// Keeps the gallery's small pictures on the disk, in $XDG_CACHE_HOME/strahl or ~/.cache/strahl.
#pragma once
#include <string>
#include <vector>

#include "show/motion/screen_image.h"

namespace strahl {

/// A small picture of a scene at the start of its flight, as the window would show it.
struct SmallPicture {
    ScreenImage image{};               // empty if the scene cannot be read
    std::string fault{};               // why the scene cannot be read, or ""
    std::vector<std::string> files{};  // all that were read for it
};

/// Returns the picture of a scene that is kept in this size; an empty one if there is none, or if the program
/// or a file that was read for it has changed since.
ScreenImage kept_picture(const std::string& scene, int width, int height);
/// Keeps a picture in place of an older one of the scene. Does nothing if that cannot be written.
void keep_picture(const std::string& scene, const SmallPicture& picture);

}  // namespace strahl
