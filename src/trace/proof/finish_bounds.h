// Error bounds of POV-Ray's finishes: for proofs, compiled once per precision and SIMD level, apart from the kernel.
#pragma once
#include "trace/finish/finish_calls.h"
#include "trace/proof/bounded.h"

namespace strahl::inline STRAHL_LEVEL {

/// Error bounds of hits as a finish needs them: of the angles of normals and of the rays that come in, and of the
/// largest channel of colours.
template <class S>
struct SeenErrors {
    S normal, turn, color;
};
/// Error bounds of a hit's layers, in their largest channels: of the light of its own, and of the shares of light that
/// are reflected and that come through. `sent` is the most that goes on of both.
template <class S>
struct LayerErrors {
    S ambient{0}, reflected{0}, refracted{0}, sent{0};
};
/// Error bounds of a light's direction: of its angle, of the cosine with the normal and of the angle with mirrored
/// rays.
template <class S>
struct LitErrors {
    S turn, cosine, mirrored;
};

template <class S>
struct FinishBounds {
    using T = Element<S>;
    /// Returns the lanes whose finish has bounds: those of one layer on one side of the surface, which all rays see,
    /// without a film, and in whose patterns nothing comes through.
    static Mask<S> known(const World<T>& world, const int* materials);
    /// Bounds the errors of layers.
    static LayerErrors<S> of_layers(const World<T>& world, const int* materials, const SeenSurface<S>& seen,
                                    const SeenErrors<S>& off, const LayeredHit<S>& hit);
    /// Bounds the largest channel of what layers send back of light that arrives.
    static Bounded<S> of_light(const World<T>& world, const int* materials, const LayeredHit<S>& hit,
                               const LitSurface<S>& lit, const SeenErrors<S>& off, const LitErrors<S>& lit_off);
};

}  // namespace strahl::inline STRAHL_LEVEL
