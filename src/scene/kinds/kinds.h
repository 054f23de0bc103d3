// The list of the kinds of bodies. All that treats kinds alike derives from it: parser, writer, check, manual, builder,
// kernels and the files they are compiled in, the POV-Ray converter, the referee and the tests.
#pragma once
#include <variant>

#include "scene/kinds/box.h"
#include "scene/kinds/composite.h"
#include "scene/kinds/cone.h"
#include "scene/kinds/cylinder.h"
#include "scene/kinds/disc.h"
#include "scene/kinds/kind.h"
#include "scene/kinds/mesh.h"
#include "scene/kinds/plane.h"
#include "scene/kinds/smooth_triangle.h"
#include "scene/kinds/sphere.h"
#include "scene/kinds/torus.h"
#include "scene/kinds/triangle.h"

namespace strahl {

using Shape = std::variant<Sphere, Plane, Cylinder, Cone, Cuboid, Disc, Torus, Triangle, SmoothTriangle, Mesh, Union,
                           Intersection, Difference>;

/// May it be a part of a composite? Meshes may, if they are closed.
bool fits_composite(const Shape& shape);
/// How many simple bodies a shape consists of.
int leaves_of(const Shape& shape);

using Forms = FormsOf<Shape>::Type;

}  // namespace strahl
