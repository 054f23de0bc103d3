// The place of the picture in the window, and the camera that fits it.
#pragma once
#include "scene/camera.h"
#include "trace/world/view.h"

namespace strahl {

/// A rectangle of the window, in pixels from its top left corner.
struct ScreenArea {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const ScreenArea&) const = default;
};

/// Returns the largest area of this width / height, in the middle of the window.
ScreenArea fitted(double aspect, int window_width, int window_height);

/// Do two views show the same picture of a scene, but for the light that they leave out?
bool same_picture(const View& a, const View& b);

/// The area of the window that the picture takes, and the camera it is traced with.
struct Framing {
    ScreenArea area;
    Camera camera;
};
/// Fits the picture into the window. A camera with an aspectratio keeps it, and the rest of the window stays dark; with
/// `fill` the view is widened instead, so that nothing is cut off. A camera without one fills the window anyway.
Framing framing(const Camera& camera, int window_width, int window_height, bool fill);

}  // namespace strahl
