// The interface of patterns' colours and normals: compiled once per precision and SIMD level, apart from the kernel.
#pragma once
#include <array>

#include "num/memory.h"
#include "num/ray.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns true if this material has a pattern.
template <class T>
STRAHL_INLINE bool patterned(const World<T>& world, int material) {
    return material >= world.patterns.first;
}

/// Returns true if the article's equation is all that this material has.
template <class T>
STRAHL_INLINE bool plain(const World<T>& world, int material) {
    return !world.finishes.list || world.finishes.list[material].plain;
}

/// Returns false if bodies of this material cast no shadow.
template <class T>
STRAHL_INLINE bool has_shadow(const World<T>& world, int material) {
    return !world.finishes.list || world.finishes.list[material].shadow;
}
/// Returns true if lights shine through bodies of this material: transparent ones, and those without a shadow.
template <class T>
STRAHL_INLINE bool passes_light(const World<T>& world, int material) {
    return world.transparent && (world.materials[material].refraction > 0 || !has_shadow(world, material));
}

/// Returns true if colours or normals of this material may vary within a piece of its pattern, see PatternCalls::piece.
template <class T>
STRAHL_INLINE bool uneven(const World<T>& world, int material) {
    if (!patterned(world, material)) return false;
    if (!plain(world, material)) return true;
    const int which = material - world.patterns.first;
    if (world.patterns.bends && !(world.patterns.bends[which].map.flat && world.patterns.bends[which].bump.flat))
        return true;
    const PatternForm form = world.patterns.list[which].form;
    return form != PatternForm::checker && form != PatternForm::brick && form != PatternForm::constant;
}

/// The part of a surface that a sample's square of the view shows, as if the surface were flat.
template <class S>
struct Footprint {
    Vec3<S> direction;     // of the ray, of length 1
    Vec3<S> normal;        // of the surface
    Vec3<S> across, down;  // from the hit to where rays a side of the square beside this one are as far as it is
    S weight;              // of the ray: colours of little weight need no exact means
    std::array<S, 2> shrink{S(0), S(0)};  // see SeenArea
};

/// Says how well a filtered colour stands for what samples beside it see.
template <class S>
struct Filtering {
    S length{0};  // the pixels of an image along a footprint; of other patterns 1, and 0 where there is none
    S loose{0};   // how loose the filter is, from 0 for exact means to 1; -1 if nothing varies around
    S doubt{0};   // the standard deviation of what the colour is off, if its detail is finer than what was looked at
};

template <class S>
struct PatternCalls {
    using T = Element<S>;
    /// Gives materials, one in each lane and known by their numbers, the colours that their patterns have at these
    /// positions of these surfaces.
    static void paint(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                      MaterialKernel<S>& values);
    /// Does the same with means over footprints.
    static Filtering<S> paint_filtered(const World<T>& world, const int* materials, const Vec3<S>& position,
                                       const S& surface, const Footprint<S>& footprint, MaterialKernel<S>& values);
    /// Returns the normals at these positions of these surfaces as the materials bend them, of length 1.
    static Vec3<S> bent(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                        const Vec3<S>& normal);
    /// Does the same with means over footprints, for bumps of values; `length` becomes that of the mean normal.
    static Vec3<S> bent_filtered(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                                 const Footprint<S>& footprint, S& length);
    /// Returns a number for the piece of the pattern at each position. Pieces have edges in between: checks, bricks,
    /// ramps, repetitions of images. 0 where there are none, and where patterns are filtered, but for images that are
    /// there once.
    static S piece(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                   Mask<S> filtered);
    /// Returns the background in these directions; the second one finds its means over footprints.
    static Vec3<S> sky(const World<T>& world, const Vec3<S>& direction);
    static Filtering<S> sky_filtered(const World<T>& world, const Footprint<S>& footprint, Vec3<S>& color);
};

}  // namespace strahl::inline STRAHL_LEVEL
