// Input and result of a method, for one number or a pack of lanes.
#pragma once
#include <limits>

#include "num/memory.h"
#include "num/ray.h"

namespace strahl::bench::STRAHL_LEVEL {

/// A pack of rays with their bodies.
template <class S>
struct Question {
    Vec3<S> o, d, a, b;
    S r, h;
    Ray<S> ray() const { return {o, d, S(-1)}; }
};
template <class S>
struct Answer {
    S t;
    Vec3<S> p;
};
/// A function, because a variable of packs would be set up at program start, even on machines without the instructions.
template <class S>
S infinite() {
    return S(std::numeric_limits<Element<S>>::infinity());
}

template <class S>
Answer<S> along(const Question<S>& q, Mask<S> hit, S near, S far) {
    const S t = select(hit & (far > S(0)), select(near > S(0), near, far), infinite<S>());
    return {t, fma(t, q.d, q.o)};
}

}  // namespace strahl::bench::STRAHL_LEVEL
