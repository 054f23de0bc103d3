// The policy of the plain kernel, which traces and does nothing besides.
//
// A policy is the last template argument of a kernel's stages. They call its members where another kernel wants to know
// more, or to decide otherwise. Those of this one are empty, or do what tracing alone needs, so that nothing of them is
// left in the machine code.
#pragma once
#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

struct Plain {
    /// Signatures and footprints are noted, where a batch wants them.
    static constexpr bool notes = true;
    /// Several packs go through the hierarchy together.
    static constexpr bool joins = true;

    /// What it keeps besides of rays, hits, and the light of a light at a hit.
    template <class S>
    struct OfRay {};
    template <class S>
    struct OfHit {};
    template <class S>
    struct OfLight {};

    /// By how much the rays of a pack may be others than those that culling is given: turned, and moved.
    template <class T>
    struct Widening {
        STRAHL_INLINE static T turned(T cosine) { return cosine; }
        STRAHL_INLINE static T moved(T distance) { return distance; }
    };
    template <class S, class T>
    STRAHL_INLINE static Widening<T> widening(const RayQueue<T>&, int, Mask<S>) {
        return {};
    }
    template <class T>
    STRAHL_INLINE static bool culls(const Limits<T>&) {
        return true;
    }
    /// Finds the nearest surfaces that rays meet, those of a queue from number `i` on.
    template <class S, class T>
    STRAHL_INLINE static Nearest<S> nearest(const World<T>& world, const Limits<T>&, const RayQueue<T>&, int,
                                            const Ray<S>& ray, Mask<S> active, BodySet set, int,
                                            const PixelBatch<T>&) {
        return strahl::nearest(world, ray, active, set);
    }

    static constexpr auto nothing = [](const auto&...) __attribute__((always_inline)) {};
    /// At camera rays; at rays that miss; at hits, once their material, their bent normals and their light are known.
    static constexpr auto start = nothing, miss = nothing, meet = nothing, bend = nothing, shade = nothing;
    /// At reflected and refracted rays, and when rays are put into a queue.
    static constexpr auto reflect = nothing, refract = nothing, put = nothing;
    /// At an area light; at lights, once it is known on which side of the surface before bending they are, and whether
    /// hits are in their cones.
    static constexpr auto area = nothing, side = nothing, spot = nothing;

    /// Chooses, lane by lane, of what it keeps of two rays.
    template <class S>
    STRAHL_INLINE static OfRay<S> either(Mask<S>, const OfRay<S>&, const OfRay<S>&) {
        return {};
    }
    /// The largest diffuse coefficient that a hit may have.
    template <class S>
    STRAHL_INLINE static S diffuse(const OfHit<S>&, const S& computed) {
        return computed;
    }
    /// The hits that may be turned to a light.
    template <class S>
    STRAHL_INLINE static Mask<S> may_face(const OfHit<S>&, const Hit<S>& hit, const LightKernel<Element<S>>&,
                                          const Vec3<S>&, const S& facing) {
        return hit.active & (facing > S(0));
    }
    template <class S>
    STRAHL_INLINE static OfLight<S> light(const OfHit<S>&, const Hit<S>&, const LightKernel<Element<S>>&, const S&,
                                          const S&, const S&, const S&) {
        return {};
    }
    /// The hits whose light must be looked at, those in the lanes of `faces` and perhaps others.
    template <class S>
    STRAHL_INLINE static Mask<S> lit(Mask<S> faces, const Hit<S>&, const OfLight<S>&) {
        return faces;
    }
    /// The share of a light that comes through to hits.
    template <class S>
    STRAHL_INLINE static Vec3<S> arriving(const Shading<S, Plain>& shading, const Hit<S>& hit, const OfLight<S>&,
                                          const Vec3<S>& l, const S& distance, Mask<S> faces, const S&, const S&,
                                          const Start<S>& start, const OfHit<S>&) {
        return visibility(shading.world, Ray<S>{hit.position, l, hit.surface}, distance, faces, start);
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
