// Uninitialized buffers for large arrays.
#pragma once
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

#if defined(__linux__)
#include <sys/mman.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace strahl {

struct FreeBuffer {
    void operator()(void* p) const { std::free(p); }
};
template <class I>
using Buffer = std::unique_ptr<I[], FreeBuffer>;

/// A buffer for `count` values, not initialized: one thread would write the zeros, and first touches of memory are
/// slow. Large buffers ask for huge pages, which cause fewer TLB misses.
template <class I>
Buffer<I> uninitialized_buffer(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<I> && std::is_trivially_destructible_v<I>);
    constexpr std::size_t page = std::size_t(1) << 21;
    const std::size_t bytes = count * sizeof(I), unit = bytes < page ? 64 : page;
    void* const p = std::aligned_alloc(unit, (bytes / unit + 1) * unit);
    if (!p) throw std::bad_alloc();
#if defined(__linux__)
    if (unit == page) madvise(p, bytes / page * page, MADV_HUGEPAGE);  // none that would be partly empty
#endif
    return Buffer<I>(static_cast<I*>(p));
}

/// Gives freed memory that the allocator keeps in small pieces back to the system.
inline void trim_memory() {
#if defined(__GLIBC__)
    malloc_trim(0);
#endif
}

}  // namespace strahl
