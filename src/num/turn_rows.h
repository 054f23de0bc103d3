// Turns rows of pixels over.
#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace strahl {

/// Puts the pixels of each row in the opposite order, each of so many values.
template <class T>
void turn_rows(std::vector<T>& values, std::size_t width, std::size_t channels) {
    const auto length = static_cast<std::ptrdiff_t>(width * channels);
    for (auto row = values.begin(); row != values.end(); row += length) {
        std::reverse(row, row + length);  // then the values within each pixel again
        for (auto pixel = row; pixel != row + length; pixel += static_cast<std::ptrdiff_t>(channels))
            std::reverse(pixel, pixel + static_cast<std::ptrdiff_t>(channels));
    }
}

}  // namespace strahl
