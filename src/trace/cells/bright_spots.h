// Small bodies that glow, as a lens sees them, or a shutter.
//
// A body that is seen from a hundredth of the lens may be missed by all first rays of a pixel and of those around it.
// If it is bright they lack its light, and nothing says so. But the scene says where it may be seen, so that rays can
// be aimed at it.
#pragma once
#include <vector>

#include "scene/scene.h"
#include "trace/world/view.h"

namespace strahl {

/// The ball around a body at a moment. A ray through a place in the picture, in pixels, and one on the lens, see
/// lens_place(), passes the ball's middle at that place + lens * blur - middle.
struct SeenBall {
    double x = 0, y = 0;            // the middle, through the middle of the lens
    double half_x = 0, half_y = 0;  // half its width and height; 0 if it is behind the camera or does not glow
    double blur_x = 0, blur_y = 0;
    bool operator==(const SeenBall&) const = default;

    bool meets(double at_x, double at_y, double across, double below) const {
        const double u = (at_x + blur_x * across - x) / half_x, v = (at_y + blur_y * below - y) / half_y;
        return u * u + v * v <= 1;
    }
    /// Returns the share of a pixel's rays that meet it, about, if it is seen all over the pixel's lens.
    double share() const;
};

struct BrightSpot {
    double light = 0;            // the most that it sends out, in any channel
    std::vector<SeenBall> seen;  // at each moment
};

/// Collects the bodies of a scene that are brighter than white, moment by moment.
class BrightSpots {
  public:
    void begin(std::size_t own_moments) { all.clear(), leaves.clear(), moments = own_moments, added = 0; }
    /// Adds the scene at the next moment, as this view sees it: in perspective, or not at all.
    void add(const Scene& scene, const View& view);
    /// Returns the spots that change through the lens or from moment to moment.
    const std::vector<BrightSpot>& spots() const { return all; }

  private:
    std::vector<BrightSpot> all;
    std::vector<int> leaves;  // their numbers in the scene
    std::size_t moments = 1, added = 0;
};

}  // namespace strahl
