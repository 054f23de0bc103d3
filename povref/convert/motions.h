// Motions as POV-Ray transformations that depend on `clock`.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// Motions get names when they are first asked for, and equal ones the same.
class PovMotions {
  public:
    /// The statement that applies a motion: "transform { Motion_1 }".
    std::string use(const Motion& motion);
    /// Their declarations; empty if there are none.
    std::string section() const;

  private:
    std::vector<std::pair<Motion, std::string>> declared;
};

/// Transformations as POV-Ray statements.
std::vector<std::string> statements(const std::vector<Transformation>& steps, PovMotions& motions);

}  // namespace strahl
