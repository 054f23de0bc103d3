// Finds bodies in a tube, which a bundle of rays may meet although a few rays of it miss them.
//
// Tubes stand for rays that are known by some of their bundle only: between the corners of a cell, from there to a
// light. Compare cone tracing (J. Amanatides, "Ray Tracing with Cones", SIGGRAPH 1984); here it only tells where to
// look.
#pragma once
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/facets.h"
#include "scene/kinds/capsule.h"
#include "scene/scene.h"

namespace strahl {

/// All points no further from a straight way than a radius that grows or shrinks evenly along it.
struct Tube {
    DVec3 from, direction;  // of length 1
    double length;          // length of the segment; may be infinite
    double radius, growth;  // at `from`, and by unit of length; not below 0 anywhere
    double area;            // of the bundle's cross section, which the tube contains, over the square of the radius
};

/// Returns a bound on the radius of the tube where the capsule reaches into it; below 0 if it does not.
double radius_at(const Tube& tube, const Capsule& capsule);

/// Rays through a parallelogram: those from one point, or parallel ones. Points are from + w (corner + u across + v
/// down) with u and v from 0 to 1; for parallel rays the corner is their direction, and only it is multiplied by w.
struct RayBundle {
    DVec3 from, corner, across, down;
    bool parallel;
    double nearest, furthest;  // the part of the rays, in w

    /// Takes vectors to w u, w v and w.
    glm::dmat3 coordinates() const;
    /// The share of the rays in this part that meet a convex polygon, and which of the four corner rays do: bits 0 to
    /// 3, around the parallelogram from `corner` on; and how many of the polygon's sides lie in between.
    struct Met {
        double share = 0;
        unsigned corners = 0;
        int sides = 0;
    };
    /// Returns what a polygon meets; `to_own` is coordinates(). If `outline` is given it gets u and v of the part's
    /// corners.
    Met met(std::span<const DVec3> polygon, const glm::dmat3& to_own, std::vector<glm::dvec2>* outline = nullptr) const;
};

/// The part of a bundle that one thin body takes, by its facets.
struct FlatPart {
    double share = 0;
    unsigned corners = 0;              // bit set of the bundle's corners that are in it
    std::array<glm::dvec2, 3> places;  // u and v in it: in the middle of its largest polygon, and near two ends
};

/// Says what the corners of a bundle tell about facets that some of them meet.
enum class FacetsSeen {
    same,   // all corners saw the same: what only some of them meet is not there, but something next to it may be
    split,  // they saw different things: there may be a gap between two facets, or one with two sides in the cell
    any,    // nothing
};

/// The capsules around a scene's bodies, and their facets, in a binary tree of balls.
class CapsuleTree {
  public:
    /// Pictures in motion go without facets: it would take too long to make them for every frame.
    explicit CapsuleTree(const Scene& scene, bool with_facets = true);

    bool empty() const { return nodes.empty(); }
    /// Return the smallest radius, 0 for facets that are thin, and a capsule around all. There must be bodies.
    double least() const { return nodes[0].least; }
    const Capsule& around() const { return nodes[0].around; }

    /// Returns whether a body is in the tube that is thinner than the tube there, so that the corners of the bundle may
    /// miss it, and that hides at least the share `least` of the bundle; or facets that hide as much and yet are not
    /// seen at the corners, see hides(). Bodies around all of `own` do not count: the rays start there.
    bool meets(const Tube& tube, const RayBundle& bundle, double least, FacetsSeen seen,
               std::span<const DVec3> own = {}) const;
    /// Returns what a body takes of the bundle if facets say all of it and nothing else is in the tube that is thin
    /// there.
    std::optional<FlatPart> flat_part(const Tube& tube, const RayBundle& bundle) const;

  private:
    struct TreeLeaf {
        Capsule around;  // a ball around a facet or a piece of one
        Box box;         // around the same; infinite for capsules
        double least;
        std::int32_t body, facet;  // their numbers, -1 in place of a facet for capsules
        bool is_piece = false;
    };
    struct CapsuleNode {
        Capsule around;     // a ball around all below, or that of a leaf
        Box facets;         // around the facets below; infinite if there are capsules as well
        double least;       // the smallest radius below, or half a facet's thickness
        std::int32_t next;  // node that follows all below this one
        bool is_leaf, is_piece;
        std::int32_t body, facet;  // of a leaf
    };
    void add(std::span<TreeLeaf> leaves);
    template <class Visit>
    bool any_thin(const Tube& tube, const RayBundle& bundle, const glm::dmat3& to_own, const Visit& visit) const;

    std::vector<CapsuleNode> nodes;  // each before those below it
    std::vector<Facet> facets;
    std::vector<char> whole;  // by body: do its facets say what it hides?
};

}  // namespace strahl
