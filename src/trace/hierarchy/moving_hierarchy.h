// The hierarchy of a world whose items move from frame to frame.
#pragma once
#include <span>
#include <vector>

#include "trace/hierarchy/hierarchy.h"

namespace strahl {

/// Keeps the division of the items and fits its boxes to where they are now, which takes a tenth of the time, until
/// rays would pass so much more of them that it is built anew. What is nearest does not depend on how items are
/// divided; the order of the leaves does.
class MovingHierarchy {
  public:
    /// Does what build_hierarchy does. `starts` are where the items of each form begin; if they differ from those of
    /// the last time, the hierarchy is built anew.
    Hierarchy fit(Buffer<ItemBox> boxes, std::span<const std::int32_t> starts, double margin, ThreadPool& pool);

  private:
    Hierarchy kept;
    double cost = 0;  // when it was built
    std::vector<std::int32_t> kept_starts;
};

}  // namespace strahl
