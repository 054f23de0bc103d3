// Bounding boxes and bounding spheres in double.
#pragma once
#include <algorithm>
#include <limits>

#include "num/vec.h"

namespace strahl {

/// A default box is empty; the box of an unbounded body has infinite corners.
struct Box {
    DVec3 low{std::numeric_limits<double>::infinity()};
    DVec3 high{-std::numeric_limits<double>::infinity()};

    void add(const DVec3& p) {
        for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    }
    void add(const Box& b) { add(b.low), add(b.high); }
    DVec3 centre() const { return {(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2}; }
    DVec3 size() const { return {high.x - low.x, high.y - low.y, high.z - low.z}; }
    bool empty() const { return !(low.x <= high.x); }
    bool finite() const {
        for (int i = 0; i < 3; ++i)
            if (!(high[i] - low[i] < std::numeric_limits<double>::infinity())) return false;
        return true;
    }
};

/// A bounding sphere.
struct Ball {
    DVec3 centre{0};
    double radius = 0;
};

}  // namespace strahl
