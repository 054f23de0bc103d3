// Finds where a single ray meets bodies, in double.
#pragma once
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "num/box_tree.h"
#include "num/ray.h"
#include "scene/scene.h"

namespace strahl {

/// Does a ray, from its start on, meet a box?
bool meets(const Box& box, const Ray<double>& ray);

/// Trees of the triangles of meshes, for those who look along many rays.
class MeshTrees {
  public:
    /// Returns the numbers of the triangles whose boxes the ray meets, in ascending order.
    std::vector<std::size_t> met_by(const Ray<double>& ray, const std::shared_ptr<const MeshData>& mesh);

  private:
    std::map<std::shared_ptr<const MeshData>, BoxTree> trees;
};

/// A place where a ray meets the surface of a body.
struct RayHit {
    double t = 0;
    DVec3 normal{0};  // outward, of length 1
    int leaf = 0;     // number of the simple body that the surface is of, in the order declared
    int face = 0;     // of that body, see glossary
};

/// Returns where the ray meets the surface of a body, nearest first, if that is further than `from` and nearer than
/// `to`. The surface of a composite is where one of its parts has one and only one side of it is inside. The ray's
/// direction has the length 1. Without trees each triangle of a mesh is looked at.
std::vector<RayHit> ray_hits(const Primitive& body, const Ray<double>& ray, double from,
                             double to = std::numeric_limits<double>::infinity(), MeshTrees* trees = nullptr);

/// The first place where a ray meets a body of a scene.
struct BodyHit {
    int body = 0;  // its number in Scene::primitives
    RayHit hit;
};
/// Returns all bodies that the ray meets, nearest first. Of bodies at the same distance the first declared comes first.
std::vector<BodyHit> bodies_along(const Scene& scene, const Ray<double>& ray);

}  // namespace strahl
