// Tells pack.h that a processor has no instructions for packs. Only pack.h includes this.
#pragma once

namespace strahl {

template <class T, int bytes>
struct Native;
inline constexpr int register_bytes = 16;
inline constexpr bool has_fma = false, has_mask_registers = false, has_fours = false;

}  // namespace strahl
