// Decides which binary nodes become the children of a wide one.
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "trace/hierarchy/hierarchy_cut.h"

namespace strahl::hierarchy_cut {

/// A part of the items that is cut in two again and again, down to leaves.
struct OpenedPart {
    QuadBox box;
    std::int32_t first = 0, code = 0;  // of a leaf: its first item and its LeafCode
    std::int32_t halves[2]{};          // else: where these are among all parts
    int most = 1;                      // it can become so many children of a wide node and no more
    // The half areas of all wide nodes below, which rays are expected to visit as often, if it becomes so many children
    // or fewer.
    float cost[Node::width + 1]{};

    /// Sets the costs from those of the halves (H. Ylitie, T. Karras and S. Laine, "Efficient Incoherent Ray Traversal
    /// on GPUs Through Compressed Wide BVHs", 2017, without their choice of leaves).
    void join(const OpenedPart& left, const OpenedPart& right) {
        most = std::min(left.most + right.most, Node::width);
        std::fill_n(cost + 2, Node::width - 1, infinity);
        for (int l = 1; l <= left.most; ++l)
            for (int r = 1; r <= right.most && l + r <= most; ++r)
                cost[l + r] = std::min(cost[l + r], left.cost[l] + right.cost[r]);
        cost[1] = box.half_area() + cost[most];
        for (int i = 2; i <= Node::width; ++i) cost[i] = std::min(cost[1], cost[std::min(i, most)]);
    }
};

/// Adds what a part becomes at the least cost as so many children of a wide node, two or more.
inline void open_part(const std::vector<OpenedPart>& opened, const OpenedPart& whole, int count,
                      std::vector<const OpenedPart*>& children) {
    const OpenedPart &left = opened[whole.halves[0]], &right = opened[whole.halves[1]];
    const auto cost = [&](int of_left) { return left.cost[of_left] + right.cost[count - of_left]; };
    int of_left = 1;
    for (int i = 2; i < count; ++i)
        if (cost(i) < cost(of_left)) of_left = i;
    for (const auto& [half, own] : {std::pair{&left, of_left}, std::pair{&right, count - of_left}}) {
        if (half->cost[own] < half->cost[1])
            open_part(opened, *half, own, children);
        else
            children.push_back(half);
    }
}

}  // namespace strahl::hierarchy_cut
