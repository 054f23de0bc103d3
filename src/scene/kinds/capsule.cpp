#include "scene/kinds/capsule.h"

#include <cmath>

namespace strahl {

Capsule capsule_around(const Box& box) {
    const DVec3 middle = box.centre(), size = box.size();
    const int along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    Capsule capsule{middle, middle, std::hypot(size[(along + 1) % 3], size[(along + 2) % 3]) / 2};
    capsule.from[along] = box.low[along], capsule.to[along] = box.high[along];
    return capsule;
}

}  // namespace strahl
