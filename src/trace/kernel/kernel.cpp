// The plain kernel of one precision and SIMD level (STRAHL_ELEMENT, STRAHL_LEVEL).
#include "trace/kernel/kernel.h"

#include "trace/kernel/generations.h"
#include "trace/kernel/plain.h"

namespace strahl::inline STRAHL_LEVEL {

template <>
Kernel<STRAHL_ELEMENT> kernel<STRAHL_ELEMENT, ForPictures>() {
    using S = Widest<STRAHL_ELEMENT>;
    return {trace<Plain, S, STRAHL_ELEMENT>, width<S>};
}

}  // namespace strahl::inline STRAHL_LEVEL
