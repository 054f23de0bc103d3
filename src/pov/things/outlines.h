// Closed outlines in a plane: which are holes of which, and how they become faces of one outline each.
#pragma once
#include <array>
#include <vector>

namespace strahl::pov {

using Point2 = std::array<double, 2>;
using Outline = std::vector<Point2>;  // a closed line; the last point is not the first one again

/// Turns each outline to the left around what it encloses if it lies within an even number of others, else, as a hole,
/// to the right. Drops points on straight lines, and outlines without area. Returns the outlines.
std::vector<Outline>& turned_as_faces(std::vector<Outline>& outlines);

/// Returns the faces that turned outlines enclose. Each is one outline; its holes are joined to it by edges that are
/// used twice, to the hole and back.
std::vector<Outline> faces_of(const std::vector<Outline>& outlines);

}  // namespace strahl::pov
