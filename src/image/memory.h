// How much memory there is, so that a picture too large for it is refused before hours are spent on it.
#pragma once

namespace strahl {

/// Bytes that this process can still have without swapping: the least of what the kernel calls available, the limit of
/// the container, and the limit of the address space. Infinity where nothing is known.
double available_memory();

}  // namespace strahl
