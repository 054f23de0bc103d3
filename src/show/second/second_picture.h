// Makes the picture to the right of the window's divider: by POV-Ray, or by Strahl with other settings.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "num/thread_pool.h"
#include "scene/scene.h"
#include "show/motion/screen_image.h"
#include "show/session/divider.h"
#include "trace/world/view.h"

namespace strahl {

struct SecondOrder {
    SecondKind kind = SecondKind::none;
    std::shared_ptr<const Scene> scene{};
    View view{};
    std::string path{};     // of the scene's file
    bool mirrored = false;  // see OpenedScene
    Exposure exposure{};    // of `image`; POV-Ray's has no light above white that it could show
    bool brief = false;     // one ray in each pixel is all; another order follows soon

    /// Are both for the same picture?
    bool operator==(const SecondOrder& other) const;
};

struct SecondPicture {
    ScreenImage image{};
    /// 16 times its difference from a picture of Strahl's that is sampled alike, whether `image` is or not: one ray in
    /// double for POV-Ray's of one ray, else averages in float.
    ScreenImage difference{};   // empty for the camera of the flight, and for layers
    std::size_t differing = 0;  // pixels with a channel that differs by more than 1/255
    bool finished = false;      // else a better one follows
    /// What the middle of a pixel shows, as a layer has it.
    struct SeenPoint {
        float distance = 0;  // infinite where no body is
        std::array<float, 3> normal{}, position{};
    };
    std::vector<SeenPoint> seen{};  // of layers, pixel by pixel
};

/// Writes into `result` how much its image differs from another one, as both are on the screen.
void compare(const ScreenImage& other, SecondPicture& result);

/// Makes it, and calls `publish` with each stage. POV-Ray first traces one ray in each pixel, as strahl crosscheck has
/// it, then 10. Layers have one ray in each pixel, in double, through the middle of a lens. Throws Stopped when `stop`
/// became true, else std::exception with the reason if it fails.
void make_second(const SecondOrder& order, ThreadPool& pool, const std::atomic<bool>& stop,
                 const std::function<void(SecondPicture)>& publish);

}  // namespace strahl
