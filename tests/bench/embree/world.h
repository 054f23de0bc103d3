// A scene in Embree's input: balls are its sphere points, cylinders user geometry, meshes its triangles; planes stay
// outside, in a plain loop.
#pragma once
#include <embree3/rtcore.h>

#include <array>
#include <vector>

#include "num/memory.h"
#include "scene/scene.h"

namespace strahl::bench {

using S = Pack<float>;  // as many rays at once as the machine has lanes: 4, 8 or 16
inline constexpr int lanes = width<S>;

/// Coefficients of the illumination equation, multiplied out.
template <class T>
struct Surface {
    Vec3<T> ambient, diffuse, filter;
    T specular, pow, reflection, refraction, ior;
};

/// Bodies of one kind, all opaque or all transparent: an Embree geometry.
struct Group {
    std::vector<int> material;  // by primitive
    std::vector<CylinderKernel<float>> cylinders;
    const std::vector<Surface<float>>* materials = nullptr;
};

struct World {
    World(const Scene& scene, int threads);
    ~World();
    World(const World&) = delete;

    RTCDevice device;
    RTCScene scene;
    bool empty = true;            // no bodies but planes
    std::array<Group, 6> groups;  // by geometry: balls, cylinders and triangles, opaque and transparent
    std::vector<PlaneKernel<float>> planes;
    std::vector<int> plane_material;
    std::vector<Surface<float>> materials;
    struct PointLight {
        Vec3<float> position, color;
    };
    std::vector<PointLight> lights;
    Vec3<float> background;
};

/// The light that a packet of shadow rays has left. Embree hands it to the callbacks.
struct ShadowContext {
    RTCIntersectContext embree;
    alignas(64) float share[3][lanes];
};

}  // namespace strahl::bench
