// Shared by the tests of flights: scenes seen by one camera, and a path.
#pragma once
#include <memory>
#include <string>

#include "num/vec_math.h"
#include "show/session/session.h"
#include "text/parse.h"

namespace strahl {

inline const Camera camera{{5, -20, 18}, {0, 0, 0}, {0, 0, -1}, 25, {}};

inline double distance(const DVec3& a, const DVec3& b) { return length(a - b); }

inline std::shared_ptr<const Scene> scene_of(const std::string& more) {
    return std::make_shared<const Scene>(
        parse_scene("camera { position <5,-20,18> look_at <0,0,0> up <0,0,-1> fov 25 }\n" + more, "test"));
}

inline const std::string path_text =
    "flythrough { duration 4 key { time 0 position <1,0,0> look_at <0,0,0> }"
    " key { time 2 position <0,2,0> look_at <0,0,1> } key { time 4 position <-3,0,0> look_at <0,0,0> } }";

}  // namespace strahl
