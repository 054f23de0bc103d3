// Finds bodies in a tube, which a bundle of rays may meet although a few rays of it miss them.
//
// Tubes stand for rays that are known by some of their bundle only: between the corners of a cell, from there to a
// light. Compare cone tracing (J. Amanatides, "Ray Tracing with Cones", SIGGRAPH 1984); here it only tells where to
// look.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "scene/capsules.h"
#include "scene/scene.h"

namespace strahl {

/// All points no further from a straight way than a radius that grows or shrinks evenly along it.
struct Tube {
    DVec3 from, direction;  // of length 1
    double length;          // of the way; may be infinite
    double radius, growth;  // at `from`, and by unit of length; not below 0 anywhere
    double area;            // of the bundle's cross section, which the tube contains, over the square of the radius
};

/// Returns a bound on the radius of the tube where the capsule reaches into it; below 0 if it does not.
double radius_at(const Tube& tube, const Capsule& capsule);

/// The capsules of a scene's bodies in a binary tree of balls.
class CapsuleTree {
  public:
    explicit CapsuleTree(const Scene& scene);

    bool empty() const { return nodes.empty(); }
    /// Return the smallest radius, and a ball around all. There must be bodies.
    double least() const { return nodes[0].least; }
    const Capsule& around() const { return nodes[0].around; }

    /// Returns whether a body is in the tube that is thinner than the tube there, so that the corners of the bundle may
    /// miss it, and that hides at least the share `least` of the bundle. Bodies around all of `own` do not count: the
    /// rays start there.
    bool meets(const Tube& tube, double least, std::span<const DVec3> own = {}) const;

  private:
    struct CapsuleNode {
        Capsule around;    // a ball, or the capsule of a leaf
        double least;      // radius of a capsule below
        std::int32_t next;  // node that follows all below this one
        bool leaf;
    };
    void add(std::span<Capsule> capsules);

    std::vector<CapsuleNode> nodes;  // each before those below it
};

}  // namespace strahl
