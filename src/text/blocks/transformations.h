// Reads and writes transformations, and checks that what they make can be represented in double.
#pragma once
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "num/vec_math.h"
#include "scene/motion/transformation.h"
#include "text/reading/reader.h"

namespace strahl {

inline constexpr std::array<std::string_view, 3> transformation_words{"rotate", "translate", "scale"};

/// Reads what follows one of these words. If numbers of it follow tracks, which needs `follows`, it is a motion.
Transformation read_transformation(BlockReader& reader, std::string_view word, Block& block, bool follows = false);

/// Returns what a scene's text says for it, as in "rotate <0, 0, 90>".
std::string text_of(const Transformation& step);
/// Returns the block of a motion, with `new_line` before each key: a space, or a line break and the indentation.
std::string text_of(const Motion& motion, const std::string& new_line);

/// The condition number of the linear part of a transformation in Frobenius norms, which is at most three times too
/// large: how much more one direction shrinks than another. The largest entry should be about 1.
inline double condition(const glm::dmat4& m) {
    const DVec3 a(m[0]), b(m[1]), c(m[2]);
    const auto norm = [](const DVec3& u, const DVec3& v, const DVec3& w) {
        return std::hypot(length(u), length(v), length(w));
    };
    const DVec3 bc = cross_product(b, c), ca = cross_product(c, a), ab = cross_product(a, b);
    const double determinant = dot_product(a, bc);
    return norm(a, b, c) * norm(bc, ca, ab) / std::fabs(determinant);
}
/// The largest entry of the linear part.
inline double largest_entry(const glm::dmat4& m) {
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::fabs(m[i][k]));
    return largest;
}
inline const char* scale_fault(double largest_entry) {
    return largest_entry >= smallest_positive && largest_entry <= largest_number
               ? ""
               : "scale it out of the range of numbers";
}
inline const char* flat_fault(glm::dmat4 m) {
    const double largest = largest_entry(m);
    for (int i = 0; i < 3; ++i) m[i] /= largest;
    return condition(m) < 1e12 ? "" : "flatten it: one side shrinks more than 1e12 times as much as another";
}
inline constexpr const char* reach_fault = "make it too large, too small or too far away (coordinates go up to 1e9)";
/// Why this transformation of a space is not allowed, or "". To follow "the transformations ...".
inline std::string transformations_fault(const glm::dmat4& m) {
    for (int c = 0; c < 3; ++c)
        if (!coordinates.contains(m[3][c])) return reach_fault;
    const std::string fault = scale_fault(largest_entry(m));
    return fault.empty() ? flat_fault(m) : fault;
}

}  // namespace strahl
