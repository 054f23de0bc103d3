// POV-Ray's finishes as kernels read them: the layers of each material.
#pragma once
#include <cstdint>

#include "trace/world/world_patterns.h"

namespace strahl {

/// A layer of a surface in worlds with POV-Ray's finishes, see Material. Its pattern is constant if it has none.
template <class T>
struct LayerKernel {
    PatternKernel<T> pattern;
    Vec3<T> ambient;  // Ia Ka glow
    T irid, film;
    T diffuse, behind, phong, phong_size, blinn, blinn_size, metallic, brilliance;
    Vec3<T> mirror;  // Kr mirror
    T facing, falloff, gilding;
    bool fresnel, conserves, old_opacity;
    std::int32_t share;  // of the uppermost layer of a stack: the pattern of its share among the world's; else -1
    T outside, inside;   // of that layer: factors of the stack's light, as in Material
    std::int32_t
        bend;  // 0 if it has the normals of the material, else it has those of FinishKernel::first_bend - 1 + bend
};
/// The layers of a material, the lowest first, and what they share.
template <class T>
struct FinishKernel {
    bool plain;  // the article's equation is all that it has
    std::int32_t first_layer, layers;
    T refraction, ior;   // Kt of the lowest layer
    T total;             // the share of light that is reflected totally
    T clarity;           // factor of what comes through, but for shadows
    bool clear;          // light comes through by the colours: it goes straight on without a new generation
    bool always_enters;  // as in POV-Ray rays meet both sides from outside, since nothing lets them in
    bool shadow, seen, mirrored;
    bool both_sides, behind;         // lights behind the surface light it as those before, or by its layers' `behind`
    bool common;                     // lights of no group shine on it
    std::int32_t group;              // group of lights that also shine on it; 0 if none do
    std::int32_t first_bend, bends;  // bends of the layers that have normals of their own
    T fade_per, fade_power;          // fade_per: 1 over the distance; 0 if light does not fade inside
    Vec3<T> fade_color;
};

/// POV-Ray's finishes, by material, in worlds that have any or lights as only POV-Ray has them: there all materials
/// have one, plain ones too. Null in other worlds.
template <class T>
struct FinishTables {
    const FinishKernel<T>* list = nullptr;
    const std::uint8_t* finished = nullptr;  // by surface: 1 if its material is not plain; null if all are
    const LayerKernel<T>* layers = nullptr;
    const PatternKernel<T>* shares = nullptr;
    const BendKernel<T>* bends = nullptr;
    int most_bends = 0;     // largest number of bends of a material
    T bailout = 0;          // rays of less weight are black
    bool carries = false;   // rays carry colours besides their weights, and counts of their own, see RayQueue
    bool follows = false;   // shadow rays go from surface to surface: light fades in bodies, or their sides differ
    bool hides = false;     // some body is not seen by all rays
    bool behind = false;    // some surface is lit from behind
    bool groups = false;    // some lights shine on some bodies only
    bool fresnel = false;   // some surface reflects by the indices on its sides
    bool film = false;      // some surface has a thin film
    bool enclosed = false;  // rays may start in opaque bodies
};

}  // namespace strahl
