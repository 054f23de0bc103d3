// Numbers as a scene's author wrote them.
#pragma once
#include <charconv>
#include <cmath>

#include "num/vec.h"
#include "pov/language/value.h"

namespace strahl::pov {

/// Returns the number that was written: of all decimals that round to this float the shortest.
inline double decimal(float v) {
    if (std::fabs(v) < 1e6f)
        for (double unit = 1; unit <= 1e6; unit *= 10)
            if (const double few = std::nearbyint(v * unit) / unit; static_cast<float>(few) == v) return few;
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, v).ptr;
    double result = v;
    std::from_chars(digits, end, result);
    return result;
}
/// Returns a number as POV-Ray keeps it, in single precision; for scene text the number that was written.
inline double kept(double v, bool as_text) {
    const auto single = static_cast<float>(v);
    return as_text ? decimal(single) : double(single);
}
inline Color color_of(const FilterColor& c) { return {decimal(c.red), decimal(c.green), decimal(c.blue)}; }

/// Returns the number rounded to 12 decimals, so that 1 - .7 is .3.
inline double tidy(double v) { return std::fabs(v) < 1e3 ? std::round(v * 1e12) / 1e12 : v; }

}  // namespace strahl::pov
