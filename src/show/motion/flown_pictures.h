// Keeps pictures of a flight as they were shown, and compares them with the finished ones when it is over.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "image/transfer.h"
#include "scene/scene.h"
#include "show/motion/quality.h"
#include "trace/world/view.h"

namespace strahl {

/// Keeps the first two pictures of each eighth of a flight: the second of them shows what changes from one to the next.
class FlownPictures {
  public:
    /// Finished pictures have grid x grid rays in each pixel: as many as the picture needs would take six times as long
    /// in scenes with much glass, and these are off by 1.8 steps of 255 there (RMS; scenes/demo.rt).
    static constexpr int grid = 3;

    /// Takes a picture of a view that is shown after this share of the flight, and keeps it if it is one of them. Those
    /// of another round replace them.
    void shown(double share, const ScreenImage& image, const std::shared_ptr<const Scene>& scene, const View& view);
    int count() const;
    /// Traces the finished picture of each view, and compares. Returns nothing if `stop` becomes true.
    std::optional<Quality> compare(int threads, const Exposure& exposure, const std::atomic<bool>& stop) const;

  private:
    struct Kept {
        ScreenImage image;
        std::shared_ptr<const Scene> scene;
        View view;
    };
    std::array<std::vector<Kept>, 8> parts;
    std::size_t current = parts.size();  // part of the flight; none yet
};

}  // namespace strahl
