#include "pov/flight_file.h"

#include <array>
#include <utility>

#include "num/decimal.h"
#include "pov/ini_file.h"
#include "text/edit_path.h"
#include "text/parse.h"

namespace strahl::pov {
namespace {

Flythrough mirrored_path(Flythrough path) {
    for (Keyframe& key : path.keys) {
        key.position.z = 0 - key.position.z, key.look_at.z = 0 - key.look_at.z;
        if (key.up) key.up->z = 0 - key.up->z;
    }
    return path;
}

}  // namespace

std::string flight_path(const std::string& scene) { return beside(scene, ".flight"); }

std::optional<Flythrough> parse_flight(const std::string& text, const std::string& path) {
    const std::string whole = std::string(stand_in_camera) + text;
    const std::array origins{TextOrigin{0, path, text, 0}, TextOrigin{stand_in_camera.size(), path, text, 0}};
    Scene read = parse_scene(whole, path, {}, {}, nullptr, origins);
    std::optional<Flythrough> flight = std::exchange(read.flythrough, std::nullopt);
    Scene nothing_else;
    nothing_else.camera = read.camera;
    if (read != nothing_else) throw FileError(path + ": a flight has a 'flythrough { ... }' and nothing else");
    return flight;
}

Flythrough flight_in(const Scene& scene, bool mirrored, Flythrough flight, const std::string& path) {
    if (mirrored) flight = mirrored_path(std::move(flight));
    for (const Keyframe& key : flight.keys)
        if (const char* const why = degenerate(camera_of(key, scene.camera)))
            throw FileError(path + ": invalid camera at the key of " + strahl::text_of(key.time) + " s: " + why);
    return flight;
}

std::string with_flight(const std::string& text, const std::optional<Flythrough>& path, bool mirrored) {
    const auto own = path && mirrored ? std::optional(mirrored_path(*path)) : path;
    return with_path(text, own, EyeWords{.sky = true, .angle = true});
}

}  // namespace strahl::pov
