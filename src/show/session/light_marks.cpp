#include "show/session/light_marks.h"

#include <algorithm>
#include <cmath>

#include "num/vec_math.h"
#include "show/session/handles.h"

namespace strahl {
namespace {

constexpr std::size_t most_marks = 500;

}  // namespace

DVec3 position_of(const Scene& scene, const LightPoint& point) {
    const Light& light = scene.lights[std::size_t(point.light)];
    return point.target && light.spot ? light.spot->look_at : light.position;
}

LightMarks light_marks(const Scene& scene, const View& view) {
    LightMarks all;
    for (std::size_t i = 0; i < scene.lights.size() && all.marks.size() < most_marks; ++i) {
        const Light& light = scene.lights[i];
        if (light.direction) continue;
        const double strongest = std::max({light.color.x, light.color.y, light.color.z, 1e-9});
        const auto mark = [&](bool target) {
            const LightPoint at{static_cast<int>(i), target};
            if (const auto place = place_in(view, position_of(scene, at)))
                all.marks.push_back({at, *place, max(light.color, Color(0)) / strongest});
        };
        mark(false);
        if (!light.spot) continue;
        mark(true);
        const auto line = [&](const std::vector<DVec3>& points) {
            std::vector<glm::dvec2> places;
            for (const DVec3& point : points)
                if (const auto place = place_in(view, point)) places.push_back(*place);
            if (places.size() == points.size()) all.lines.push_back(std::move(places));
        };
        line({light.position, light.spot->look_at}),
            line(cone_circle(light.position, *light.spot, light.spot->falloff));
    }
    return all;
}

std::optional<LightPoint> mark_at(const LightMarks& marks, const glm::dvec2& point, double reach) {
    std::optional<LightPoint> nearest;
    for (const LightMark& mark : marks.marks) {
        const double distance = std::hypot(mark.place.x - point.x, mark.place.y - point.y);
        if (distance <= reach) reach = distance, nearest = mark.at;
    }
    return nearest;
}

}  // namespace strahl
