#include "scene/kinds/prism.h"

#include <algorithm>

namespace strahl {

Box Prism::bounds() const {
    const Contour::Point &middle = data->centre, &half = data->half;
    return {{middle[0] - half[0], middle[1] - half[1], std::min(base, top)},
            {middle[0] + half[0], middle[1] + half[1], std::max(base, top)}};
}

bool Prism::contains(const DVec3& p) const {
    if (!(std::min(base, top) < p.z && p.z < std::max(base, top))) return false;
    const PlaneLine<double> line{(p.x - data->centre[0]) / data->unit, (p.y - data->centre[1]) / data->unit, 1, 0};
    bool inside = false;
    cross_contours(data->pieces.data(), static_cast<int>(data->pieces.size()), line, true,
                   [&](bool crosses, double w, int) { inside ^= crosses && w > 0; });
    return inside;
}

}  // namespace strahl
