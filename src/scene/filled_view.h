// The view of a camera, widened to fill a picture of other proportions.
#pragma once
#include "scene/camera.h"

namespace strahl {

/// Returns the camera without its aspectratio, for a picture of `aspect` = width / height: it shows all that the camera
/// shows, in the right proportions, and more above and below or to both sides, up to 89 degrees from the middle.
Camera filled_view(const Camera& camera, double aspect);

}  // namespace strahl
