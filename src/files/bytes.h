// Whole numbers as bytes of a file, whatever the processor's own order.
#pragma once
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

namespace strahl {

/// Appends a number, the least significant byte first.
template <std::unsigned_integral T>
void put_little(std::string& bytes, T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(value >> 8 * i);
}
/// Appends a number, the most significant byte first.
template <std::unsigned_integral T>
void put_big(std::string& bytes, T value) {
    for (std::size_t i = sizeof(T); i-- > 0;) bytes += static_cast<char>(value >> 8 * i);
}

/// Reads the number at `at`, the least significant byte first. Bytes past the end count as 0.
template <std::unsigned_integral T>
T get_little(std::string_view bytes, std::size_t at) {
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T) && at + i < bytes.size(); ++i)
        value |= static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[at + i])) << 8 * i);
    return value;
}
/// Reads the number at `at`, the most significant byte first. Bytes past the end count as 0.
template <std::unsigned_integral T>
T get_big(std::string_view bytes, std::size_t at) {
    T value = 0;
    for (std::size_t i = 0; i < sizeof(T) && at + i < bytes.size(); ++i)
        value |= static_cast<T>(static_cast<T>(static_cast<unsigned char>(bytes[at + i])) << 8 * (sizeof(T) - 1 - i));
    return value;
}

}  // namespace strahl
