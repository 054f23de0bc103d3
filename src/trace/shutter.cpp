#include "trace/shutter.h"

#include <algorithm>

#include "scene/moving_scene.h"
#include "trace/world/build_world.h"

namespace strahl {
namespace {

constexpr int most_moments = 128, fewest_moments = 16;
constexpr std::int64_t most_surfaces = 1 << 20;  // of all moments together, unless these are the fewest

}  // namespace

std::shared_ptr<const std::vector<Shot>> shutter_moments(const Scene& scene, double time, double seconds,
                                                         const std::function<Camera(double time)>& camera) {
    if (!(seconds > 0)) return nullptr;
    const bool moves = Movers(scene).any();
    int count = most_moments;
    if (moves)
        while (count > fewest_moments && count * surfaces_apart(scene) > most_surfaces) count /= 2;
    std::vector<Shot> moments;
    for (int i = 0; i < count; ++i) {
        const double moment = time + ((i + .5) / count - .5) * seconds;
        moments.push_back({camera(moment), moment});
    }
    const auto same = [&](const Shot& moment) { return moment.camera == moments[0].camera; };
    if (!moves && std::ranges::all_of(moments, same)) return nullptr;
    return std::make_shared<const std::vector<Shot>>(std::move(moments));
}

}  // namespace strahl
