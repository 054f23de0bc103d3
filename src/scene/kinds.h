// The list of the kinds of bodies. All that treats kinds alike derives from it: parser, writer, check, manual, builder,
// kernels and the files they are compiled in, the POV-Ray converter, the referee and the tests.
#pragma once
#include <variant>

#include "scene/box.h"
#include "scene/composite.h"
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

using Shape = std::variant<Sphere, Plane, Cylinder, Cone, Cuboid, Disc, Torus, Triangle, SmoothTriangle, Mesh, Union,
                           Intersection, Difference>;

/// May it be a part of a composite? Meshes may, if they are closed.
bool fits_composite(const Shape& shape);
/// How many simple bodies a shape consists of.
int leaves_of(const Shape& shape);

using Forms = FormsOf<Shape>::Type;

}  // namespace strahl
