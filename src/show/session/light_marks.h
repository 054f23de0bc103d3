// Marks that show where lights are, and where spotlights are aimed.
#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "trace/world/view.h"

namespace strahl {

/// A point of a light that the user can choose and drag: where the light is, or the target of its spot.
struct LightPoint {
    int light = 0;  // its number in Scene::lights
    bool target = false;
    bool operator==(const LightPoint&) const = default;
};
/// Returns where it is in a scene.
DVec3 position_of(const Scene& scene, const LightPoint& point);

struct LightMark {
    LightPoint at;
    glm::dvec2 place{0};  // in pixels of the view's picture
    Color color{1};
};
/// Shows the lights of a scene: by marks, and by lines from spots to their targets with a circle at the end of their
/// cones.
struct LightMarks {
    std::vector<LightMark> marks;
    std::vector<std::vector<glm::dvec2>> lines;
};
/// Makes the marks of a scene's lights. Parallel lights are nowhere, and have none. Of more than 500 lights only the
/// first ones have one.
LightMarks light_marks(const Scene& scene, const View& view);
/// Returns the nearest mark to a point that is no further than this.
std::optional<LightPoint> mark_at(const LightMarks& marks, const glm::dvec2& point, double reach);

}  // namespace strahl
