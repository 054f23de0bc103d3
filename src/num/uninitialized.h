// Room for values that are made later.
#pragma once
#include <cstddef>
#include <type_traits>

namespace strahl {

/// Room for n values, none of which is made: that alone would take longer than most walks.
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
