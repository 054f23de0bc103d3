// Splits faces of more than three corners into triangles.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "num/vec.h"

namespace strahl {

class FaceSplitter {
  public:
    using Triangle = std::array<std::int32_t, 3>;
    /// Splitting a concave face takes time that grows with the square of its corners.
    static constexpr std::size_t most_concave = 1000;

    /// Returns the triangles of a face of three corners or more, as positions in `corners`; they stay until the next
    /// call. None if the face is concave and has more than `most_concave` corners.
    ///
    /// A convex face is a fan around its first corner. Of a concave one, ears are clipped ("Polygon triangulation",
    /// chapter 1 of J. O'Rourke's "Computational Geometry in C"), seen from the direction in which its area is
    /// greatest. Where its edges cross each other the triangles still use each edge once.
    std::span<const Triangle> split(const std::vector<DVec3>& points, std::span<const std::int32_t> corners);

  private:
    struct RingCorner {
        double x, y;
        std::int32_t before, after;
        bool ear;
    };
    bool convex(const std::vector<DVec3>& points, std::span<const std::int32_t> corners);
    bool is_ear(std::int32_t corner) const;
    void clip_ears();

    DVec3 normal{};
    std::vector<RingCorner> ring;
    std::vector<Triangle> triangles;
};

}  // namespace strahl
