// The camera's path as it is seen in the picture.
#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "scene/camera.h"
#include "trace/world/view.h"

namespace strahl {

/// The path as lines, its keys, and where the camera of the flight is, in pixels of the view's picture; of the keys and
/// of that camera also lines in the directions in which they look.
struct PathMarks {
    std::vector<std::vector<glm::dvec2>> lines, looks;
    std::vector<glm::dvec2> keys;
    std::optional<glm::dvec2> now;
};
/// Makes the marks of a path with keys. `time` is the moment of the flight, if there is one under way or paused. What
/// is not in front of the camera, or around it, has none.
PathMarks path_marks(const Flythrough& path, const Camera& scene_camera, std::optional<double> time, const View& view);

}  // namespace strahl
