// The spaces of patterns in long double: those of proofs in extended precision, with which all others are compared.
#pragma once
#include <array>

#include "scene/pattern.h"
#include "trace/extended.h"

namespace strahl {

/// How a pattern's own space becomes the kernel's, exactly but for rounding to long double.
struct ExtendedPatternSpace {
    std::array<ExtendedVector, 3> rows{ExtendedVector{1, 0, 0}, ExtendedVector{0, 1, 0}, ExtendedVector{0, 0, 1}};
    ExtendedVector offset{0}, mortar{0};
    /// Of a pattern's kind, whose borders are this much before whole coordinates.
    ExtendedPatternSpace(const PatternKind& kind, Extended border);
};

/// Compares the numbers of a pattern's kernel with those in long double, which take their place in a kernel in long
/// double that has none yet. Coordinates may be shifted by whole periods, where these are not 0. `steps` are those of
/// the body after those of the pattern.
template <class T>
void compare_pattern(const Pattern& pattern, std::span<const Transformation> steps, const Placement& placement,
                     const DVec3& period, double border, bool replace, PatternKernel<T>& kernel);

/// What the colours of a pattern are.
template <class T>
void measure_colors(const Pattern& pattern, PatternSlack<T>& slack);

}  // namespace strahl
