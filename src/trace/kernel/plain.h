// The policy of the plain kernel, which traces and does nothing besides.
//
// A policy is the last template argument of a kernel's stages. They call its members where another kernel computes more
// or decides otherwise. The members of this one are empty, or do what tracing alone needs, so that they leave nothing
// in the machine code.
#pragma once
#include "trace/kernel/shading.h"

namespace strahl::inline STRAHL_LEVEL {

struct Plain {
    /// Signatures and footprints are computed if a batch wants them.
    static constexpr bool notes = true;
    /// Several packs traverse the hierarchy together.
    static constexpr bool joins = true;
    /// Rays pass surfaces of other bodies that they start on.
    static constexpr bool passes_touching = true;

    /// Data that the policy adds to rays, to hits, and to each light at a hit: none.
    template <class S>
    struct OfRay {};
    template <class S>
    struct OfHit {};
    template <class S>
    struct OfLight {};

    /// Widens what encloses the rays of a pack for culling: the cosine of the cone's angle, and the radius of the ball
    /// around the origins.
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
    /// Finds the nearest surfaces that a pack of rays meets, those of a queue from number `i` on.
    template <class S, class T>
    STRAHL_INLINE static Nearest<S> nearest(const World<T>& world, const Limits<T>&, const RayQueue<T>&, int,
                                            const Ray<S>& ray, Mask<S> active, BodySet set, int, const PixelBatch<T>&) {
        return strahl::nearest(world, ray, active, set);
    }

    static constexpr auto nothing = [](const auto&...) __attribute__((always_inline)){};
    /// Called for camera rays; for rays that miss; for hits, once their material, their bent normals or their light is
    /// known.
    static constexpr auto start = nothing, miss = nothing, meet = nothing, bend = nothing, shade = nothing;
    /// Called for reflected and for refracted rays, and when rays are put into a queue.
    static constexpr auto reflect = nothing, refract = nothing, put = nothing;
    /// Called for rectangular lights; for lights where normals are bent, to find those behind the surface itself; for
    /// spotlights, once hits outside their cones are known; and for special lights, once they have lit plain hits.
    static constexpr auto area = nothing, side = nothing, spot = nothing, special = nothing;
    /// Called for hits with finishes, once their layers are known, and once a light has lit them.
    static constexpr auto layers = nothing, lit_layers = nothing;

    /// Selects, lane by lane, between the data of two rays.
    template <class S>
    STRAHL_INLINE static OfRay<S> either(Mask<S>, const OfRay<S>&, const OfRay<S>&) {
        return {};
    }
    /// Returns the largest diffuse coefficient that a hit may have.
    template <class S>
    STRAHL_INLINE static S diffuse(const OfHit<S>&, const S& computed) {
        return computed;
    }
    /// Returns the hits that may face a light.
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
    /// Returns what a policy notes of a light of any kind, see light_at.
    template <class S>
    STRAHL_INLINE static OfLight<S> light_of(const Shading<S, Plain>&, const Hit<S>&, const LightKernel<Element<S>>&,
                                             const LightAt<S>&, const Vec3<S>&, OfHit<S>&) {
        return {};
    }
    /// Returns the hits for which a light must be looked at: those of `faces`, and in other policies more.
    template <class S>
    STRAHL_INLINE static Mask<S> lit(Mask<S> faces, const Hit<S>&, const OfLight<S>&) {
        return faces;
    }
    /// Returns the share of a light that reaches hits, per channel.
    template <class S>
    STRAHL_INLINE static Vec3<S> arriving(const Shading<S, Plain>& shading, const Hit<S>& hit, const OfLight<S>&,
                                          const Vec3<S>& l, const S& distance, Mask<S> faces, const S&, const S&,
                                          const Start<S>& start, const OfHit<S>&) {
        return visibility(shading.world, Ray<S>{hit.position, l, hit.surface}, distance, faces, start);
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
