// Of a processor without a kernel of packs: what pack.h asks about its instructions. Only for pack.h.
#pragma once

namespace strahl {

template <class T, int bytes>
struct Native;
inline constexpr bool has_fma = false, has_mask_registers = false, has_least = false, has_fours = false;

}  // namespace strahl
