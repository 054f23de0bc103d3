// Follows some of the camera's rays, to tell what is seen: by the camera, through clear bodies, and in mirrors.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace strahl::pov {

/// Is this the material of surfaces that are not there, such as those where a body is clipped?
bool shows_nothing(const Material& material);

/// Finds places that the camera sees, once they are asked for.
class SeenPlaces {
  public:
    explicit SeenPlaces(const Scene& scene) : scene(scene) {}

    /// A place where a ray meets the surface of a body that no opaque body hides.
    struct Place {
        DVec3 p, normal;
        std::size_t body;
        std::optional<std::size_t> other{};    // another body that has a surface there
        int material = 0, other_material = 0;  // if there is one, the materials of both
    };
    const std::vector<Place>& places();
    /// Returns from how many of them a light is seen that no opaque body hides, but for what is nearer to it than
    /// `close`.
    std::size_t reached_by(const DVec3& light, double close);
    /// Are so many places a share of the picture that counts, a four-hundredth?
    bool counts(std::size_t some) {
        if (some == 0) return false;
        places();
        return rays > 0 && some * 400 >= rays;
    }

  private:
    void follow_rays();

    const Scene& scene;
    std::size_t rays = 0;
    std::optional<std::vector<Place>> all;
};

}  // namespace strahl::pov
