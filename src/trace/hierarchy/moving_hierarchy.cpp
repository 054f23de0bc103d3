#include "trace/hierarchy/moving_hierarchy.h"

#include <algorithm>
#include <utility>

#include "num/thread_pool.h"
#include "trace/hierarchy/hierarchy_cut.h"

namespace strahl {
namespace {

using namespace hierarchy_cut;

constexpr double most_growth = 1.25;      // the cost may grow by this factor before a new hierarchy is built
constexpr std::int32_t share_nodes = 64;  // a thread's piece of work

QuadBox child_bounds(const Node& node, int child) {
    QuadBox box = nothing;
    for (int c = 0; c < 3; ++c) box.low[c] = node.low[c][child], box.high[c] = node.high[c][child];
    return box;
}
void set_bounds(Node& node, int child, const QuadBox& box) {
    for (int c = 0; c < 3; ++c) node.low[c][child] = box.low[c], node.high[c][child] = box.high[c];
}
QuadBox bounds_of(const Node& node) {
    QuadBox box = nothing;
    for (int child = 0; child < node.children; ++child) box.add(child_bounds(node, child));
    return box;
}

/// Returns the cost of the tests that a ray through the root's box is expected to make.
double cost_of(const Hierarchy& hierarchy) {
    double sum = 0;
    for (std::int32_t n = 0; n < hierarchy.size; ++n) {
        const Node& node = hierarchy.nodes[n];
        for (int child = 0; child < node.children; ++child)
            sum += child_bounds(node, child).half_area() * (1 + item_cost * LeafCode::items(node.leaves[child]));
    }
    return sum / bounds_of(hierarchy.nodes[0]).half_area();
}

Hierarchy copy(const Hierarchy& from, std::int32_t items) {
    Hierarchy to{uninitialized_buffer<Node>(from.size), from.size, uninitialized_buffer<std::int32_t>(items)};
    std::copy_n(from.nodes.get(), from.size, to.nodes.get());
    std::copy_n(from.order.get(), items, to.order.get());
    return to;
}

/// Fits the boxes of leaves, by all threads, and then the boxes above them: children have higher numbers than parents.
void fit_boxes(Hierarchy& hierarchy, const ItemBox* boxes, double margin, ThreadPool& pool) {
    share_out(pool, hierarchy.size, share_nodes, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t n = first; n < last; ++n) {
            Node& node = hierarchy.nodes[n];
            for (int child = 0; child < node.children; ++child) {
                const std::int32_t* const items = &hierarchy.order[node.first[child]];
                QuadBox box = nothing;
                for (int i = 0; i < LeafCode::items(node.leaves[child]); ++i)
                    box.add(grown(hierarchy_cut::bounds_of(boxes[items[i]]), margin));
                if (node.leaves[child] != 0) set_bounds(node, child, box);
            }
        }
    });
    for (std::int32_t n = hierarchy.size - 1; n >= 0; --n) {
        Node& node = hierarchy.nodes[n];
        for (int child = 0; child < node.children; ++child)
            if (node.leaves[child] == 0) set_bounds(node, child, bounds_of(hierarchy.nodes[node.first[child]]));
    }
}

}  // namespace

Hierarchy MovingHierarchy::fit(Buffer<ItemBox> boxes, std::span<const std::int32_t> starts, double margin,
                               ThreadPool& pool) {
    const std::int32_t size = starts.back();
    if (std::ranges::equal(starts, kept_starts)) {
        Hierarchy fitted = copy(kept, size);
        fit_boxes(fitted, boxes.get(), margin, pool);
        if (cost_of(fitted) <= most_growth * cost) return fitted;
    }
    kept = build_hierarchy(std::move(boxes), size, margin, pool);
    kept_starts.assign(starts.begin(), starts.end());
    cost = cost_of(kept);
    return copy(kept, size);
}

}  // namespace strahl
