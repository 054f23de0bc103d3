// Finds bodies so thin that samples at a cell's corners may miss them, their shadows, or their reflections in flat
// mirrors. POV-Ray's adaptive anti-aliasing loses three quarters of the light of wires .2 pixels thick, because nothing
// tells it that they are there.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "trace/cells/tube.h"
#include "trace/world/view.h"

namespace strahl {

struct CellSample;

using FourPoints = std::array<DVec3, 4>;

/// A corner of a cell, in pixels of the view.
struct CellCorner {
    double x, y;
    const CellSample* sample;
};

/// Knows what the samples of a view may miss.
class ThinBodies {
  public:
    /// `known` are the bodies of this scene, if they have been collected before.
    ThinBodies(const Scene& scene, const View& view, std::shared_ptr<const CapsuleTree> known = nullptr);

    /// Returns whether something may lie between the corners that covers at least the share `least` of the cell: a body
    /// that the camera sees, or, if the corners are on one surface, a body's shadow, or its reflection if the surface
    /// is flat, or its shadow on what all corners see there. Corners are in order around the cell. If it is a flat
    /// body that the camera sees, and nothing else, `part` becomes what it takes of the cell.
    bool hides_in(const std::array<CellCorner, 4>& corners, double least,
                  std::optional<FlatPart>* part = nullptr) const;

  private:
    /// Camera rays at the corners of a cell: their starts, directions, and these with length 1.
    struct Sights {
        FourPoints starts, ways, units;
    };
    Sights sights_at(const std::array<CellCorner, 4>& corners) const;
    bool hides_camera(const std::array<CellCorner, 4>& corners, const Sights& sights, double furthest, FacetsSeen seen,
                      double least, std::optional<FlatPart>* part) const;
    bool hides_shadow(const FourPoints& points, double radius, std::uint32_t lit, FacetsSeen seen, double least) const;
    bool hides_reflection(const FourPoints& points, double radius, const FourPoints& directions, double furthest,
                          double reach, FacetsSeen seen, double least) const;

    const std::shared_ptr<const CapsuleTree> own;
    const CapsuleTree& bodies;
    const std::vector<Light> lights;
    const Camera camera;
    const CameraFrame frame;
    const double width, height, shift_x, shift_y;  // of the view
    DVec3 eye, first, right, down;  // the direction through (x, y) is that of first + x right + y down, in perspective
    double diagonal;                // of a pixel, at distance 1
    double end = 0;                 // distance beyond which there are no bodies
};

}  // namespace strahl
