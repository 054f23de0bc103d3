// Finds the silhouette of bodies in the picture, in the background: by tracing them alone.
#pragma once
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "scene/scene.h"
#include "show/work/worker.h"
#include "trace/world/view.h"

namespace strahl {

/// A line between pixels that show a body and pixels that do not, in pixels from the picture's top left corner.
struct SilhouetteLine {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    bool operator==(const SilhouetteLine&) const = default;
};
/// Returns the lines around what is true in a picture, each as long as it can be.
std::vector<SilhouetteLine> lines_around(const std::vector<bool>& inside, int width, int height);

class Silhouette {
  public:
    /// `notify` is called from another thread when there is something to take.
    explicit Silhouette(std::function<void()> notify) : worker(std::move(notify)) {}

    /// Asks for the silhouette of bodies. Nothing is done if it is the one that was asked for last.
    void want(std::shared_ptr<const Scene> scene, std::vector<int> bodies, const View& view);
    /// Forgets the bodies.
    void drop();
    /// To be called regularly. Returns true when the lines have changed.
    bool take();
    const std::vector<SilhouetteLine>& lines() const { return found; }

  private:
    struct Subject {
        std::shared_ptr<const Scene> scene;
        std::vector<int> bodies;
        View view;
    };

    Subject wanted;
    std::vector<SilhouetteLine> found;
    Worker<std::vector<SilhouetteLine>> worker;
};

}  // namespace strahl
