#include "show/session/drag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "text/light_text.h"

namespace strahl {

std::optional<Drag> Drag::begin(const BodyEditor& editor, const Scene& scene, const Handles& handles, Handle handle,
                                const glm::dvec2& from, std::string& why) {
    const std::string& text = editor.edited.text();
    if (const auto& point = editor.light()) {
        const auto& values = editor.body().values;
        const Light& light = scene.lights[std::size_t(point->light)];
        LightNumbers what{text};
        std::string_view name = "direction";
        if (handles.handle_mode() == HandleMode::scale) {
            const bool whole = handle == Handle::all;
            name = whole ? spot_falloff : spot_radius;
            (whole ? what.least : what.most) = whole ? light.spot->radius : light.spot->falloff;
        } else if (!light.direction) {
            // Moves the chosen end of a spotlight, its place or its target, or turns the other end about it.
            name = point->target != (handles.handle_mode() == HandleMode::turn) ? spot_target : "position";
        }
        const auto value = std::ranges::find(values, name, &BodyValue::name);
        why = value == values.end()   ? "the text does not say where this light is"
              : !value->fixed.empty() ? "this light " + value->fixed
              : light.motion          ? "this light has a motion, which is changed in the text"
                                      : "";
        if (!why.empty()) return std::nullopt;
        what.value = *value;
        return Drag(handles, handle, from, std::move(what));
    }
    auto body = PlacedBody::find(text, scene, editor.choice()->at.body);
    if (!body) return why = "the text does not say where this body is", std::nullopt;
    return Drag(handles, handle, from, *std::move(body));
}

std::string Drag::text(const glm::dvec2& to, bool steps) const {
    const Placing placing = handles.drag(held, from, to, steps);
    if (const auto* const body = std::get_if<PlacedBody>(&what)) return body->text(placing, handles.decimals());
    const auto& [text, value, least, most] = std::get<LightNumbers>(what);
    if (const auto* const scale = std::get_if<ScaleBy>(&placing)) {
        constexpr double degree = std::numbers::pi / 180;
        const double before = value.numbers[0], opened = scale->factors.x * std::tan(std::min(before, 80.) * degree);
        const double angle = std::clamp(rounded(std::atan(opened) / degree, before, steps ? 0 : 1), least, most);
        return value.slices.empty() ? with_own_value(text, value, {&angle, 1}) : with_numbers(text, value, {&angle, 1});
    }
    const DVec3 before(value.numbers[0], value.numbers[1], value.numbers[2]);
    DVec3 after = before + moved(to, steps);
    if (const auto* const turn = std::get_if<TurnBy>(&placing))
        after = value.name == "direction" ? turned(before, *turn) : turn->about + turned(before - turn->about, *turn);
    for (int i = 0; i < 3; ++i) after[i] = std::clamp(after[i], value.range.low, value.range.high);
    after = rounded(after, before, value.name == "direction" ? 3 : handles.decimals());
    return with_numbers(text, value, std::array{after.x, after.y, after.z});
}

DVec3 Drag::moved(const glm::dvec2& to, bool steps) const {
    const Placing placing = handles.drag(held, from, to, steps);
    const auto* const move = std::get_if<MoveBy>(&placing);
    return move ? move->by : DVec3(0);
}

}  // namespace strahl
