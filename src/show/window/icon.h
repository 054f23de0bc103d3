// The program's icon: a ball.
#pragma once
#include "show/motion/screen_image.h"

namespace strahl {

/// Returns an icon of `size` x `size` pixels, transparent around the ball. Red is in the lowest bits, as GLFW takes it.
ScreenImage icon(int size);

}  // namespace strahl
