// The values of lights, of the camera and of the background as a scene's text gives them.
#pragma once
#include <string>

#include "scene/scene.h"
#include "text/body_text.h"

namespace strahl {

/// The name of the value that is the point at which a spotlight is aimed.
inline constexpr const char* spot_target = "look_at of spot";
/// The names of the angles of a spotlight's cone.
inline constexpr const char *spot_radius = "radius of spot", *spot_falloff = "falloff of spot";

/// Returns what a text without errors says of a light; `scene` is that of the text. If the text is empty, as for scenes
/// that come from elsewhere, values cannot be changed.
BodyText light_text(const std::string& text, const Scene& scene, int light);
/// Returns likewise what it says of the camera, or of the background, whose block may be missing.
BodyText camera_values(const std::string& text, const Scene& scene);
BodyText background_values(const std::string& text, const Scene& scene);

}  // namespace strahl
