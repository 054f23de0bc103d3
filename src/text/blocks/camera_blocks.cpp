#include "text/blocks/camera_blocks.h"

#include <algorithm>
#include <string>
#include <utility>

#include "num/vec_math.h"
#include "text/blocks/blocks.h"

namespace strahl {
namespace {

/// Returns why a camera is degenerate, by the word that gives its direction up: `sky` or `up`; empty if it is not.
std::string fault_of(const Camera& camera, bool by_sky) {
    const char* const fault = degenerate(camera);
    const std::string why = fault ? fault : "";
    return by_sky && why.starts_with("up ") ? "sky" + why.substr(2) : why;
}

}  // namespace

void CameraBlocks::camera(std::string_view word) {
    reader.once(camera_at, word);
    Block block{word, false, false, &follows};
    CameraText text;
    EyeText& eye = text.eye;
    auto parameters = camera_parameters(text);
    reader.block(block, parameters);
    Projection projection = Projection::perspective;
    const Parameter* chosen = nullptr;
    for (Parameter& parameter : parameters) {
        const auto at = std::ranges::find(projection_words, parameter.name);
        if (at == projection_words.end() || !parameter.given()) continue;
        if (chosen) {
            reader.repeats(block, parameter, *chosen);
            continue;
        }
        chosen = &parameter, projection = static_cast<Projection>(at - projection_words.begin());
        if (!angular(projection)) continue;
        // The number of such a projection takes the place of `fov` and `angle`.
        Parameter &fov = *std::ranges::find(parameters, "fov", &Parameter::name),
                  &angle = *std::ranges::find(parameters, "angle", &Parameter::name);
        if (fov.given() || angle.given())
            reader.repeats(block, parameter, fov.given() ? fov : angle);
        else
            angle.at = parameter.at, eye.angle = *std::get<std::optional<double>*>(parameter.value);
    }
    reader.require(block, parameters);
    if (!block.good()) return;
    the_camera = {eye.position,
                  eye.look_at,
                  *eye.down(),
                  *eye.half_angle(),
                  text.aspectratio,
                  projection,
                  text.aperture.value_or(0),
                  text.focus,
                  text.focus_on,
                  text.blades,
                  text.shutter.value_or(text.shutter_share.value_or(0)),
                  text.shutter_share.has_value(),
                  text.side_by_side ? Stereo::side_by_side
                  : text.top_bottom ? Stereo::top_bottom
                                    : Stereo::none,
                  text.side_by_side.value_or(text.top_bottom.value_or(0)),
                  text.convergence};
    by_sky = eye.sky.has_value();
    const std::string fault = fault_of(the_camera, by_sky);
    if (!fault.empty()) reader.diagnostics.add(word, "invalid camera: " + fault);
    camera_good = fault.empty();
    const auto given = [&](std::string_view name) -> const Parameter* {
        const Parameter& parameter = *std::ranges::find(parameters, name, &Parameter::name);
        return parameter.given() ? &parameter : nullptr;
    };
    const Parameter* const lens = given("aperture");
    for (const char* const name : {"focus", "focus_on", "blades"})
        if (const Parameter* const other = given(name); other && !lens)
            reader.diagnostics.add(
                other->at, std::string("'") + name + "' changes nothing without 'aperture', the radius of the lens");
    if (lens && projection > Projection::orthographic)
        reader.diagnostics.add(lens->at, "only perspective and orthographic cameras have a lens");
    const Parameter* const beside = given(stereo_words[1]);
    const Parameter* const stereo = beside ? beside : given(stereo_words[2]);
    if (stereo && projection == Projection::orthographic)
        reader.diagnostics.add(stereo->at, "parallel rays show the same to both eyes");
    if (const Parameter* const convergence = given("convergence"); convergence && !stereo)
        reader.diagnostics.add(convergence->at, "'convergence' changes nothing without 'side_by_side' or 'top_bottom'");
    else if (convergence && projection != Projection::perspective)
        reader.diagnostics.add(convergence->at, "only the eyes of perspective cameras can converge");
    if (const Parameter* const point = given("focus_on");
        point && camera_good && !(dot_product(eye.look_at - eye.position, *text.focus_on - eye.position) > 0))
        reader.diagnostics.add(point->at, "this point is not before the camera, so nothing could be sharp");
    for (Follow& follow : follows) {
        if (follow.parameter == "shutter_share") follow.parameter = "shutter";
        if (follow.parameter == stereo_words[1] || follow.parameter == stereo_words[2]) follow.parameter = "eyes";
        if (follow.parameter == "sky") follow.parameter = "up", follow.factor = -1;
        if (follow.parameter == "angle" ||
            std::ranges::find(projection_words, follow.parameter) != projection_words.end())
            follow.parameter = "fov", follow.factor = .5, follow.low /= 2, follow.high /= 2;
    }
    sort(follows);
}

void CameraBlocks::key(std::string_view word, Flythrough& read_path, std::vector<KeyWords>& words, Block& outer) {
    reader.limit(read_path.keys.size(), limits.keys, word, "keys");
    Block block{word};
    TimeText when;
    EyeText eye;
    double ease = 0;
    auto parameters = key_parameters(when, eye, ease);
    reader.block(block, parameters);
    reader.require(block, parameters);
    reader.set_time(when.time, when.beat, parameters[1].at, block);
    outer.absorb(block);
    read_path.keys.push_back({when.time, eye.position, eye.look_at, eye.half_angle(), eye.down(), ease});
    words.push_back({word, parameters[when.beat ? 1 : 0].at, {}, eye.up.has_value(), eye.sky.has_value()});
}

void CameraBlocks::flythrough(std::string_view word) {
    reader.once(path_at, word);
    Flythrough read_path;
    std::vector<KeyWords> words;
    Block block{word};
    auto parameters = flythrough_parameters(read_path);
    constexpr std::array<std::string_view, 1> other{"key"};
    reader.block(
        block, parameters, other, [] {},
        [&](std::string_view inner) {
            if (inner != "key") return false;
            key(inner, read_path, words, block);
            return true;
        });
    const bool enough = read_path.keys.size() >= 2;
    reader.require(block, parameters, {{enough, "keys: a path needs at least 2"}});
    if (!block.good()) return;
    check_times(read_path, words, parameters[0].at);
    path = std::move(read_path);
    key_words = std::move(words);
}

void CameraBlocks::check_times(const Flythrough& read_path, std::span<const KeyWords> words,
                               std::string_view duration) {
    const std::vector<Keyframe>& keys = read_path.keys;
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (i > 0 && !(keys[i].time > keys[i - 1].time))
            require_rising(reader.diagnostics, keys[i - 1].time, keys[i].time, words[i - 1].time, words[i].time);
        else if (keys[i].time > read_path.duration)
            reader.diagnostics.add(words[i].time,
                                   "this is after the end, set by 'duration' in " + reader.diagnostics.line(duration));
    // A path that loops is back at its first key when the duration is over.
    Keyframe again = keys.front();
    again.time += read_path.duration;
    if (read_path.loop && keys.back().time == again.time && keys.back() != again)
        reader.diagnostics.add(words.back().time,
                               "at this time the loop is back at its first key: make this key equal to that in " +
                                   reader.diagnostics.line(words[0].key) + ", or 'duration' longer");
}

void CameraBlocks::check(std::string_view end_of_text) {
    if (!camera_at.data()) reader.diagnostics.add(end_of_text, "no camera: a scene needs one 'camera { ... }'");
    if (!camera_good || !path) return;
    for (std::size_t i = 0; i < path->keys.size(); ++i)
        if (const std::string fault =
                fault_of(camera_of(path->keys[i], the_camera), key_words[i].sky || (by_sky && !key_words[i].up));
            !fault.empty())
            reader.diagnostics.add(key_words[i].key, "invalid camera at this key: " + fault);
}

}  // namespace strahl
