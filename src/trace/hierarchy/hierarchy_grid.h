// Cuts many boxes by the cells of a grid: each box is looked at once, instead of once for every cut.
#pragma once
#include "trace/hierarchy/hierarchy_cut.h"

namespace strahl::hierarchy_cut {

/// The boxes whose centres are in a cell.
struct GridCell {
    Extents extents;
    std::int32_t count = 0;
};

/// A range of the cells along each axis.
struct CellRange {
    int low[3], high[3];
    int size(int axis) const { return high[axis] - low[axis]; }
    int cells() const { return size(0) * size(1) * size(2); }

    /// Calls act(number, coordinates) for each cell.
    template <class Act>
    void each(const int (&shift)[3], const Act& act) const {
        int at[3];
        for (at[2] = low[2]; at[2] < high[2]; ++at[2])
            for (at[1] = low[1]; at[1] < high[1]; ++at[1])
                for (at[0] = low[0]; at[0] < high[0]; ++at[0]) act(at[0] | at[1] << shift[1] | at[2] << shift[2], at);
    }
};

/// A grid of nearly cubic cells, a power of two of them along each axis.
class Grid {
  public:
    static constexpr int most_cells = 4096;
    /// Divides the box around the centres of all boxes.
    explicit Grid(const QuadBox& middles) : scale(middles, Quad{}) {
        int log[3]{};
        const Quad size = middles.high - middles.low;
        for (int cells = 2; cells <= most_cells; cells *= 2) {
            int longest = -1;
            float length = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const float own = size[axis] / static_cast<float>(1 << log[axis]);
                if (own > length && 2 << log[axis] <= most_bins) longest = axis, length = own;
            }
            if (longest < 0) break;
            ++log[longest];
        }
        Quad bins{};
        for (int axis = 0; axis < 3; ++axis) {
            shift[axis] = axis == 0 ? 0 : shift[axis - 1] + log[axis - 1];
            all.low[axis] = 0, all.high[axis] = 1 << log[axis];
            bins[axis] = static_cast<float>(all.high[axis]);
        }
        scale = BinScale(middles, bins);
    }
    int cells() const { return all.cells(); }
    int cell(const QuadBox& box) const {
        const WholeQuad at = scale.bins(box);
        return at[0] | at[1] << shift[1] | at[2] << shift[2];
    }

    CellRange all;
    int shift[3];

  private:
    BinScale scale;
};

}  // namespace strahl::hierarchy_cut
