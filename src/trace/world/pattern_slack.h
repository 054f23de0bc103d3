// Computes the spaces of patterns in long double, for proofs in extended precision and for comparison with all others.
#pragma once
#include <span>

#include "scene/pattern.h"
#include "trace/world/extended_numbers.h"

namespace strahl {

/// Compares the numbers of a pattern's kernel with those in long double, which replace them in a kernel in long double
/// if `replace`. Coordinates may be shifted by whole periods where these are not 0. `steps` are the transformations of
/// the pattern, then those of the body.
template <class T>
void compare_pattern(const Pattern& pattern, std::span<const Transformation> steps, const Placement& placement,
                     const DVec3& period, double border, bool replace, PatternKernel<T>& kernel);

/// Compares and replaces the numbers of a relief's kernel that are not its pattern's.
template <class T>
void compare_relief(const Bump& bump, std::span<const Transformation> steps, bool replace, BumpKernel<T>& kernel);
template <class T>
void compare_relief(const NormalMap& map, std::span<const Transformation> steps, bool replace,
                    NormalMapKernel<T>& kernel);

/// Measures how far apart the colours of a pigment are, and how large: of its stops (one if it is plain) and its image.
template <class T>
void measure_colors(std::span<const ColorStop> stops, const ImagePattern* image, PatternSlack<T>& slack);

}  // namespace strahl
