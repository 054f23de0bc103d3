// Vectors of three components, of scalars or packs: positions, directions and colours.
#pragma once
#include <glm/vec3.hpp>

namespace strahl {

template <class S>
using Vec3 = glm::vec<3, S, glm::defaultp>;
using DVec3 = Vec3<double>;
using Color = Vec3<double>;  // linear red, green, blue; 1 is the brightest a picture shows

}  // namespace strahl
