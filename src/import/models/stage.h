// A place to look at a model: a camera, light, and a floor.
#pragma once
#include "import/models/model.h"

namespace strahl {

/// Makes a scene of a model. The camera looks at it from the front, from one side and a little from above, and sees all
/// of it in a picture of width / height = `aspect`. A flight leads around it once. Three parallel lights shine on it:
/// the strongest from beside the camera, a weak one from its other side, one from behind. The background has the colour
/// of the floor, so that no horizon is seen. What the file says of cameras and lights takes the place of these; then
/// there is no floor.
Scene staged(const Model& model, double aspect);

}  // namespace strahl
