#include "show/session/drag.h"

#include <algorithm>
#include <array>
#include <utility>

#include "text/light_text.h"

namespace strahl {

std::optional<Drag> Drag::begin(const BodyEditor& editor, const Scene& scene, const Handles& handles, Handle handle,
                                const glm::dvec2& from, std::string& why) {
    const std::string& text = editor.edited.text();
    if (const auto& point = editor.light()) {
        const auto& values = editor.body().values;
        // Moves the chosen end of a spotlight, its place or its target, or turns the other end about it.
        const bool target = point->target != (handles.handle_mode() == HandleMode::turn);
        const auto value = std::ranges::find(values, target ? spot_target : "position", &BodyValue::name);
        why = value == values.end() || value->slices.size() != 3 ? "the text does not say where this light is"
              : !value->fixed.empty()                            ? "this light " + value->fixed
              : scene.lights[std::size_t(point->light)].motion ? "this light has a motion, which is changed in the text"
                                                               : "";
        if (!why.empty()) return std::nullopt;
        return Drag(handles, handle, from, LightNumbers{text, *value});
    }
    auto body = PlacedBody::find(text, scene, editor.choice()->at.body);
    if (!body) return why = "the text does not say where this body is", std::nullopt;
    return Drag(handles, handle, from, *std::move(body));
}

std::string Drag::text(const glm::dvec2& to, bool steps) const {
    const Placing placing = handles.drag(held, from, to, steps);
    if (const auto* const body = std::get_if<PlacedBody>(&what)) return body->text(placing, handles.decimals());
    const auto& [text, value] = std::get<LightNumbers>(what);
    const DVec3 before(value.numbers[0], value.numbers[1], value.numbers[2]);
    DVec3 after = before + moved(to, steps);
    if (const auto* const turn = std::get_if<TurnBy>(&placing))
        after = turn->about + turned(before - turn->about, *turn);
    for (int i = 0; i < 3; ++i) after[i] = std::clamp(after[i], value.range.low, value.range.high);
    after = rounded(after, before, handles.decimals());
    return with_numbers(text, value, std::array{after.x, after.y, after.z});
}

DVec3 Drag::moved(const glm::dvec2& to, bool steps) const {
    const Placing placing = handles.drag(held, from, to, steps);
    const auto* const move = std::get_if<MoveBy>(&placing);
    return move ? move->by : DVec3(0);
}

}  // namespace strahl
