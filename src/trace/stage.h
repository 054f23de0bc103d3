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

/// Begins at time 0, at which bodies are as they are declared (see matrix). Whether any moves is looked up when another
/// time is asked for, so that other scenes are not searched.
class Stage {
  public:
    explicit Stage(Scene&& own) : now(std::move(own)) {
        if (std::ranges::any_of(now.lights, [](const Light& light) { return light.motion.has_value(); })) {
            begin();
            move_lights(now, *moving, movers->lights, 0);
        }
    }
    const Scene& scene() const { return now; }
    bool moves() const { return moving.has_value(); }

    /// Moves what moves, by all threads. Returns whether the scene is another one now.
    bool set(double wanted, ThreadPool& pool) {
        if (wanted == time) return false;
        if (!movers) begin();
        time = wanted;
        if (!moving) return false;
        constexpr std::int32_t share = 1024;  // a thread's piece of work
        share_out(pool, static_cast<std::int32_t>(movers->bodies.size()), share,
                  [&](std::int32_t first, std::int32_t last) {
                      move_bodies(now, *moving, std::span(movers->bodies).subspan(first, last - first), wanted);
                  });
        move_lights(now, *moving, movers->lights, wanted);
        return true;
    }

  private:
    void begin() {
        movers.emplace(now);
        if (movers->any()) moving = now;
    }

    Scene now;
    std::optional<Movers> movers;  // once they are looked up
    std::optional<Scene> moving;   // only if something moves
    double time = 0;
};

}  // namespace strahl
