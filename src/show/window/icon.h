// The program's icon: a ball over a horizon.
#pragma once
#include "show/work/screen_image.h"

namespace strahl {

/// `size` x `size` pixels, transparent around the ball.
ScreenImage icon(int size);

}  // namespace strahl
