// Polygons as triangles.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "num/vec.h"

namespace strahl {

using CornerNumbers = std::array<std::int32_t, 3>;

/// A plane polygon cut up. It need not be convex, and its corners may run either way round.
struct Triangles {
    std::vector<CornerNumbers> list;  // without those of no area; they run the way the polygon does
    bool crossing = false;            // edges cross each other, and the triangles cover something else
    bool too_long = false;            // it is not convex, and has more corners than `most`
};
Triangles triangles_of(std::span<const DVec3> corners, std::size_t most);

}  // namespace strahl
