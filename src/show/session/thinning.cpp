// Adds keys where a path is farthest from a flight (as Ramer 1972 and Douglas and Peucker 1973 do with straight lines).
#include "show/session/thinning.h"

#include <algorithm>
#include <cmath>

#include "num/vec_math.h"
#include "show/session/path_editor.h"

namespace strahl {

Thinned thinned(const std::vector<CameraMoment>& moments, const Camera& scene_camera, double tolerance) {
    const auto key = [&](std::size_t i) {
        return key_of(moments[i].camera, scene_camera, rounded_time(moments[i].time - moments[0].time));
    };
    Thinned result;
    result.path = with_key(with_key({}, key(0)), key(moments.size() - 1));
    std::vector<bool> is_key(moments.size());
    is_key.front() = is_key.back() = true;
    while (true) {
        std::size_t farthest = 0;
        double most = -1;
        result.error = 0;
        for (std::size_t i = 0; i < moments.size(); ++i) {
            const Camera at = camera_at(result.path, scene_camera, moments[i].time - moments[0].time);
            const double away = std::max(length(at.position - moments[i].camera.position),
                                         length(at.look_at - moments[i].camera.look_at));
            result.error = std::max(result.error, away);
            if (!is_key[i] && away > most) most = away, farthest = i;
        }
        if (result.error <= tolerance || most < 0) return result;
        is_key[farthest] = true;
        result.path = with_key(std::move(result.path), key(farthest));
    }
}

}  // namespace strahl
