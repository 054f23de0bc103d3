// Draws a slider for a share of the whole.
#pragma once

namespace strahl {

/// Draws a slider from 0 to 1, into which a number can be typed after a double click or with Ctrl. Returns whether the
/// share has changed.
bool draw_share(double& share);

}  // namespace strahl
