// Bounding volume hierarchies: wide nodes, one child in each lane.
#pragma once
#include <cstdint>

#include "num/bounding_box.h"
#include "num/buffer.h"

namespace strahl {

class ThreadPool;

/// The number of items in a leaf and their form as one number above 0: stacks of traversal hold many of these.
struct LeafCode {
    static constexpr int most_items = 31;
    static constexpr int make(int form, int items) { return (most_items + 1) * form + items; }
    static constexpr int items(int code) { return static_cast<int>(static_cast<unsigned>(code) % (most_items + 1)); }
    static constexpr int form(int code) { return static_cast<int>(static_cast<unsigned>(code) / (most_items + 1)); }
};

/// A node with up to 16 children, whose boxes are stored side by side, in float for every element type, rounded
/// outwards. A leaf holds items of one form.
struct alignas(64) Node {
    static constexpr int width = 16;
    float low[3][width], high[3][width];
    std::int32_t first[width];   // of a leaf: its first item; else: the child's node
    std::int16_t leaves[width];  // of a leaf: a LeafCode; else 0
    std::int32_t children = 0;   // lanes from here on are empty
    bool together = false;       // is a child a body that one ray takes as long to test as a pack of rays?
    bool only = false;           // is this node the whole hierarchy?
};

/// The box around an item of a form, its corners rounded to the nearest floats. The builder sets `item`.
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
    /// The most nodes on a path from the root to a leaf.
    static constexpr int most_levels = 64;
    Buffer<Node> nodes;
    std::int32_t size = 0;  // of nodes
    Buffer<std::int32_t> order;
};

/// Builds the hierarchy of finite boxes, each grown by `margin` and the rounding of its corners, by the binned surface
/// area heuristic (I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007). Of its binary nodes
/// those become children of wide ones with which rays are expected to visit the fewest nodes. Many boxes are first
/// sorted into the cells of a grid, along which they are cut (after K. Garanzha, J. Pantaleoni and D. McAllister,
/// "Simpler and Faster HLBVH with Work Queues", 2011, who use cells of Morton codes). The result does not depend on the
/// number of threads. Leaves have more triangles if single rays test as many `lanes` of them side by side as a leaf can
/// hold.
Hierarchy build_hierarchy(Buffer<ItemBox> boxes, std::int32_t size, double margin, ThreadPool& pool, int lanes = 1);

}  // namespace strahl
