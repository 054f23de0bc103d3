// Where in the window the picture is, and what it shows there.
#pragma once
#include "scene/camera.h"

namespace strahl {

/// A rectangle of the window, in pixels from its top left corner.
struct ScreenArea {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const ScreenArea&) const = default;
};

/// The largest area with this width / height, in the middle of the window.
ScreenArea fitted(double aspect, int window_width, int window_height);

/// The picture of a window.
struct Framing {
    ScreenArea area;
    Camera camera;
};
/// A camera with an aspectratio keeps it, and the rest of the window stays dark; if the picture is to `fill` the
/// window the view is widened instead, so that nothing is cut off. A camera without one fills the window anyway.
Framing framing(const Camera& camera, int window_width, int window_height, bool fill);

}  // namespace strahl
