// Bounding volume hierarchies: wide nodes, one child in each lane.
#pragma once
#include <cstdint>

#include "num/bounding_box.h"
#include "num/buffer.h"

namespace strahl {

class ThreadPool;

/// How many items a leaf holds, and their form, as one number above 0: traversal keeps many of them.
struct LeafCode {
    static constexpr int most_items = 31;
    static constexpr int make(int form, int items) { return (most_items + 1) * form + items; }
    static constexpr int items(int code) { return static_cast<int>(static_cast<unsigned>(code) % (most_items + 1)); }
    static constexpr int form(int code) { return static_cast<int>(static_cast<unsigned>(code) / (most_items + 1)); }
};

/// Up to 16 children, their boxes side by side. Boxes are of floats for every kind of number, rounded outwards. A leaf
/// holds items of one form.
struct alignas(64) Node {
    static constexpr int width = 16;
    float low[3][width], high[3][width];
    std::int32_t first[width];   // of a leaf: its first item; else: the child's node
    std::int16_t leaves[width];  // of a leaf: a LeafCode; else 0
    std::int32_t children = 0;   // lanes from here on are empty
};

/// The box around an item of a form, its corners rounded to the nearest floats. Which item is for the builder to note.
struct alignas(16) ItemBox {
    float low[3];
    std::int32_t item;
    float high[3];
    std::int32_t form;
};

inline ItemBox item_box(const Box& box, int form) {
    ItemBox result;
    for (int c = 0; c < 3; ++c)
        result.low[c] = static_cast<float>(box.low[c]), result.high[c] = static_cast<float>(box.high[c]);
    result.form = form;
    return result;
}

/// Nodes, root first, and the order in which the leaves hold the items.
struct Hierarchy {
    /// Most nodes on a way from the root to a leaf.
    static constexpr int most_levels = 64;
    Buffer<Node> nodes;
    std::int32_t size = 0;  // of nodes
    Buffer<std::int32_t> order;
};

/// Boxes are finite, and are grown by `margin` and by what rounding may have cost them. Binned surface area heuristic
/// (I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007), of whose binary nodes the largest
/// are opened until 16 are side by side. Where there are many boxes, cuts are along the cells of a grid, which each box
/// is sorted into once (after K. Garanzha, J. Pantaleoni and D. McAllister, "Simpler and Faster HLBVH with Work
/// Queues", 2011, whose cells are those of Morton codes). The same for any number of threads.
Hierarchy build_hierarchy(Buffer<ItemBox> boxes, std::int32_t size, double margin, ThreadPool& pool);

}  // namespace strahl
