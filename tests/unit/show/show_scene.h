// A scene as the window holds it.
#pragma once
#include <memory>
#include <string>

#include "text/parse.h"

namespace strahl {

inline const std::string scene_text = R"(
camera { position <5,-20,18> look_at <0,0,0> up <0,0,-1> fov 12 }
light { position <-5,0,10> color <.9,.9,.9> }
sphere { <0,0,2>, 2 material { rgb <1,.2,.2> } }
sphere { <2.5,-2,1>, 1 material { rgb <.2,1,.2> refraction .6 ior 1.3 } }
plane { <0,0,0>, <1,0,0>, <0,1,0> }
)";
inline std::shared_ptr<const Scene> shown_scene(const std::string& more = "") {
    return std::make_shared<const Scene>(parse_scene(scene_text + more, "test"));
}

}  // namespace strahl
