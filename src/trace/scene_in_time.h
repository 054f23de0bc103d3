// Moves a scene's bodies and lights from one moment to another.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "num/thread_pool.h"
#include "scene/moving_scene.h"

namespace strahl {

/// A scene as it is at one moment. That is time 0 at first, at which bodies are as they are declared (see matrix),
/// unless they follow tracks. Whether any moves is only looked up when another time is asked for.
class SceneInTime {
  public:
    explicit SceneInTime(Scene&& own) : now(std::move(own)) {
        const auto moved = [](const Light& light) { return light.motion.has_value(); };
        if (now.tracks.empty() && std::ranges::none_of(now.lights, moved)) return;
        begin();
        if (!moving) return;
        const SceneTime start = scene_time(*moving, 0);
        if (!now.tracks.empty()) move_bodies(now, *moving, movers->bodies, start);
        move_others(now, *moving, *movers, start);
    }
    const Scene& scene() const { return now; }
    const Scene& declared() const { return moving ? *moving : now; }
    bool moves() const { return moving.has_value(); }

    /// Moves what moves, by all threads. `tracks`, if any, are in place of the scene's. Returns whether the scene is
    /// another one now.
    bool set(double wanted, const std::shared_ptr<const std::vector<Track>>& wanted_tracks, ThreadPool& pool) {
        if (wanted == time && wanted_tracks == tracks) return false;
        if (!movers) begin();
        time = wanted, tracks = wanted_tracks;
        if (!moving) return false;
        const SceneTime moment = scene_time(*moving, time, tracks.get());
        constexpr std::int32_t share = 1024;  // a thread's piece of work
        share_out(pool, static_cast<std::int32_t>(movers->bodies.size()), share,
                  [&](std::int32_t first, std::int32_t last) {
                      move_bodies(now, *moving, std::span(movers->bodies).subspan(first, last - first), moment);
                  });
        move_others(now, *moving, *movers, moment);
        return true;
    }

    /// Nothing, or no more than the places of lights, or more.
    enum class Changed { nothing, places_of_lights, more };
    /// Does what set does, and returns what is another than before.
    Changed change(double wanted, const std::shared_ptr<const std::vector<Track>>& wanted_tracks, ThreadPool& pool) {
        if (!moving) return set(wanted, wanted_tracks, pool) ? Changed::more : Changed::nothing;
        const Moved before = moved();
        if (!set(wanted, wanted_tracks, pool)) return Changed::nothing;
        Moved after = moved();
        if (after == before) return Changed::nothing;
        for (std::size_t i = 0; i < after.lights.size(); ++i) {
            Light& own = after.lights[i];
            const Light& earlier = before.lights[i];
            own.position = earlier.position, own.direction = earlier.direction, own.from = earlier.from;
            own.area = earlier.area, own.spot = earlier.spot;
        }
        return after == before ? Changed::places_of_lights : Changed::more;
    }

  private:
    /// All that moves, as it is now.
    struct Moved {
        std::vector<Primitive> bodies;
        std::vector<Light> lights;
        std::vector<Material> materials;
        Pigment background;
        std::optional<Fog> fog;
        bool operator==(const Moved&) const = default;
    };
    Moved moved() const {
        Moved all{{}, {}, {}, now.background, now.fog};
        for (const std::int32_t i : movers->bodies) all.bodies.push_back(now.primitives[i]);
        for (const std::int32_t i : movers->lights) all.lights.push_back(now.lights[i]);
        for (const std::int32_t i : movers->materials) all.materials.push_back(now.materials[i]);
        return all;
    }

    void begin() {
        movers.emplace(now);
        if (movers->any()) moving = now;
    }

    Scene now;
    std::optional<Movers> movers;  // once they are looked up
    std::optional<Scene> moving;   // only if something moves
    double time = 0;
    std::shared_ptr<const std::vector<Track>> tracks;
};

}  // namespace strahl
