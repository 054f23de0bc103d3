// Computes the proportions of the picture in the window.
#include "show/session/framing.h"

#include <algorithm>
#include <cmath>

#include "scene/camera.h"

namespace strahl {

ScreenArea fitted(double aspect, int window_width, int window_height) {
    const double columns = window_width, rows = window_height;
    const int width = std::clamp(static_cast<int>(std::lround(std::min(columns, rows * aspect))), 1, window_width);
    const int height = std::clamp(static_cast<int>(std::lround(std::min(rows, columns / aspect))), 1, window_height);
    return {(window_width - width) / 2, (window_height - height) / 2, width, height};
}

bool same_picture(const View& a, const View& b) {
    return a.camera == b.camera && a.width == b.width && a.height == b.height && a.depth == b.depth &&
           a.time == b.time && a.tracks == b.tracks &&
           (a.moments == b.moments || (a.moments && b.moments && *a.moments == *b.moments));
}

Framing framing(const Camera& camera, int window_width, int window_height, bool fill) {
    const ScreenArea whole{0, 0, window_width, window_height};
    if (!camera.aspectratio) return {whole, camera};
    if (!fill) return {fitted(*camera.aspectratio, window_width, window_height), camera};
    return {whole, filled_view(camera, double(window_width) / window_height)};
}

}  // namespace strahl
