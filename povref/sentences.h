// What each kind of shape is called in POV-Ray: one sentence per kind.
#pragma once
#include <string>
#include <type_traits>

#include "num/decimal.h"
#include "scene/kinds.h"

namespace strahl {

// A sentence is an object without its closing brace, in the shape's own space.

inline std::string sentence(const Sphere& sphere) {
    return "sphere { " + text_of(sphere.centre) + ", " + text_of(sphere.radius);
}

/// POV-Ray's inside is normal . p < distance: the half-space behind the normal, as here.
inline std::string sentence(const Plane& plane) {
    const DVec3 n = plane.normal();
    return "plane { " + text_of(n) + ", " + text_of(n.x * plane.a.x + n.y * plane.a.y + n.z * plane.a.z);
}

inline std::string sentence(const Cylinder& cylinder) {
    return "cylinder { " + text_of(cylinder.base) + ", " + text_of(cylinder.cap) + ", " + text_of(cylinder.radius);
}

template <class Kind>
std::string sentence(const Kind&) {
    static_assert(!std::is_same_v<Kind, Kind>, "this kind of shape needs its POV-Ray sentence in povref/sentences.h");
    return {};
}

inline std::string sentence(const Shape& shape) {
    return std::visit([](const auto& kind) { return sentence(kind); }, shape);
}

}  // namespace strahl
