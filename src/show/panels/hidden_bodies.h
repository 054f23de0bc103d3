// Keeps the bodies that the user has hidden in the picture. Hiding does not change the text of the scene.
#pragma once
#include <memory>
#include <set>

#include "scene/scene.h"
#include "show/panels/outliner.h"

namespace strahl {

class HiddenBodies {
  public:
    /// Returns the numbers of the hidden bodies in the scene.
    const std::set<int>& numbers() const { return hidden; }
    /// Hides and shows what the user asked for in the outline of a scene.
    void apply(const OutlinerInput& input, const std::shared_ptr<const Scene>& scene);
    void show_all() { hidden.clear(), whole = rest = nullptr; }
    /// Returns a scene without the hidden bodies. If it has other bodies than before, all are shown: the numbers of
    /// hidden ones would be those of other bodies then.
    std::shared_ptr<const Scene> scene_without(const std::shared_ptr<const Scene>& scene);

  private:
    std::set<int> hidden;
    std::shared_ptr<const Scene> whole, rest;  // the last scene, and what it is without the hidden bodies
};

}  // namespace strahl
