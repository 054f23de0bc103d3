// Numbers and vectors as text that reads back as the same numbers.
#pragma once
#include <array>
#include <charconv>
#include <string>

#include "num/vec.h"

namespace strahl {

/// The shortest digits that read back as the same number; never "-0".
inline std::string text_of(double v) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, v == 0 ? 0 : v).ptr};
}
inline std::string text_of(const std::array<double, 2>& v) {
    return std::string("<") + text_of(v[0]) + ", " + text_of(v[1]) + ">";
}
inline std::string text_of(const DVec3& v) {
    return std::string("<") + text_of(v.x) + ", " + text_of(v.y) + ", " + text_of(v.z) + ">";
}

}  // namespace strahl
