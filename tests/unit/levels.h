// Lists the SIMD levels of this machine.
#pragma once
#include <vector>

#include "trace/tracer.h"

namespace strahl {

/// Returns levels with a fused multiply-add, whose pictures are equal bit for bit. (Scalar may use the C library's.)
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
