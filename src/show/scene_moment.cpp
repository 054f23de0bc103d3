#include "show/scene_moment.h"

namespace strahl {

const Scene& SceneMoment::at(const std::shared_ptr<const Scene>& scene, const View& view) {
    if (still == scene) return *still;
    const SeenMoment wanted{scene, view.time, view.tracks};
    if (seen == wanted) return now;
    seen = wanted;
    if (!Movers(*scene).any()) return *(still = scene);
    now = *scene;
    if (view.tracks) now.tracks = *view.tracks;
    return now = strahl::at(now, view.time);
}

}  // namespace strahl
