// Divides a cell that one edge crosses: the edge is taken for a straight line between two sides.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

namespace strahl {

/// A side on which the signature changes, and the stretch of it where: from `low` on side `number` towards the next
/// corner samples are as at the first corner, and from `high` on as at the second one. In units from the first corner.
struct Crossing {
    int number;
    std::int32_t low, high;
    int low_sample, high_sample;
};

/// Returns the two sides on which signatures change, if there are two signatures and two such sides.
std::optional<std::array<int, 2>> changing_sides(const std::array<std::uint32_t, 4>& signatures);

/// The two parts of a square of side 1 that the chord between points on two sides makes. The first one has the corners
/// from the end of the first side to the begin of the second.
struct ChordParts {
    double first_area;          // the other part has the rest of 1
    double middle_x, middle_y;  // of the chord
    double normal_x, normal_y;  // of length 1, from the first part to the other
    double length;
};
ChordParts parts_of(const std::array<int, 2>& sides, const std::array<double, 2>& positions);

}  // namespace strahl
