#include "text/light_text.h"

#include <variant>
#include <vector>

#include "files/words.h"
#include "text/blocks/blocks.h"
#include "text/text_items.h"

namespace strahl {
namespace {

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
        } else if (const auto* const usual = std::get_if<double*>(&parameter.value);
                   usual && parameter.otherwise.empty() && !block.end.empty()) {
            value.numbers = {**usual}, value.source = no_source;
            value.own_at = std::size_t(block.end.data() - text.data());
            value.before = " " + std::string(parameter.name) + " ", value.after = " ";
        }
        if (!value.numbers.empty()) values.push_back(std::move(value));
    }
}

}  // namespace

BodyText light_text(const std::string& text, const Scene& scene, int light) {
    const Light& own = scene.lights[std::size_t(light)];
    BodyText result;
    result.kind = own.direction ? "parallel light" : own.area ? "rectangular light" : own.spot ? "spotlight" : "light";
    const TextItem item = item_of_light(text, light);
    if (item.word.empty()) {
        const auto add = [&](const char* name, const DVec3& v, bool color) {
            result.values.push_back(
                {.name = name, .help = "", .color = color, .numbers = {v.x, v.y, v.z}, .fixed = "from the file"});
        };
        add("position", own.position, false), add("color", own.color, true);
        return result;
    }
    result.at = std::size_t(item.word.data() - text.data());
    result.line = static_cast<int>(line_number(text, result.at));
    Light usual;
    add_values(text, item, light_parameters(usual), "", result.values);
    if (const TextItem* const spot = item.item("spot")) {
        Spot usual_spot;
        add_values(text, *spot, spot_parameters(usual_spot), " of spot", result.values);
    }
    return result;
}

}  // namespace strahl
