// Asks Linux how much memory is available, so that a picture that needs more is refused before it is traced.
#pragma once

namespace strahl {

/// Bytes that this process can still use without swapping: the least of the available memory, the limit of the
/// container and the limit of the address space. Infinity if unknown.
double available_memory();

}  // namespace strahl
