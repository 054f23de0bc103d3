// The list of the kinds of bodies. Parser, writer, `check`, manual, world builder, kernels, the POV-Ray converter, the
// referee and the tests are made for the kinds in this list.
#pragma once
#include <variant>

#include "scene/kinds/blob/blob.h"
#include "scene/kinds/box.h"
#include "scene/kinds/composite.h"
#include "scene/kinds/cone.h"
#include "scene/kinds/cylinder.h"
#include "scene/kinds/disc.h"
#include "scene/kinds/julia/julia.h"
#include "scene/kinds/kind.h"
#include "scene/kinds/lathe.h"
#include "scene/kinds/mesh.h"
#include "scene/kinds/plane.h"
#include "scene/kinds/prism.h"
#include "scene/kinds/smooth_triangle.h"
#include "scene/kinds/sphere.h"
#include "scene/kinds/superellipsoid.h"
#include "scene/kinds/sweep/sweep.h"
#include "scene/kinds/torus.h"
#include "scene/kinds/triangle.h"

namespace strahl {

using Shape = std::variant<Sphere, Plane, Cylinder, Cone, Cuboid, Disc, Torus, Prism, Lathe, Superellipsoid, Blob,
                           SphereSweep, JuliaFractal, Triangle, SmoothTriangle, Mesh, Union, Intersection, Difference>;

/// Can it be a part of a composite? Meshes can if they are closed.
bool fits_composite(const Shape& shape);
/// The contours of a shape; null if it is of a kind without contours.
const ContourData* contours_of(const Shape& shape);
/// The number of simple bodies that a shape consists of.
int leaves_of(const Shape& shape);

using SharedMeshForm = Form<SharedMesh, 0>;
using Forms = JoinForms<FormsOf<Shape>::Type, FormList<SharedMeshForm>>::Type;

}  // namespace strahl
