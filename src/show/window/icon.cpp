// Draws the icon: a shaded sphere with a highlight, as the tracer would show it from far away.
#include "show/window/icon.h"

#include <algorithm>
#include <cmath>

#include "num/vec_math.h"

namespace strahl {

ScreenImage icon(int size) {
    ScreenImage image;
    image.resize(size, size);
    const DVec3 light = normalize(DVec3(-2, 3, 4));
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double radius = 0.48 * size, u = (x + 0.5 - size / 2.) / radius, v = (size / 2. - y - 0.5) / radius;
            const double away = std::hypot(u, v);
            const DVec3 normal(u, v, std::sqrt(std::max(0., 1 - away * away)));
            const double cosine = std::max(0., dot_product(normal, light));
            const double mirrored = std::max(0., 2 * cosine * normal.z - light.z);  // cosine: that light and the eye
            const DVec3 color = DVec3(.95, .35, .1) * (.15 + .8 * cosine) + DVec3(std::pow(mirrored, 30));
            const auto code = [](double value) { return std::uint32_t(std::lround(255 * std::clamp(value, 0., 1.))); };
            image.pixels[std::size_t(y) * size + x] =
                code(color.x) | code(color.y) << 8 | code(color.z) << 16 | code((1 - away) * radius + 0.5) << 24;
        }
    return image;
}

}  // namespace strahl
