// Memory that the system gives.
#pragma once
#include <cstddef>

namespace strahl::os {

/// Returns a block that is not initialized, at a multiple of 64 bytes; release() frees it. Large ones ask for huge
/// pages, which cause fewer TLB misses. Throws std::bad_alloc.
void* allocate(std::size_t bytes);
void release(void* block);

/// Gives freed memory that the allocator keeps in small pieces back to the system.
void trim_memory();

/// Returns the bytes that this process can still use without swapping: the least of the available memory, the limit of
/// the container and the limit of the address space. Infinity if unknown.
double available_memory();

}  // namespace strahl::os
