// Converts motions to POV-Ray transformations that depend on `clock`.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scene/motion/transformation.h"

namespace strahl {

/// Names motions when they are first used. Equal motions share a name.
class PovMotions {
  public:
    /// Returns the statement that applies a motion: "transform { Motion_1 }".
    std::string use(const Motion& motion);
    /// Returns the declarations of all motions used; empty if there are none.
    std::string section() const;

  private:
    std::vector<std::pair<Motion, std::string>> declared;
};

/// Returns transformations as POV-Ray statements.
std::vector<std::string> statements(const std::vector<Transformation>& steps, PovMotions& motions);

}  // namespace strahl
