#include "scene/moving_scene.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "files/error.h"
#include "num/vec_math.h"
#include "scene/follow.h"
#include "scene/leaves.h"

namespace strahl {
namespace {

/// Calls visit(motion) for all motions of a body and its parts.
template <class Visit>
void each_motion(const Primitive& primitive, const Visit& visit) {
    for (const Transformation& step : primitive.transformations)
        if (const Motion* const motion = std::get_if<Motion>(&step)) visit(*motion);
    each_part(primitive, [&](const Primitive& part) { each_motion(part, visit); });
}

/// Moves a body and its parts. `now` is a copy of `moving`; steps(now, moving) sets its transformations by those.
template <class Steps>
void move(Primitive& now, const Primitive& moving, const Steps& steps) {
    steps(now.transformations, moving.transformations);
    const auto move_parts = [&]<class Kind>(const Kind& kind) {
        if constexpr (is_composite<Kind>) {
            if (std::ranges::none_of(*kind.parts, moves)) return;
            std::vector<Primitive> parts = *kind.parts;
            for (std::size_t i = 0; i < parts.size(); ++i) move(parts[i], (*kind.parts)[i], steps);
            std::get<Kind>(now.shape).parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
        }
    };
    std::visit(move_parts, moving.shape);
}

bool follows_tracks(const Motion& motion) { return motion.keys.size() == 1; }

void move(Light& light, const SceneTime& time) {
    follow(light, time.tracks);
    if (!light.motion) return;
    const glm::dmat4 m = matrix(at(*light.motion, time.seconds));
    light.motion.reset();
    if (light.direction)
        light.direction = glm::dmat3(m) * *light.direction;
    else
        light.position = transform_point(m, light.position);
    if (light.from) light.from = transform_point(m, *light.from);
    if (light.area) light.area->u = glm::dmat3(m) * light.area->u, light.area->v = glm::dmat3(m) * light.area->v;
    if (light.spot) light.spot->look_at = transform_point(m, light.spot->look_at);
}

void follow_others(Scene& now, const TrackValues& tracks) {
    follow(now.background, now.background_follows, tracks);
    now.background_follows.clear();
    if (now.fog) follow(*now.fog, tracks);
}

}  // namespace

bool moves(const Primitive& primitive) {
    bool any = false;
    each_motion(primitive, [&](const Motion&) { any = true; });
    return any;
}

Movers::Movers(const Scene& scene)
    : air(!scene.background_follows.empty() || (scene.fog && !scene.fog->follows.empty())) {
    const auto until = [this](const Motion& motion) { last_key = std::max(last_key, motion.keys.back().time); };
    for (std::size_t i = 0; i < scene.primitives.size(); ++i)
        if (moves(scene.primitives[i])) {
            bodies.push_back(static_cast<std::int32_t>(i));
            each_motion(scene.primitives[i], until);
        }
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Light& light = scene.lights[i];
        if (light.motion || !light.follows.empty()) lights.push_back(static_cast<std::int32_t>(i));
        if (light.motion) until(*light.motion);
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (!scene.materials[i].follows.empty()) materials.push_back(static_cast<std::int32_t>(i));
    if (scene.tracks.empty()) return;
    const std::vector<std::string> followed = followed_tracks(scene);
    for (const Track& track : scene.tracks)
        if (!track.keys.empty() && std::ranges::find(followed, track.name) != followed.end())
            last_key = std::max(last_key, scene.music.time_of(track.keys.back().row));
}

std::vector<std::string> followed_tracks(const Scene& scene) {
    std::vector<std::string> names;
    const auto add = [&](const std::vector<Follow>& follows) {
        for (const Follow& f : follows)
            if (std::ranges::find(names, f.track) == names.end()) names.push_back(f.track);
    };
    add(scene.camera_follows), add(scene.background_follows);
    if (scene.fog) add(scene.fog->follows);
    for (const Light& light : scene.lights) add(light.follows);
    for (const Material& material : scene.materials) add(material.follows);
    for (const Primitive& primitive : scene.primitives)
        each_motion(primitive, [&](const Motion& motion) { add(motion.keys.front().follows); });
    return names;
}

SceneTime scene_time(const Scene& scene, double seconds, const std::vector<Track>* tracks) {
    if (scene.flythrough && scene.flythrough->loop) {
        const double period = scene.flythrough->duration;
        seconds -= period * std::floor(seconds / period);
    }
    return {seconds, TrackValues(tracks ? *tracks : scene.tracks, scene.music.row_at(seconds))};
}

void move_bodies(Scene& now, const Scene& scene, std::span<const std::int32_t> bodies, const SceneTime& time) {
    const auto steps = [&](std::vector<Transformation>& still, const std::vector<Transformation>& moving) {
        set_at(still, moving, time.seconds, time.tracks);
    };
    for (const std::int32_t i : bodies) move(now.primitives[i], scene.primitives[i], steps);
}

void move_others(Scene& now, const Scene& scene, const Movers& movers, const SceneTime& time) {
    for (const std::int32_t i : movers.lights) move(now.lights[i] = scene.lights[i], time);
    for (const std::int32_t i : movers.materials) follow(now.materials[i] = scene.materials[i], time.tracks);
    if (!movers.air) return;
    now.background = scene.background, now.background_coats = scene.background_coats,
    now.background_follows = scene.background_follows, now.fog = scene.fog;
    follow_others(now, time.tracks);
}

Scene at(const Scene& scene, double seconds) {
    Scene now = scene;
    const Movers movers(scene);
    const SceneTime time = scene_time(scene, seconds);
    move_bodies(now, scene, movers.bodies, time);
    move_others(now, scene, movers, time);
    return now;
}

Scene without_tracks(const Scene& scene, double seconds) {
    Scene now = scene;
    const TrackValues tracks = scene_time(scene, seconds).tracks;
    const auto steps = [&](std::vector<Transformation>& all, const std::vector<Transformation>& moving) {
        all.clear();
        for (const Transformation& step : moving) {
            const Motion* const motion = std::get_if<Motion>(&step);
            const bool still = motion && follows_tracks(*motion);
            const auto own = still ? at(*motion, 0, tracks) : std::vector{step};
            all.insert(all.end(), own.begin(), own.end());
        }
    };
    for (std::size_t i = 0; i < scene.primitives.size(); ++i)
        if (moves(scene.primitives[i])) move(now.primitives[i], scene.primitives[i], steps);
    for (Light& light : now.lights) follow(light, tracks);
    for (Material& material : now.materials) follow(material, tracks);
    follow_others(now, tracks);
    follow(now.camera, now.camera_follows, tracks);
    now.camera_follows.clear();
    return now;
}

Camera own_camera_at(const Scene& scene, double time, const std::vector<Track>* tracks) {
    Camera camera = scene.camera;
    if (!scene.camera_follows.empty()) follow(camera, scene.camera_follows, scene_time(scene, time, tracks).tracks);
    return camera;
}

Camera camera_at(const Scene& scene, std::optional<double> time) {
    const Camera own = own_camera_at(scene, time.value_or(0));
    const bool path = time && scene.flythrough && !scene.flythrough->keys.empty();
    return path ? camera_at(*scene.flythrough, own, *time) : own;
}

std::optional<Flythrough> flight_of(const Scene& scene) {
    std::optional<Flythrough> flight = scene.flythrough;
    const Movers movers(scene);
    if ((movers.any() || !scene.camera_follows.empty()) && !flight) flight.emplace();
    if (flight && !flight->loop) flight->duration = std::max(flight->duration, movers.last_key);
    return flight;
}
Flythrough flight_for(const char* option, const Scene& scene, const std::string& file) {
    if (auto flight = flight_of(scene)) return std::move(*flight);
    throw UsageError(std::string(option) + " needs a scene with a flythrough { }, a motion { } or a track, and " +
                     file + " has none");
}

}  // namespace strahl
