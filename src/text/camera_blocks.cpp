// Where the eye stands, and its path.
#include "text/camera_blocks.h"

#include <utility>

namespace strahl {
namespace {

constexpr Bounds seconds{0, 1e15, "from 0 to 1e15"};
// The largest doubles below 90 and 180.
constexpr Bounds fovs{smallest_positive, 90 - 1e-14, "greater than 0 and less than 90 degrees"};
constexpr Bounds angles{2 * smallest_positive, 180 - 2e-14, "greater than 0 and less than 180 degrees"};

}  // namespace

/// What camera and key have in common, with both ways to say which way is up and how wide the view; and one more
/// parameter, which is each one's own.
struct CameraBlocks::Eye {
    DVec3 position{0}, look_at{0}, down{0}, sky{0};
    double half = 0, angle = 0, own_value = 0;
    std::array<Parameter, 7> parameters;
    const Parameter &position_given = parameters[0], &look_at_given = parameters[1], &own = parameters[6];

    Eye(std::string_view own_name, Bounds own_bounds)
        : parameters{{{"position", &position, coordinates},
                      {"look_at", &look_at, coordinates},
                      {"up", &down, coordinates},
                      {"sky", &sky, coordinates},
                      {"fov", &half, fovs},
                      {"angle", &angle, angles},
                      {own_name, &own_value, own_bounds}}} {}
    Eye(const Eye&) = delete;  // parameters point into it

    std::optional<DVec3> up() const {
        if (parameters[2].given()) return down;
        return parameters[3].given() ? std::optional(DVec3(0) - sky) : std::nullopt;
    }
    std::optional<double> fov() const {
        if (parameters[4].given()) return half;
        return parameters[5].given() ? std::optional(angle / 2) : std::nullopt;
    }
    void read(Reader& reader, Block& block) {
        reader.block(block, parameters);
        for (const int i : {2, 4}) {
            const Parameter *first = &parameters[i], *second = &parameters[i + 1];
            if (!first->given() || !second->given()) continue;
            if (second->at.data() < first->at.data()) std::swap(first, second);
            reader.diagnostics.add(second->at, quoted(second->name) + " says again what " + quoted(first->name) +
                                                   " in " + reader.diagnostics.line(first->at) +
                                                   " says; only one of them may stand");
            block.bad = true;
        }
    }
};

void CameraBlocks::camera(std::string_view word) {
    reader.once(camera_at, word);
    Block block{word};
    Eye eye("aspectratio", positive);
    eye.read(reader, block);
    reader.require(block, {{eye.position_given.given(), "'position'"},
                           {eye.look_at_given.given(), "'look_at'"},
                           {eye.up().has_value(), "'up' (or 'sky')"},
                           {eye.fov().has_value(), "'fov' (or 'angle')"}});
    if (!block.good()) return;
    the_camera = {eye.position, eye.look_at, *eye.up(), *eye.fov(), std::nullopt};
    if (eye.own.given()) the_camera.aspectratio = eye.own_value;
    const char* const fault = degenerate(the_camera);
    if (fault) reader.diagnostics.add(word, std::string("this camera sees nothing: ") + fault);
    camera_good = !fault;
}

void CameraBlocks::key(std::string_view word, Flythrough& read_path, std::vector<KeyPlace>& places, Block& outer) {
    if (read_path.keys.size() >= limits.keys) {
        reader.diagnostics.add(word, "more than " + std::to_string(limits.keys) + " keys");
        reader.diagnostics.check();
    }
    Block block{word};
    Eye eye("time", seconds);
    eye.read(reader, block);
    reader.require(block, {{eye.own.given(), "'time'"},
                           {eye.position_given.given(), "'position'"},
                           {eye.look_at_given.given(), "'look_at'"}});
    outer.absorb(block);
    read_path.keys.push_back({eye.own_value, eye.position, eye.look_at, eye.fov(), eye.up()});
    places.push_back({word, eye.own.at});
}

void CameraBlocks::flythrough(std::string_view word) {
    reader.once(path_at, word);
    Flythrough read_path;
    std::vector<KeyPlace> places;
    Block block{word};
    std::array parameters{Parameter{"duration", &read_path.duration, lengths}, Parameter{"loop", &read_path.loop}};
    constexpr std::array<std::string_view, 1> other{"key"};
    reader.block(block, parameters, other, [&](std::string_view inner) {
        if (inner != "key") return false;
        key(inner, read_path, places, block);
        return true;
    });
    const bool enough = read_path.keys.size() >= 2;
    reader.require(block, {{parameters[0].given(), "'duration'"}, {enough, "keys: it takes 2 to make a path"}});
    if (!block.good()) return;
    check_times(read_path, places, parameters[0].at);
    path = std::move(read_path);
    key_places = std::move(places);
}

void CameraBlocks::check_times(const Flythrough& read_path, std::span<const KeyPlace> places,
                               std::string_view duration) {
    const std::vector<Keyframe>& keys = read_path.keys;
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (i > 0 && !(keys[i].time > keys[i - 1].time))
            reader.diagnostics.add(places[i].time, "times must rise: the key before, in " +
                                                       reader.diagnostics.line(places[i - 1].time) +
                                                       ", is not earlier than this one");
        else if (keys[i].time > read_path.duration)
            reader.diagnostics.add(places[i].time, "this is after the end, which 'duration' in " +
                                                       reader.diagnostics.line(duration) + " sets");
    // The path that loops is at its first key again when the duration is over.
    Keyframe again = keys.front();
    again.time += read_path.duration;
    if (read_path.loop && keys.back().time == again.time && keys.back() != again)
        reader.diagnostics.add(places.back().time,
                               "at this time the loop is at its first key again: make this key the same as that in " +
                                   reader.diagnostics.line(places[0].key) + ", or 'duration' longer");
}

void CameraBlocks::check(std::string_view end_of_text) {
    if (!camera_at.data()) reader.diagnostics.add(end_of_text, "no camera: a scene needs one 'camera { ... }'");
    if (!camera_good || !path) return;
    for (std::size_t i = 0; i < path->keys.size(); ++i)
        if (const char* const fault = degenerate(camera_of(path->keys[i], the_camera)))
            reader.diagnostics.add(key_places[i].key, std::string("the camera sees nothing at this key: ") + fault);
}

}  // namespace strahl
