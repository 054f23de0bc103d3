// The spaces of patterns in long double: those of proofs in extended precision, with which all others are compared.
#pragma once
#include <span>

#include "scene/pattern.h"
#include "trace/extended.h"

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

/// What the colours of a pattern are.
template <class T>
void measure_colors(const Pattern& pattern, PatternSlack<T>& slack);

}  // namespace strahl
