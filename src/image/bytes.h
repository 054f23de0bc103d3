// Whole numbers as bytes of a file, whatever the processor's own order.
#pragma once
#include <concepts>
#include <string>

namespace strahl {

/// The least significant byte first.
template <std::unsigned_integral T>
void put_little(std::string& bytes, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(value >> 8 * i);
}

/// The most significant byte first.
template <std::unsigned_integral T>
void put_big(std::string& bytes, T value) {
    for (std::size_t i = sizeof(T); i-- > 0;) bytes += static_cast<char>(value >> 8 * i);
}

}  // namespace strahl
