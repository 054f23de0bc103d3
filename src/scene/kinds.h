// The list of shape kinds: everything that treats shapes alike (parser, writer, world, export, tests) derives from it.
#pragma once
#include <variant>

#include "scene/affine.h"
#include "scene/cylinder.h"
#include "scene/plane.h"
#include "scene/sphere.h"

namespace strahl {

using Shape = std::variant<Sphere, Plane, Cylinder>;

/// One G for each kernel of a shape: the engine keeps shapes of a kind together, so that nothing is ever dispatched
/// shape by shape. (A plane under any transformation is a plane.)
template <template <template <class> class> class G>
struct PerKernel {
    G<SphereKernel> spheres;
    G<PlaneKernel> planes;
    G<CylinderKernel> cylinders;
    G<Affine<SphereKernel>::Kernel> affine_spheres;
    G<Affine<CylinderKernel>::Kernel> affine_cylinders;

    /// Calls visit(g) for each.
    template <class F>
    [[gnu::always_inline]] void each(F&& visit) const {
        visit(spheres), visit(planes), visit(cylinders), visit(affine_spheres), visit(affine_cylinders);
    }
    template <class F>
    [[gnu::always_inline]] void each(F&& visit) {
        visit(spheres), visit(planes), visit(cylinders), visit(affine_spheres), visit(affine_cylinders);
    }
};

}  // namespace strahl
