// The patterns of a world as the kernels read them: they colour materials and bend normals.
#pragma once
#include <cstdint>
#include <limits>

#include "scene/kinds/kinds.h"

namespace strahl {

enum class ImageMap : std::int32_t;
struct SolidPattern;

/// The forms of patterns, by how their value is computed.
enum class PatternForm : std::int32_t { checker, brick, ramp, noise, layers, rings, image, solid, constant };
/// Returns whether patterns of this form have approximate means, see quick_mean_kernel.h.
inline constexpr bool has_quick_mean(PatternForm form) { return form < PatternForm::image; }
/// A picture at one size: three values for each pixel, row by row from the top.
struct MipLevel {
    const float* pixels;
    std::int32_t width, height;
};
/// A picture at all sizes from its own to one pixel, see mip_maps.h.
struct MipMapKernel {
    const MipLevel* levels = nullptr;
    std::int32_t count = 0;
};
/// A picture that a pattern has its colours from, see scene/image_pattern.h.
template <class T>
struct ImageKernel {
    const float* pixels;
    std::int32_t width, height;
    ImageMap map;
    bool once, sharp;
    bool ends[2], mirrors[2];  // along u and v: edges do not join; every second picture is mirrored
    Vec3<T> around;            // the colour outside, if it is there once
    T border;                  // distance before 0 and 1 at which it begins and ends
    T shift[2];                // what is this little below a border of a sharp picture's pixels counts as beyond it
    std::int32_t number;       // among the world's mip maps
};
/// The uv coordinates of a mesh: its surfaces, the numbers of their corners' coordinates, and these. Null for other
/// bodies.
struct PlacesKernel {
    std::int32_t first_surface, surfaces;
    const MeshData::Corners* corners;
    const MeshData::Place* places;
};
/// Errors of a pattern, for proofs: how far its numbers may be off those of exact arithmetic, and bounds of its
/// colours.
template <class T>
struct PatternSlack {
    T turned = std::numeric_limits<T>::infinity();  // each row, as the sum of its numbers' errors
    T moved = 0;                                    // each number of the offset, but for whole periods
    T apart = 0;                                    // the most by which two of its colours differ in a channel
    T largest = 0;                                  // the largest channel of a colour
};
/// The octaves of a pattern's noise: each is `omega` times as strong as the one before, and `lambda` times as fine.
template <class T>
struct OctavesKernel {
    std::int32_t count;
    T omega, lambda;
};
/// The pattern of a material in the space of one body, whose point p = rows * world + offset.
template <class T>
struct PatternKernel {
    PatternForm form;
    bool by_uv;  // if true, p is the uv place, not a point of the world
    bool nests;  // some of its stops have patterns
    std::int32_t first_stop, stops;
    Vec3<T> rows[3], offset;
    // Holds the numbers that only some forms read.
    Vec3<T> mortar;            // of bricks: the mortar's share of one along each axis
    T border;                  // of ramps: how far before its whole numbers a ramp begins anew
    OctavesKernel<T> octaves;  // of noise, and of the noise that moves layers and rings
    T turbulence;              // by how much it moves these
    ImageKernel<T> image;
    const SolidPattern* solid;
    PlacesKernel places;
    Vec3<T> ambient;        // Ia Ka
    T diffuse, refraction;  // Kd, Kt
    PatternSlack<T> slack;  // only in worlds for proofs
};
/// Errors of a relief besides, for proofs: of its columns, of each of its bends and of each number of its steps.
template <class T>
struct ReliefSlack {
    T columns = std::numeric_limits<T>::infinity(), bends = 0, steps = 0;
};
/// A relief: bends the normals of a material in the space of one body.
template <class T>
struct ReliefKernel {
    PatternKernel<T> pattern;
    bool flat;             // nothing does
    Vec3<T> columns[3];    // what the axes of the pattern's space are in the world, the longest of length 1
    ReliefSlack<T> slack;  // only in worlds for proofs
};
/// n is bent to n + |columns^T n| times the sum of value(p + step) bend. The steps are in the kernel's space of the
/// pattern.
template <class T>
struct BumpKernel : ReliefKernel<T> {
    Vec3<T> steps[4], bends[4];
    bool by_vectors;  // a solid pattern's, whose components take the places of the values
};
template <class T>
struct NormalMapKernel : ReliefKernel<T> {
    T height;
};
/// The normal map and the bump of a material; either may be flat.
template <class T>
struct BendKernel {
    NormalMapKernel<T> map;
    BumpKernel<T> bump;
};
template <class T>
struct ColorStopKernel {
    T at, per;  // per: 1 over the way from the stop before
    Vec3<T> color;
    T filter = 0, transmit = 0;
    std::int32_t nested = -1;  // number of the pattern that has these in their place
};

}  // namespace strahl
