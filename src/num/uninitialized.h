// An array whose values are made later.
#pragma once
#include <cstddef>
#include <type_traits>

namespace strahl {

/// Memory for n values that is not initialised: to do so would take longer than most traversals.
template <class V, int n>
class Room {
  public:
    V& operator[](int i) { return reinterpret_cast<V*>(bytes)[i]; }
    const V& operator[](int i) const { return reinterpret_cast<const V*>(bytes)[i]; }

  private:
    static_assert(std::is_trivially_copyable_v<V>);
    alignas(V) std::byte bytes[n * sizeof(V)];
};

}  // namespace strahl
