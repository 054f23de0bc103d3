// Building bounding volume hierarchies.
#pragma once
#include <vector>

#include "num/box.h"
#include "trace/world.h"

namespace strahl {

/// Nodes, root first, and the order in which the leaves hold the items.
template <class T>
struct Hierarchy {
    std::vector<Node<T>> nodes;
    std::vector<std::int32_t> order;
};

/// Boxes are grown by `margin` and rounded outwards. Binned surface area heuristic (I. Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", 2007).
template <class T>
Hierarchy<T> build_hierarchy(const std::vector<Box>& boxes, double margin);

}  // namespace strahl
