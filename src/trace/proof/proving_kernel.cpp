// The proving kernel of one precision and SIMD level (STRAHL_ELEMENT, STRAHL_LEVEL).
#include "trace/proof/proving_kernel.h"

#include "trace/kernel/generations.h"
#include "trace/proof/proving.h"

namespace strahl::inline STRAHL_LEVEL {

template <>
Kernel<STRAHL_ELEMENT> kernel<STRAHL_ELEMENT, ForProofs>() {
    using S = Widest<STRAHL_ELEMENT>;
    return {trace<Proving, S, STRAHL_ELEMENT>, width<S>};
}

}  // namespace strahl::inline STRAHL_LEVEL
