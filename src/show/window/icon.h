// The program's icon: a ball.
#pragma once
#include "show/motion/screen_image.h"

namespace strahl {

/// Returns an icon of `size` x `size` pixels, transparent around the ball.
ScreenImage icon(int size);

}  // namespace strahl
