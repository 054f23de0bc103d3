// A scene whose bodies and lights may move, as it is at one moment after the other.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "scene/motion.h"
#include "trace/thread_pool.h"

namespace strahl {

/// Begins at time 0. Scenes in which nothing moves are kept once and never touched.
class Stage {
  public:
    explicit Stage(Scene&& own) : now(std::move(own)), movers(now) {
        if (!movers.any()) return;
        moving = std::move(now);
        now = at(*moving, 0);
    }
    const Scene& scene() const { return now; }
    bool moves() const { return moving.has_value(); }

    /// Moves what moves, by all threads. Returns whether the scene is another one now.
    bool set(double wanted, ThreadPool& pool) {
        if (!moving || wanted == time) return false;
        constexpr std::int32_t share = 1024;  // a thread's piece of work
        share_out(pool, static_cast<std::int32_t>(movers.bodies.size()), share,
                  [&](std::int32_t first, std::int32_t last) {
                      move_bodies(now, *moving, std::span(movers.bodies).subspan(first, last - first), wanted);
                  });
        move_lights(now, *moving, movers.lights, wanted);
        time = wanted;
        return true;
    }

  private:
    Scene now;
    Movers movers;
    std::optional<Scene> moving;  // only if something moves
    double time = 0;
};

}  // namespace strahl
