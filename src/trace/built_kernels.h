// The kernels that this program has.
#pragma once
#include "trace/kernel/kernel.h"
#include "trace/proof/proving_kernel.h"
#include "trace/tracer.h"

namespace strahl {

/// The kernel of one level for one purpose, ForPictures or, but for float, ForProofs; an empty one if it is not built.
template <class T, class Purpose>
Kernel<T> kernel_for(Simd simd);

}  // namespace strahl
