// Colours of patterns where rays cross surfaces: compiled once per precision and SIMD level, apart from the kernel.
#pragma once
#include "num/memory.h"
#include "num/ray.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Has this material a pattern?
template <class T>
STRAHL_INLINE bool patterned(const World<T>& world, int material) {
    return material >= world.first_pattern;
}

/// May colours or normals of this material vary within a piece of its pattern? See PatternCalls::piece.
template <class T>
STRAHL_INLINE bool uneven(const World<T>& world, int material) {
    if (!patterned(world, material)) return false;
    const int which = material - world.first_pattern;
    if (world.bends && !(world.bends[which].map.flat && world.bends[which].bump.flat)) return true;
    const PatternForm form = world.patterns[which].form;
    return form != PatternForm::checker && form != PatternForm::brick && form != PatternForm::constant;
}

/// What part of a surface a sample's square of the view shows, as if the surface were flat: a parallelogram.
template <class S>
struct Footprint {
    Vec3<S> direction;     // of the ray, of length 1
    Vec3<S> normal;        // of the surface
    Vec3<S> across, down;  // from the hit to where rays a side of the square beside this one are as far as it is
};

template <class S>
struct PatternCalls {
    using T = Element<S>;
    /// Gives a pack of materials, known by their numbers, the colours that their patterns have at these positions of
    /// these surfaces.
    static void paint(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                      MaterialKernel<S>& values);
    /// The same with images filtered. How many of the image's pixels long footprints are, 0 where there is no image.
    static S paint_filtered(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                            const Footprint<S>& footprint, MaterialKernel<S>& values);
    /// The normals at these positions of these surfaces as the materials bend them, of length 1.
    static Vec3<S> bent(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                        const Vec3<S>& normal);
    /// A number for each of the pieces of a pattern that have edges in between: checks, bricks, ramps, repetitions of
    /// images; 0 where there are none, as between repetitions of filtered images.
    static S piece(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                   Mask<S> filtered);
    /// The background in these directions.
    static Vec3<S> sky(const World<T>& world, const Vec3<S>& direction);
    static S sky_filtered(const World<T>& world, const Footprint<S>& footprint, Vec3<S>& color);
    /// Takes from the light what a surface of a transparent material takes in these lanes, `t` along the ray.
    static void filter(const World<T>& world, int material, const S& surface, const Ray<S>& ray, const S& t,
                       Mask<S> lanes, Vec3<S>& share);
};

}  // namespace strahl::inline STRAHL_LEVEL
