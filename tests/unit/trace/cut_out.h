// Parts of pictures, to compare crops with, and how far pictures differ.
#pragma once
#include <cmath>
#include <vector>

#include "trace/world/view.h"

namespace strahl {

/// Returns the values of a part of a picture that is `width` pixels wide, 3 a pixel, row by row. The part has no steps.
template <class T>
std::vector<T> cut_out(const std::vector<T>& picture, int width, const Lattice& part) {
    std::vector<T> cut;
    for (int y = part.y; y < part.y + part.rows; ++y) {
        const auto row = picture.begin() + 3 * (y * width + part.x);
        cut.insert(cut.end(), row, row + 3 * part.columns);
    }
    return cut;
}

/// Returns the lattice of all pixels of a view.
inline Lattice whole(const View& view) { return {.columns = view.width, .rows = view.height}; }

/// Returns the root of the mean square of the differences of two pictures' values.
inline double rms(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace strahl
