// The spaces of patterns in long double: those of proofs in extended precision, with which all others are compared.
#pragma once
#include <span>

#include "scene/pattern.h"
#include "trace/world/extended_numbers.h"

namespace strahl {

/// Compares the numbers of a pattern's kernel with those in long double, which take their place in a kernel in long
/// double that has none yet. Coordinates may be shifted by whole periods, where these are not 0. `steps` are those of
/// the body after those of the pattern.
template <class T>
void compare_pattern(const Pattern& pattern, std::span<const Transformation> steps, const Placement& placement,
                     const DVec3& period, double border, bool replace, PatternKernel<T>& kernel);

/// Compares what else a relief's kernel has, likewise.
template <class T>
void compare_relief(const Bump& bump, std::span<const Transformation> steps, bool replace, BumpKernel<T>& kernel);
template <class T>
void compare_relief(const NormalMap& map, std::span<const Transformation> steps, bool replace,
                    NormalMapKernel<T>& kernel);

/// How far apart the colours of a pigment are, and how large: those of its stops, one if it is plain, and of its image.
template <class T>
void measure_colors(std::span<const ColorStop> stops, const ImagePattern* image, PatternSlack<T>& slack);

}  // namespace strahl
