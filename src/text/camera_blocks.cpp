// Where the eye stands, and its path.
#include "text/camera_blocks.h"

namespace strahl {
namespace {

constexpr Bounds fovs{smallest_positive, 90 - 1e-14, "greater than 0 and less than 90 degrees"};
constexpr Bounds angles{2 * smallest_positive, 180 - 2e-14, "greater than 0 and less than 180 degrees"};

}  // namespace

/// What camera and key have in common, with both ways to say which way is up and how wide the view.
struct CameraBlocks::Eye {
    DVec3 position{0}, look_at{0}, up_value{0}, sky{0};
    double fov_value = 0, angle = 0, extra = 0;
    std::array<Parameter, 7> parameters{{{"position", &position, coordinates},
                                         {"look_at", &look_at, coordinates},
                                         {"up", &up_value, coordinates},
                                         {"sky", &sky, coordinates},
                                         {"fov", &fov_value, fovs},
                                         {"angle", &angle, angles},
                                         {}}};

    Eye(const char* extra_name, Bounds extra_bounds) { parameters[6] = {extra_name, &extra, extra_bounds}; }
    Eye(const Eye&) = delete;

    const Parameter& parameter(int i) const { return parameters[i]; }
    std::optional<DVec3> up() const {
        if (parameters[2].given()) return up_value;
        if (parameters[3].given()) return DVec3(0) - sky;
        return std::nullopt;
    }
    std::optional<double> fov() const {
        if (parameters[4].given()) return fov_value;
        if (parameters[5].given()) return angle / 2;
        return std::nullopt;
    }
    void check(Reader& reader, Block& block) const {
        reader.require(block, parameters[0]);
        reader.require(block, parameters[1]);
        for (const int i : {2, 4})
            if (parameters[i].given() && parameters[i + 1].given()) {
                const auto& [first, second] =
                    std::minmax(parameters[i], parameters[i + 1],
                                [](const auto& a, const auto& b) { return a.at.data() < b.at.data(); });
                reader.faults.add(second.at, quoted(second.name) + " says again what " + quoted(first.name) + " of " +
                                                 reader.faults.line(first.at) + " says; one of them must go");
                block.spoiled = true;
            }
    }
};

void CameraBlocks::camera(std::string_view word) {
    const bool first = reader.once(camera_at, word);
    Block block{word};
    Eye eye("aspectratio", positive);
    reader.block(block, eye.parameters);
    eye.check(reader, block);
    if (!eye.up()) reader.missing(block, "'up' (or 'sky')");
    if (!eye.fov()) reader.missing(block, "'fov' (or 'angle')");
    if (!first || block.spoiled || !eye.up() || !eye.fov()) return;
    the_camera = {eye.position, eye.look_at, *eye.up(), *eye.fov(), std::nullopt};
    if (eye.parameters[6].given()) the_camera.aspectratio = eye.extra;
    const char* const fault = degenerate(the_camera);
    if (fault) reader.faults.add(word, std::string("this camera sees nothing: ") + fault);
    camera_good = !fault;
}

void CameraBlocks::key(std::string_view word) {
    Block block{word};
    Eye eye("time", not_negative);
    reader.block(block, eye.parameters);
    eye.check(reader, block);
    reader.require(block, eye.parameters[6]);
    if (!eye.parameters[6].given() || !eye.parameters[0].given() || !eye.parameters[1].given()) block.spoiled = true;
    if (path->keys.size() >= limits.keys) {
        reader.faults.add(word, "more than " + std::to_string(limits.keys) + " keys");
        reader.faults.check();
    }
    path->keys.push_back({eye.extra, eye.position, eye.look_at, eye.fov(), eye.up()});
    key_blocks.push_back(block);
}

void CameraBlocks::flythrough(std::string_view word) {
    const bool first = reader.once(path_at, word);
    const auto earlier = path;
    const auto earlier_blocks = key_blocks;
    path.emplace();
    key_blocks.clear();
    Block block{word};
    std::array parameters{Parameter{"duration", &path->duration, positive}, Parameter{"loop", &path->loop}};
    constexpr std::array other{"key"};
    reader.block(block, parameters, other, [&](std::string_view inner) {
        if (inner == "key") key(inner);
        return inner == "key";
    });
    for (const Block& key_block : key_blocks) block.spoiled |= key_block.spoiled;
    reader.require(block, parameters[0]);
    if (!block.spoiled && path->keys.size() < 2) reader.faults.add(word, "a flythrough needs at least 2 keys");
    if (!block.spoiled && parameters[0].given()) check_times(block, parameters[0]);
    if (!first) path = earlier, key_blocks = earlier_blocks;
}

void CameraBlocks::check_times(const Block& block, const Parameter& duration) {
    const std::vector<Key>& keys = path->keys;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (i > 0 && !(keys[i].time > keys[i - 1].time))
            reader.faults.add(key_blocks[i].name, "the times of keys must rise; the key before, in " +
                                                      reader.faults.line(key_blocks[i - 1].name) +
                                                      ", has no earlier one");
        else if (keys[i].time > path->duration)
            reader.faults.add(key_blocks[i].name, "the time of this key is after the end, by 'duration' of " +
                                                      reader.faults.line(duration.at));
    }
    (void)block;
}

void CameraBlocks::check(std::string_view end_of_text) {
    if (!camera_at.data()) reader.faults.add(end_of_text, "no camera: a scene needs one 'camera { ... }'");
    if (!camera_good || !path || reader.faults.any()) return;
    Camera before;
    for (std::size_t i = 0; i < path->keys.size(); ++i) {
        const Key& key = path->keys[i];
        const Camera camera{
            key.position, key.look_at, key.up.value_or(the_camera.up), key.fov.value_or(the_camera.fov), {}};
        if (const char* const fault = degenerate(camera))
            reader.faults.add(key_blocks[i].name, std::string("the camera sees nothing at this key: ") + fault);
    }
}

}  // namespace strahl
