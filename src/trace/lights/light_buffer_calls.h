// The interface of shadow rays by light buffers: compiled once per precision and SIMD level, apart from the kernel.
#pragma once
#include "trace/forms/items_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

template <class S>
struct LightBufferCalls {
    using T = Element<S>;
    /// Attenuates a light that has a buffer by the items of the hierarchy. Returns the lanes that are left to the
    /// hierarchy itself.
    static Mask<S> occlude(const World<T>& world, int light, const Ray<S>& ray, const S& distance,
                           Transmission<S>& left);
};

}  // namespace strahl::inline STRAHL_LEVEL
