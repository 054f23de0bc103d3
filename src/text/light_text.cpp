#include "text/light_text.h"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "files/words.h"
#include "text/blocks/blocks.h"
#include "text/text_changes.h"
#include "text/text_items.h"

namespace strahl {
namespace {

constexpr const char* from_file = "from the file";

/// Returns the number that a parameter has where the text does not give it, if it has one then.
std::optional<double> usual_number(const Parameter& parameter) {
    if (const auto* const number = std::get_if<std::optional<double>*>(&parameter.value)) return **number;
    const auto* const number = std::get_if<double*>(&parameter.value);
    return number && parameter.otherwise.empty() ? std::optional(**number) : std::nullopt;
}

/// Adds the numbers of the parameters that a block has or could have.
template <class Parameters>
void add_values(const std::string& text, const TextItem& block, const Parameters& parameters, const std::string& behind,
                std::vector<BodyValue>& values) {
    for (const Parameter& parameter : parameters) {
        BodyValue value{.name = std::string(parameter.name) + behind,
                        .help = parameter.help,
                        .range = parameter.range,
                        .color = parameter.name == "color",
                        .follows = !parameter.range.whole};
        const TextItem* const given = block.item(parameter.name);
        if (given) {
            for (const std::string_view number : given->numbers) {
                value.slices.push_back(slice_of(text, number));
                read_number(number, value.numbers.emplace_back());
            }
            take_tracks(value, text, *given);
        } else if (const auto usual = usual_number(parameter); usual && !block.end.empty()) {
            value.numbers = {*usual}, value.source = no_source;
            value.own_at = std::size_t(block.end.data() - text.data());
            value.before = " " + std::string(parameter.name) + " ", value.after = " ";
        }
        if (!value.numbers.empty()) values.push_back(std::move(value));
    }
}

/// A value that the text does not have.
BodyValue fixed_value(const char* name, std::vector<double> numbers, bool color, const char* why) {
    return {.name = name, .help = "", .color = color, .numbers = std::move(numbers), .fixed = why};
}
std::vector<double> numbers_of(const DVec3& v) { return {v.x, v.y, v.z}; }

/// Says where the block stands in the text.
void put_place(BodyText& result, const std::string& text, const TextItem& block) {
    result.at = slice_of(text, block.word).begin;
    result.line = static_cast<int>(line_number(text, result.at));
}

}  // namespace

BodyText light_text(const std::string& text, const Scene& scene, int light) {
    const Light& own = scene.lights[std::size_t(light)];
    BodyText result;
    result.kind = own.direction ? "parallel light" : own.area ? "rectangular light" : own.spot ? "spotlight" : "light";
    const TextItem item = item_of_light(text, light);
    if (item.word.empty()) {
        result.values = {fixed_value("position", numbers_of(own.position), false, from_file),
                         fixed_value("color", numbers_of(own.color), true, from_file)};
        return result;
    }
    put_place(result, text, item);
    Light usual;
    add_values(text, item, light_parameters(usual), "", result.values);
    if (const TextItem* const spot = item.item("spot")) {
        Spot usual_spot;
        add_values(text, *spot, spot_parameters(usual_spot), " of spot", result.values);
    }
    return result;
}

BodyText camera_values(const std::string& text, const Scene& scene) {
    const Camera& own = scene.camera;
    BodyText result;
    result.kind = word_of(own.projection);
    const TextItem block = item_of_block(text, "camera");
    if (block.word.empty()) {
        result.values = {fixed_value("position", numbers_of(own.position), false, from_file),
                         fixed_value("look_at", numbers_of(own.look_at), false, from_file),
                         fixed_value("angle", {2 * own.fov}, false, from_file)};
        return result;
    }
    put_place(result, text, block);
    CameraText usual;
    if (!own.shutter_in_frames) usual.shutter = 0;
    if (own.projection <= Projection::orthographic) usual.aperture = 0;
    if (block.item("aperture") && !own.focus_on) usual.focus = focal_distance(own);
    add_values(text, block, camera_parameters(usual), "", result.values);
    for (BodyValue& value : result.values) value.follows &= value.name != "aspectratio";
    return result;
}

BodyText background_values(const std::string& text, const Scene& scene) {
    BodyText result;
    result.kind = "of rays that hit nothing";
    const TextItem block = item_of_block(text, "background");
    Pigment usual{Color(0)};
    const Parameter parameter = background_parameters(usual)[0];
    BodyValue color = fixed_value("color", numbers_of(scene.background.color), true, from_file);
    color.help = parameter.help, color.range = parameter.range;
    if (!block.word.empty()) {
        put_place(result, text, block);
        const TextItem* const given = block.item(parameter.name);
        if (given && given->numbers.size() == 3)
            return add_values(text, block, std::array{parameter}, "", result.values), result;
        color.fixed = "a pattern";
    } else if (const TextItem camera = item_of_block(text, "camera"); !camera.end.empty()) {
        // A block of its own, in the line behind the camera's.
        color.fixed.clear(), color.source = no_source, color.follows = true;
        color.own_at = rest_of_line(text, slice_of(text, camera.end).end);
        color.before = "\nbackground { color ", color.after = " }";
    }
    result.values = {std::move(color)};
    return result;
}

}  // namespace strahl
