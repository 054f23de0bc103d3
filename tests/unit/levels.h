// The instruction sets that this machine has.
#pragma once
#include <vector>

#include "trace/tracer.h"

namespace strahl {

/// Those with a fused multiply-add: their pictures are equal bit for bit. (Scalar has it by the C library if need be.)
inline std::vector<Simd> fused_levels() {
    std::vector<Simd> list;
    for (const Simd simd : {Simd::scalar, Simd::v3, Simd::v4, Simd::neon})
        if (supported(simd)) list.push_back(simd);
    return list;
}
inline std::vector<Simd> all_levels() {
    std::vector<Simd> list = fused_levels();
    if (supported(Simd::v2)) list.push_back(Simd::v2);
    return list;
}

}  // namespace strahl
