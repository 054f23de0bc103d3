// Colours of patterns where rays cross surfaces: compiled once per precision and instruction set, in a file of its own.
#pragma once
#include "num/memory.h"
#include "num/ray.h"
#include "trace/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Has this material a pattern?
template <class T>
STRAHL_INLINE bool patterned(const World<T>& world, int material) {
    return material >= world.first_pattern;
}

template <class S>
struct PatternCalls {
    using T = Element<S>;
    /// Gives a pack of materials, known by their numbers, the colours that their patterns have at these positions of
    /// these surfaces.
    static void paint(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                      MaterialKernel<S>& values);
    /// The normals at these positions of these surfaces as the materials bend them, of length 1.
    static Vec3<S> bent(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                        const Vec3<S>& normal);
    /// A number for each of the pieces of a pattern that have edges in between: checks, bricks, ramps, repetitions of
    /// images; 0 where there are none.
    static S piece(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface);
    /// The background in these directions.
    static Vec3<S> sky(const World<T>& world, const Vec3<S>& direction);
    /// Takes from the light what a surface of a transparent material takes in these lanes, `t` along the ray.
    static void filter(const World<T>& world, int material, const S& surface, const Ray<S>& ray, const S& t,
                       Mask<S> lanes, Vec3<S>& share);
};

}  // namespace strahl::inline STRAHL_LEVEL
