// Keeps the scene as it is at the moment that the window shows.
#pragma once
#include <memory>
#include <vector>

#include "scene/moving_scene.h"
#include "scene/scene.h"
#include "trace/world/view.h"

namespace strahl {

class SceneMoment {
  public:
    /// Returns a scene at the moment of a view, valid until the next call. Bodies are moved only if the moment is
    /// another one than in the last call.
    const Scene& at(const std::shared_ptr<const Scene>& scene, const View& view);

  private:
    struct SeenMoment {
        std::shared_ptr<const Scene> scene;
        double time = 0;
        std::shared_ptr<const std::vector<Track>> tracks;
        bool operator==(const SeenMoment&) const = default;
    };
    std::shared_ptr<const Scene> still;  // a scene in which nothing moves
    SeenMoment seen;                     // the one of `now`
    Scene now;
};

}  // namespace strahl
