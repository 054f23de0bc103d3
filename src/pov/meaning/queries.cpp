#include "pov/meaning/queries.h"

#include <algorithm>

#include "pov/meaning/nearest_hit.h"
#include "pov/meaning/scene_maker.h"
#include "scene/overlap.h"

namespace strahl::pov {
namespace {

const std::vector<Primitive>& bodies_of(Interpreter& in, const Thing& thing) {
    const auto& object = dynamic_cast<const ObjectThing&>(thing);
    if (!object.made.bodies) {
        const PovContents nothing;
        object.made.bodies =
            std::make_shared<const std::vector<Primitive>>(SceneMaker(in, {}, nothing, false).bodies_of(object));
    }
    return *object.made.bodies;
}

}  // namespace

bool PovLayer::inside(Interpreter& in, const Thing& object, const DVec3& point) {
    return std::ranges::any_of(bodies_of(in, object), [&](const Primitive& body) { return contains(body, point); });
}

std::pair<DVec3, DVec3> PovLayer::extent(Interpreter& in, const Thing& object) {
    constexpr double far = 1e10;
    Box box;
    for (const Primitive& body : bodies_of(in, object)) box.add(world_bounds(body));
    if (box.empty()) return {DVec3(0), DVec3(0)};
    for (int i = 0; i < 3; ++i) {
        box.low[i] = static_cast<float>(std::max(box.low[i], -far));
        box.high[i] = static_cast<float>(std::min(box.high[i], far));
    }
    return {box.low, box.high};
}

bool PovLayer::trace(Interpreter& in, const Thing& object, const DVec3& from, const DVec3& direction, DVec3& hit,
                     DVec3& normal) {
    return nearest_hit(bodies_of(in, object), from, direction, hit, normal);
}

}  // namespace strahl::pov
