// Inputs that are easy, far, huge, tiny, shifted and grazing; and the right answers, in 113 bits.
#pragma once
#include <array>
#include <string_view>

#include "tests/bench/methods/methods.h"

namespace strahl::bench {

inline constexpr std::array inputs{"easy", "far", "huge", "tiny", "shifted", "grazing"};

/// Returns the same rays in every precision. Rounding them to it is not the methods' fault and does not count.
template <class T>
Rays<T> rays_for(std::string_view group, std::string_view input, std::size_t n);

/// Errors of a method's answers.
struct Wrong {
    double answers = 0;  // share: hit taken for miss or the other way round; of boxes only a hit missed counts
    double t = 0;        // 99.9 % of the errors of t are below this, in t
    double surface =
        0;  // and of the distances between point and surface, in radii (of planes: in distances to the eye)
};
template <class T>
Wrong judge(std::string_view group, const Rays<T>& rays, const Answers<T>& answers);

}  // namespace strahl::bench
