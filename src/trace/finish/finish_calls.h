// The interface of POV-Ray's finishes: compiled once per precision and SIMD level, apart from the kernel.
#pragma once
#include "num/memory.h"
#include "num/ray.h"
#include "trace/patterns/pattern_calls.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns how bright POV-Ray takes a colour for.
template <class S>
STRAHL_INLINE S gray_of(const Vec3<S>& color) {
    using T = Element<S>;
    return fma(S(T(.297)), color.x, fma(S(T(.589)), color.y, S(T(.114)) * color.z));
}

/// Points of surfaces as rays see them. The normals are turned towards the rays.
template <class S>
struct SeenSurface {
    Vec3<S> position, direction, normal;
    S surface;
    Mask<S> outside;
    Mask<S> enters = outside;  // the ray is in no such body
    S before{1}, beyond{1};    // the indices of refraction that it comes from, and that it leaves into
    S mirrored{0};             // cosine of the angle to the normal at which it is mirrored, where normals are bent
};
/// The way from there to a light. `reflected` is the ray's mirrored direction.
template <class S>
struct LitSurface {
    const Vec3<S>&direction, &normal, &reflected, &l;
    const S& cosine;  // absolute cosine of the angle with the normal
    bool highlights;
    Mask<S> behind;  // the light is behind the surface
};

/// Most layers of a surface.
inline constexpr int most_layers = 8;
/// The layers of surfaces at points. Each has its colour, the share that it scatters, and what the layers above it
/// let through.
template <class S>
struct LayeredHit {
    Vec3<S> ambient, through, mirrored;  // light of its own; shares of light that comes through, and is reflected
    S total, clear;                      // see FinishKernel; clear is 1 or 0
    int bend;                            // only layers with this one are among them, see LayerKernel
    S most_mirrored;                     // the share of reflected light by which POV-Ray tells how weak a ray is
    int count;                           // of the layers that follow: those of the material that has most
    Vec3<S> color[most_layers], above[most_layers];
    S opacity[most_layers];
};

template <class S>
struct FinishCalls {
    using T = Element<S>;
    /// Finds the layers of surfaces with these materials, one in each lane; with footprints, unless these are null, the
    /// means of patterns through whose colours no light comes. Of other layers than those of `hit.bend` it finds only
    /// what comes through them.
    static Filtering<S> look(const World<T>& world, const int* materials, const SeenSurface<S>& seen,
                             const Footprint<S>* footprint, LayeredHit<S>& hit);
    /// Adds the light that these layers send back to `sum`, of light that arrives.
    static void scatter(const World<T>& world, const int* materials, const LayeredHit<S>& hit, const LitSurface<S>& lit,
                        const Vec3<S>& arriving, Vec3<S>& sum);
    /// Returns the share of light that comes through a surface on its way to another one, from outside of its body or
    /// from inside.
    static Vec3<S> through(const World<T>& world, int material, const Vec3<S>& position, const S& surface,
                           Mask<S> outside);
    /// Attenuates light in these lanes by a surface of a patterned or finished material that lets some through, at `t`
    /// along the ray.
    static void filter(const World<T>& world, int material, const S& surface, const Ray<S>& ray, const S& t,
                       Mask<S> lanes, Vec3<S>& share);
    /// Bends flat normals as layers of this bend have them. Returns the lanes in which there are such layers.
    static Mask<S> bent(const World<T>& world, const int* materials, int bend, const Vec3<S>& position,
                        const S& surface, const Vec3<S>& flat, Vec3<S>& normal);
    /// Returns the lanes whose surfaces are lit from behind.
    static Mask<S> lit_behind(const World<T>& world, const int* materials);
    /// Returns the lanes on whose surfaces lights of this group shine.
    static Mask<S> lit_by(const World<T>& world, const int* materials, std::int32_t group);
    /// Returns the share of light that is left after a way through a body of this material, in the lanes of the mask.
    static Vec3<S> faded_inside(const World<T>& world, int material, const S& way, Mask<S> lanes);
    /// Returns the same for the materials of a pack, one in each lane; 1 in lanes not `inside`.
    static Vec3<S> faded_inside(const World<T>& world, const int* materials, const S& way, Mask<S> inside);
    /// Returns the lanes whose rays go through a material as if it was not there; `mirrored` as in RayQueue.
    static Mask<S> hidden(const World<T>& world, const int* materials, const S& mirrored);
};

}  // namespace strahl::inline STRAHL_LEVEL
