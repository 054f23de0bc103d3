// Finds where to cut a range of items in two, by the surface area heuristic on boxes in bins.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "num/quad.h"
#include "trace/hierarchy/hierarchy.h"

namespace strahl::hierarchy_cut {

inline constexpr int most_bins = 16;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

using WholeQuad [[gnu::vector_size(16)]] = std::int32_t;

struct QuadBox {
    // Coordinates x, y, z, and a number that does not matter. The whole number of an item box is a denormal float: sums
    // of these take no longer, products many times as long.
    Quad low, high;

    void add(const QuadBox& b) { low = minimum(low, b.low), high = maximum(high, b.high); }
    void add(Quad point) { low = minimum(low, point), high = maximum(high, point); }
    float half_area() const {
        Quad size = maximum(high - low, Quad{});
        size[3] = 0;
        const Quad area = size * __builtin_shufflevector(size, size, 1, 2, 0, 3);
        return area[0] + area[1] + area[2];
    }
    Quad middle() const { return low + high; }  // twice the centre
};
inline const QuadBox nothing{Quad{} + infinity, Quad{} - infinity};
inline QuadBox bounds_of(const ItemBox& box) { return std::bit_cast<QuadBox>(box); }

/// Returns the box grown by a margin and by the loss of rounding: half a unit in the last place when its corners were
/// rounded, and half a unit here. The smallest normal number is added because denormal floats have fewer places.
inline QuadBox grown(const QuadBox& box, double margin) {
    const Quad grow = Quad{} + (static_cast<float>(margin) + std::numeric_limits<float>::min()),
               units{0x1p-22f, 0x1p-22f, 0x1p-22f, 0};
    Quad low = box.low, high = box.high;
    low[3] = high[3] = 0;  // denormal floats, see above
    return {low - (grow + maximum(low, -low) * units), high + (grow + maximum(high, -high) * units)};
}

inline constexpr float item_cost = .2f;  // relative to the cost of a binary node

/// A box around a range of boxes, and one around their centres.
struct Extents {
    QuadBox all = nothing, middles = nothing;
    void add(const Extents& e) { all.add(e.all), middles.add(e.middles); }
    void add(const QuadBox& box) { all.add(box), middles.add(box.middle()); }
};

/// Returns how many bins so many items want: an empty bin costs as much as a full one.
inline int bins_for(std::int32_t count) { return count <= 16 ? 4 : count <= 64 ? 8 : most_bins; }

/// Computes how far along the bins of each axis a box's centre is.
struct BinScale {
    Quad from, per_bin, last;
    BinScale(const QuadBox& middles, Quad bins) : from(middles.low), per_bin(bins), last(bins - 1) {
        Quad size = middles.high - middles.low;
        size[3] = from[3] = 1;
        per_bin /= size;
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(per_bin[i])) per_bin[i] = 0;
    }
    Quad operator()(const QuadBox& box) const { return minimum((box.middle() - from) * per_bin, last); }
    WholeQuad bins(const QuadBox& box) const { return __builtin_convertvector((*this)(box), WholeQuad); }
};

/// The number of boxes in each bin of each axis, and a box around them.
struct Bins {
    int bins[3];
    QuadBox box[3][most_bins];
    std::int32_t count[3][most_bins];

    Bins(int x, int y, int z) : bins{x, y, z} {
        for (int axis = 0; axis < 3; ++axis)
            for (int b = 0; b < bins[axis]; ++b) box[axis][b] = nothing, count[axis][b] = 0;
    }
    void add(int axis, int bin, const QuadBox& more, std::int32_t items) {
        box[axis][bin].add(more), count[axis][bin] += items;
    }
};

/// Ways to cut items: in the middle, along the bins of an axis, or by their forms, those of form `bin` first.
enum CutAxis { in_the_middle = -1, by_form = 3 };
struct Cut {
    float cost = infinity;  // in boxes' half areas
    int axis = in_the_middle, bin = 0;
};

/// The cheapest cut along the bins of one of the axes, both sides of which have items.
inline Cut best_cut(const Bins& in, std::int32_t count) {
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
        float cost_left[most_bins];
        QuadBox sum = nothing;
        std::int32_t n = 0;
        for (int b = 0; b + 1 < in.bins[axis]; ++b) {
            sum.add(in.box[axis][b]), n += in.count[axis][b];
            cost_left[b] = static_cast<float>(n) * sum.half_area();
        }
        sum = nothing, n = 0;
        for (int b = in.bins[axis] - 1; b > 0; --b) {
            sum.add(in.box[axis][b]), n += in.count[axis][b];
            const float cost = cost_left[b - 1] + static_cast<float>(n) * sum.half_area();
            if (n > 0 && n < count && cost < best.cost) best = {cost, axis, b};
        }
    }
    return best;
}

}  // namespace strahl::hierarchy_cut
