#include "scene/kinds/lathe.h"

#include <algorithm>

namespace strahl {

bool Lathe::open() const {
    return std::ranges::any_of(data->contours, [](const Contour& own) {
        const Contour::Point end = own.strokes.empty() ? own.start : own.strokes.back().end;
        return end != own.start && !(end[0] == 0 && own.start[0] == 0);
    });
}

Box Lathe::bounds() const {
    const Contour::Point &middle = data->centre, &half = data->half;
    return {{-half[0], middle[1] - half[1], -half[0]}, {half[0], middle[1] + half[1], half[0]}};
}

bool Lathe::contains(const DVec3& p) const {
    const double radius = std::hypot(p.x, p.z) / data->unit;
    const PlaneLine<double> line{radius, (p.y - data->centre[1]) / data->unit, 1, 0};
    bool inside = false;
    cross_contours(data->pieces.data(), face_count(), line, true,
                   [&](bool crosses, double w, int) { inside ^= crosses && (w > 0 || w < -2 * radius); });
    return inside;
}

std::shared_ptr<const ContourData> Lathe::usual() {
    static const auto shared = std::make_shared<const ContourData>(
        std::vector<Contour>{{{0, 0}, {{{.5, 0}, {.5, 0}}, {{.2, .5}, {.4, 1}}, {{.3, 1.4}, {0, 1.2}, {{.1, .9}}}}}},
        true);
    return shared;
}

}  // namespace strahl
