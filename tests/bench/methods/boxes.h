// Methods of intersection with boxes, which must never miss a ray that crosses.
#pragma once
#include <cstdint>
#include <limits>

#include "tests/bench/methods/question.h"

namespace strahl::bench::STRAHL_LEVEL {

/// Ends ordered by the sign of the direction.
template <class S>
Answer<S> ordered(const Question<S>& q) {
    S near(0), far = infinite<S>();
    for (int i = 0; i < 3; ++i) {
        const S inverse = S(1) / q.d[i], a = (q.a[i] - q.o[i]) * inverse, b = (q.b[i] - q.o[i]) * inverse;
        const Mask<S> up = q.d[i] >= S(0);
        near = max(near, select(up, a, b)), far = min(far, select(up, b, a));
    }
    return {select(near <= far, near, infinite<S>()), q.o};
}
/// Finds the nearer end of each axis by minimum and maximum.
template <class S>
Answer<S> sorted(const Question<S>& q) {
    S near(0), far = infinite<S>();
    for (int i = 0; i < 3; ++i) {
        const S inverse = S(1) / q.d[i], a = (q.a[i] - q.o[i]) * inverse, b = (q.b[i] - q.o[i]) * inverse;
        near = max(near, min(a, b)), far = min(far, max(a, b));
    }
    return {select(near <= far, near, infinite<S>()), q.o};
}
/// The engine's method: finite reciprocals, a box grown by some units in the last place of its coordinates, and far
/// ends a little farther (T. Ize, "Robust BVH Ray Traversal", 2013). In a hierarchy boxes grow once, when built.
template <class S>
Answer<S> grown(const Question<S>& q) {
    using T = Element<S>;
    constexpr T tiny = T(1) / (std::uint64_t(1) << 60), epsilon = std::numeric_limits<T>::epsilon();
    S near(0), far = infinite<S>();
    for (int i = 0; i < 3; ++i) {
        const S d = q.d[i], inverse = S(1) / select(abs(d) < S(tiny), select(d < S(0), S(-tiny), S(tiny)), d);
        const S a = (q.a[i] - q.h - q.o[i]) * inverse, b = (q.b[i] + q.h - q.o[i]) * inverse;
        near = max(near, min(a, b)), far = min(far, max(a, b) * S(1 + 4 * epsilon));
    }
    return {select(near <= far, near, infinite<S>()), q.o};
}

}  // namespace strahl::bench::STRAHL_LEVEL
