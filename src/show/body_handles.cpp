#include "show/body_handles.h"

#include <utility>

#include "num/vec_math.h"

namespace strahl {
namespace {

constexpr double handle_pixels = 80;  // how far handles reach

constexpr std::array<DVec3, 3> world_axes{DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)};

}  // namespace

const char* BodyHandles::change_mode(std::optional<HandleMode> newer) {
    const Light* const light = light_chosen();
    if (light && !light->spot)
        return light->direction ? "handles of parallel light turn it" : "handles of this light only move it";
    const auto next =
        mode == HandleMode::scale ? HandleMode::move : static_cast<HandleMode>(static_cast<int>(mode) + 1);
    mode = newer.value_or(next);
    if (light && mode == HandleMode::scale) return "circles open and close the cone of light";
    return mode == HandleMode::move   ? "handles move; with Ctrl on a grid, with Shift on what is below"
           : mode == HandleMode::turn ? "handles turn; with Ctrl by 15 degrees"
                                      : "handles scale; with Ctrl by tenths";
}

void BodyHandles::place(const Scene& seen, const View& view, double scale) {
    DVec3 centre;
    std::array<DVec3, 3> axes = world_axes;
    bool several = false;  // bodies, whose own axes differ
    const Light* const light = light_chosen();
    if (light) {
        centre = light->direction ? view.camera.look_at : position_of(seen, *bodies.light());
    } else {
        const std::vector<int> all = bodies.bodies();
        const Box box = bounds_of(seen, all);
        centre = box.finite() ? box.centre() : bodies.choice()->point;
        several = all.size() > 1;
        if (mode == HandleMode::scale && !several) axes = own_axes();
    }
    if (light && light->spot && mode == HandleMode::scale) {
        const Light& now = seen.lights[std::size_t(bodies.number())];
        handles.emplace(now.position, *now.spot, view);
    } else {
        const HandleMode shown = !light || light->spot ? mode : light->direction ? HandleMode::turn : HandleMode::move;
        handles.emplace(shown, centre, axes, handle_pixels * scale, view, several);
    }
    find_pointed();
}

/// Returns the light chosen, or null.
const Light* BodyHandles::light_chosen() const {
    return bodies.light() ? &session.scene->lights[std::size_t(bodies.light()->light)] : nullptr;
}

/// Returns the axes of the body chosen, along which it is scaled.
const std::array<DVec3, 3>& BodyHandles::own_axes() {
    const int number = bodies.number();
    if (own.scene != session.scene || own.body != number) {
        const auto body = PlacedBody::find(bodies.edited.text(), *session.scene, number);
        own = {session.scene, number, body ? body->axes() : world_axes};
    }
    return own.axes;
}

bool BodyHandles::points_at(const glm::dvec2& point, double reach) {
    pointer = point, pointer_reach = reach;
    find_pointed();
    return pointed.has_value();
}

/// Finds the handle under the pointer, which may have come there by itself.
void BodyHandles::find_pointed() {
    const auto at = drag ? std::optional(drag->handle()) : handles ? handles->at(pointer, pointer_reach) : std::nullopt;
    if (at != std::exchange(pointed, at)) pace.redraw();
}

std::string BodyHandles::hold(const glm::dvec2& point) {
    std::string why;
    drag = Drag::begin(bodies, *session.scene, *handles, *pointed, point, why);
    dragged_to.reset(), dragged = false;
    if (bodies.choice()) clicked = bodies.choice()->point;
    return why;
}

void BodyHandles::pull(const glm::dvec2& to, Snap snap) {
    pointer = to;
    if (drag) dragged_to = DragPoint{to, snap};
}

bool BodyHandles::change_text(const Scene& seen, const std::set<int>& hidden) {
    const auto to = std::exchange(dragged_to, std::nullopt);
    if (!drag || !to) return false;
    const bool steps = to->snap == Snap::grid;
    const Placing placing =
        to->snap == Snap::surface ? drag->placing_on_surface(to->place, seen, hidden) : drag->placing(to->place, steps);
    const std::string text = drag->text(placing, steps);
    if (text == bodies.edited.text()) return false;
    const char* const what = mode == HandleMode::move ? " moved" : mode == HandleMode::turn ? " turned" : " scaled";
    bodies.edited.change(text, {session.edits, bodies.names() + what, std::exchange(dragged, true)});
    const auto* const move = std::get_if<MoveBy>(&placing);
    if (bodies.choice()) bodies.move_point(clicked + (move ? move->by : DVec3(0)));
    return true;
}

void BodyHandles::draw(Overlay::Tools& tools) const {
    if (handles) tools.handles = handles->lines();
    tools.pointed = pointed;
}

}  // namespace strahl
