// The list of the kinds of bodies. All that treats kinds alike derives from it: parser, writer, check, manual, builder,
// kernels and the files they are compiled in, the POV-Ray converter, the referee and the tests.
#pragma once
#include <variant>

#include "scene/box.h"
#include "scene/cone.h"
#include "scene/cylinder.h"
#include "scene/disc.h"
#include "scene/kind.h"
#include "scene/mesh.h"
#include "scene/plane.h"
#include "scene/smooth_triangle.h"
#include "scene/sphere.h"
#include "scene/torus.h"
#include "scene/triangle.h"

namespace strahl {

using Shape = std::variant<Sphere, Plane, Cylinder, Cone, Cuboid, Disc, Torus, Triangle, SmoothTriangle, Mesh>;

using Forms = FormsOf<Shape>::Type;

}  // namespace strahl
