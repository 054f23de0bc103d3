// Bodies so thin that samples at a cell's corners may miss them, their shadows, and their reflections in flat mirrors.
// POV-Ray's adaptive anti-aliasing loses three quarters of the light of wires .2 pixels thick, because nothing tells it
// that they are there.
#pragma once
#include <array>
#include <memory>
#include <vector>

#include "trace/cells/tube.h"
#include "trace/world/view.h"

namespace strahl {

struct CellSample;

/// A corner of a cell, in pixels of the view.
struct Corner {
    double x, y;
    const CellSample* sample;
};

/// What the samples of a view may miss.
class Thin {
  public:
    /// `known` are the bodies of this scene, if they were asked for before.
    Thin(const Scene& scene, const View& view, std::shared_ptr<const ThinBodies> known = nullptr);

    /// May something lie between the corners that concerns at least the share `least` of the cell? A body that the
    /// camera sees; and where the corners are on one surface, a body's shadow, or its reflection if the surface is
    /// flat. Corners are in order around the cell.
    bool hides_in(const std::array<Corner, 4>& corners, double least) const;

  private:
    using Quad = std::array<DVec3, 4>;
    Tube from_eye(const Quad& directions, double furthest) const;
    bool hides_shadow(const Quad& points, double radius, std::uint32_t lit, double least) const;
    bool hides_reflection(const Quad& points, double radius, const Quad& directions, double furthest,
                          double least) const;

    const std::shared_ptr<const ThinBodies> own;
    const ThinBodies& bodies;
    const std::vector<Light> lights;
    DVec3 eye, first, right, down;  // the direction through (x, y) is that of first + x right + y down
    double diagonal;                // of a pixel, at distance 1
    double end = 0;                 // distance beyond which there are no bodies
};

}  // namespace strahl
