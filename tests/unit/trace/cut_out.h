// Parts of pictures, to compare crops with.
#pragma once
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

}  // namespace strahl
