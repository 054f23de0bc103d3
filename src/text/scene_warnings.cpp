#include "text/scene_warnings.h"

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

#include "files/streams.h"
#include "scene/moving_scene.h"
#include "scene/overlap.h"

namespace strahl {
namespace {

/// Returns whether some ray of the picture, of 4:3 if the camera does not say otherwise, may meet the body: one with a
/// box is out of sight if the box is behind the camera or beyond a plane through an edge of the picture, and a plane if
/// it recedes from all four corners. Cameras that see more than that may see all.
bool may_see(const Camera& camera, const Primitive& body) {
    if (camera.projection > Projection::orthographic || camera.stereo != Stereo::none) return true;
    const CameraFrame frame = frame_of(camera, 4. / 3);
    const auto& [right, down, forward, tan_x, tan_y] = frame;
    if (const auto half = half_space(body)) {
        for (const double x : {-1., 1.})
            for (const double y : {-1., 1.}) {
                const auto [start, way, seen] = camera_ray(camera.projection, frame, x, y);
                const double height = dot_product(half->normal, camera.position + start - half->point);
                if (height * dot_product(half->normal, way) <= 0) return true;
            }
        return false;
    }
    const Box box = world_bounds(body);
    if (!box.finite()) return true;
    const bool parallel = camera.projection == Projection::orthographic;
    const double x = parallel ? 0 : tan_x, y = parallel ? 0 : tan_y;
    const DVec3 edges = parallel ? tan_x * right + tan_y * down : DVec3(0);  // sums of half the sides
    const std::array sides{forward, x * forward - right, x * forward + right, y * forward - down, y * forward + down};
    return std::ranges::none_of(sides, [&](const DVec3& inwards) {
        DVec3 farthest;  // the corner of the box that is farthest inwards
        for (int i = 0; i < 3; ++i) farthest[i] = inwards[i] > 0 ? box.high[i] : box.low[i];
        return dot_product(inwards, farthest - camera.position) < -std::abs(dot_product(inwards, edges));
    });
}

/// Adds a warning if a colour is so bright that values from 0 to 255 were meant.
void check_color(const Color& color, const std::string& owner, std::vector<std::string>& warnings) {
    if (std::max({color.x, color.y, color.z}) < 100) return;
    TextStream text;
    text << "the colour <" << color.x << ", " << color.y << ", " << color.z << "> of " << owner
         << " is far above 1, which is shown as white; values from 0 to 255 must be divided by 255";
    if (std::ranges::find(warnings, text.str()) == warnings.end()) warnings.push_back(text.str());
}
void check_pigment(const Pigment& pigment, const std::string& owner, std::vector<std::string>& warnings) {
    const bool image = pigment.pattern && std::holds_alternative<ImagePattern>(pigment.pattern->kind);
    if (!image) check_color(pigment.color, owner, warnings);
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& moving) {
    std::optional<Scene> at_start;
    if (Movers(moving).any()) at_start = at(moving, 0);
    const Scene& scene = at_start ? *at_start : moving;
    const Camera camera = own_camera_at(moving, 0);
    std::vector<std::string> warnings;
    const auto& bodies = scene.primitives;
    if (scene.lights.empty() && !bodies.empty())
        warnings.emplace_back("the scene has no light; its bodies show only their share of the ambient light");
    if (!bodies.empty() && std::ranges::none_of(bodies, [&](const Primitive& body) { return may_see(camera, body); }))
        warnings.emplace_back("the camera sees no body; all are behind it or beside its picture");
    for (const Material& material : scene.materials) check_pigment(material.rgb, "a material", warnings);
    for (const Light& light : scene.lights) check_color(light.color, "a light", warnings);
    check_pigment(scene.background, "the background", warnings);
    return warnings;
}

}  // namespace strahl
