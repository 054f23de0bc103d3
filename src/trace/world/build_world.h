// Builds a World from a Scene.
#pragma once
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "scene/scene.h"
#include "trace/world/world.h"

namespace strahl {

class ThreadPool;
class MovingHierarchy;
class Images;

/// The origin and the unit of a world's coordinates: world = (scene - origin) * scale. The scale is a power
/// of two and the origin on a coarse grid, so that both are exact wherever numbers are of a sane size.
struct Placement {
    DVec3 origin{0};
    double scale = 1;
    bool operator==(const Placement&) const = default;
};

/// The region that most shapes of a scene are in. Outliers such as huge ground spheres do not count.
struct Extent {
    DVec3 centre{0};
    double size = 1;
};
Extent extent_of(const Scene& scene);

/// Returns the placement for a camera. It is the same for all cameras near the scene, and depends for one far off on
/// its position alone.
Placement placement(const Extent& extent, const DVec3& camera);

/// Returns how many surfaces the bodies have in all.
std::int64_t surfaces_of(const Scene& scene);
/// Returns the number of the primitive that each surface is of.
std::vector<int> primitives_of_surfaces(const Scene& scene);
/// Throws FileError if these are more than T can number.
template <class T>
void check_capacity(std::int64_t surfaces);

template <class T>
struct WorldArrays;
template <class T>
class SharedMeshes;

/// A world and the arrays that it points into.
template <class T>
class BuiltWorld {
  public:
    /// `moving` and `images` keep what the same scene has at all moments. For proofs a world in long double is computed
    /// in long double, see extended_numbers.h. `lanes` are those of the kernel. `meshes`, if any, are not made once
    /// more, and outlive the world.
    BuiltWorld(const Scene& scene, const Placement& placement, ThreadPool& pool, MovingHierarchy* moving = nullptr,
               const std::shared_ptr<Images>& images = nullptr, bool proves = false, int lanes = 1,
               const SharedMeshes<T>* meshes = nullptr);
    /// Makes the world of a moment at which no more than the lights differ from those of another world.
    BuiltWorld(std::shared_ptr<const BuiltWorld> bodies, const Scene& scene, const Placement& placement);
    ~BuiltWorld();
    /// Takes over what is equal in a world of the same scene at another moment.
    void share(const BuiltWorld& other);
    const World<T>& world() const;
    /// Returns the surface numbers of the transparent bodies that a point of the scene is in, in the order declared.
    std::vector<int> bodies_around(const DVec3& point) const;
    /// Returns the material of the scene that each material of the world is or is a copy of.
    std::vector<int> materials() const;
    /// Returns the largest coordinate of a bounded body.
    double reach() const;
    /// Returns whether bodies of the world's scene were left out whose numbers in T are those of another one, from
    /// which they may differ in the scene.
    bool lacks_items(const Scene& scene) const;

  private:
    const std::shared_ptr<const BuiltWorld> bodies;  // the world that this one differs from in its lights, or null
    std::unique_ptr<WorldArrays<T>> arrays;
};

/// Meshes that worlds of several moments share, each in a world of its own, in its own coordinates.
template <class T>
class SharedMeshes {
  public:
    struct OwnWorld {
        Placement placement;
        std::unique_ptr<const BuiltWorld<T>> built;
    };
    using ByPrimitive = std::vector<const OwnWorld*>;
    /// Adds the meshes of a scene, but for those that are there. `lanes` are those of the kernel.
    void add(const Scene& scene, ThreadPool& pool, int lanes);
    /// Returns the worlds of a scene's meshes; null for bodies that have to be made as others are: all but large meshes
    /// that cast whole shadows, placed by a matrix that loses few digits.
    ByPrimitive find(const Scene& scene) const;

  private:
    std::unordered_map<std::shared_ptr<const MeshData>, OwnWorld> worlds;
};
/// Returns how many surfaces bodies have that worlds do not share.
std::int64_t surfaces_apart(const Scene& scene);

}  // namespace strahl
