// Makes the camera rays of lenses, of two eyes, and of projections other than perspective, one at a time: they are few
// beside the others.
#pragma once
#include <array>

#include "scene/camera.h"
#include "trace/kernel/kernel.h"
#include "trace/world/build_world.h"
#include "trace/world/view.h"

namespace strahl {

template <class T>
class CameraRays {
  public:
    CameraRays(const Scene& scene, const View& view, const BuiltWorld<T>& built, const Placement& placement);

    /// Sets the start, the direction, the medium and, if patterns are filtered, the differentials of each ray; those
    /// that are not seen get no weight.
    void make(const PixelBatch<T>& batch, Workspace<T>& workspace, RayQueue<T>& rays) const;

  private:
    using Real = std::conditional_t<std::is_same_v<T, long double>, long double, double>;
    std::array<Real, 2> place(Real x, Real y) const;
    CameraRay<Real> ray(Real x, Real y, Real across, Real below, int eye) const;

    const View& view;
    const BuiltWorld<T>& built;
    const Placement& placement;
    const CameraFrame frame;
    const double sharp;             // distance of the plane in focus
    bool starts_in_bodies = false;  // rays may start in a body that they list
};

}  // namespace strahl
