// The hierarchy of a world whose items move from frame to frame.
#pragma once
#include <span>
#include <vector>

#include "trace/hierarchy/hierarchy.h"

namespace strahl {

/// Keeps the hierarchy of the last frame and refits its boxes, which takes a tenth of the time of building, until rays
/// would cross so many more boxes that it is built anew. Nearest hits do not depend on how items are divided; the
/// order of the leaves does.
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
