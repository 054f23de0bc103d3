// Uninitialized buffers for large arrays.
#pragma once
#include <cstddef>
#include <memory>
#include <type_traits>

#include "files/os/memory.h"

namespace strahl {

struct FreeBuffer {
    void operator()(void* p) const { os::release(p); }
};
template <class I>
using Buffer = std::unique_ptr<I[], FreeBuffer>;

/// A buffer for `count` values, not initialized: one thread would write the zeros, and first touches of memory are
/// slow. Throws std::bad_alloc.
template <class I>
Buffer<I> uninitialized_buffer(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<I> && std::is_trivially_destructible_v<I>);
    return Buffer<I>(static_cast<I*>(os::allocate(count * sizeof(I))));
}

}  // namespace strahl
