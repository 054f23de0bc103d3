// Finds flat pieces of the surfaces of a scene's bodies, by which bodies are told that look thin from some sides only.
#pragma once
#include <glm/mat4x4.hpp>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// A convex polygon, in the scene's coordinates, of a body whose thickness is twice `least` or more.
struct Facet {
    std::vector<DVec3> corners;
    double least;
    bool whole = true;  // what the body hides is what it and the body's other facets hide
};

/// Returns the flat pieces of a body: of boxes, discs, triangles, meshes of up to 10,000 triangles, and of cylinders
/// and cones that are flatter than wide; round ones in pieces as fine as they are thin. Those of a union are the parts'
/// own, those of an intersection and of a difference are the first part's: more than is left of it.
std::vector<Facet> facets_of(const Primitive& primitive, const glm::dmat4& outer = glm::dmat4(1));

}  // namespace strahl
