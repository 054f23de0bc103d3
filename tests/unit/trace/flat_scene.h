// Scenes that show colours as they are, and their pictures.
#pragma once
#include <cmath>
#include <string>

#include "text/parse.h"
#include "trace/tracer.h"

namespace strahl {

/// A scene that shows colours as they are, seen along -z from above.
inline Scene flat(const std::string& bodies, double width = 8, const std::string& at = "0, 0, 0") {
    return parse_scene(
        "global_settings { ambient_light <1, 1, 1> }\n"
        "defaultmaterial { ambient 1  diffuse 0  reflection 0  specular 0 }\n"
        "camera { position <0, 0, 100>  look_at <" +
            at + ">  sky <0, 1, 0>  fov " + std::to_string(std::atan(width / 200) * 57.29577951308232) + " }\n" +
            bodies,
        "flat");
}
inline Frame picture(const Scene& scene, Precision precision = Precision::float64, int width = 64, int height = 48) {
    return render(scene,
                  {.camera = scene.camera, .width = width, .height = height, .depth = scene.settings.max_trace_level},
                  precision, 2);
}
/// Counts the values that differ by more than `tolerance`.
inline int different(const Frame& a, const Frame& b, double tolerance) {
    int count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) count += !(std::abs(a.rgb[i] - b.rgb[i]) <= tolerance);
    return count;
}
inline const std::string floor_points = "<0, 0, 0>, <1, 0, 0>, <0, 1, 0>";

}  // namespace strahl
