#include "show/body_handles.h"

#include <utility>

#include "num/vec_math.h"
#include "scene/overlap.h"

namespace strahl {
namespace {

constexpr double handle_pixels = 80;  // how far handles reach

constexpr std::array<DVec3, 3> world_axes{DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, 1)};

}  // namespace

const char* BodyHandles::change_mode() {
    const Light* const light = light_chosen();
    if (light && !light->spot)
        return light->direction ? "handles of parallel light turn it" : "handles of this light only move it";
    mode = mode == HandleMode::scale ? HandleMode::move : static_cast<HandleMode>(static_cast<int>(mode) + 1);
    if (light && mode == HandleMode::scale) return "circles open and close the cone of light";
    return mode == HandleMode::move   ? "handles move; with Ctrl by round distances"
           : mode == HandleMode::turn ? "handles turn; with Ctrl by 15 degrees"
                                      : "handles scale; with Ctrl by tenths";
}

void BodyHandles::place(const Scene& seen, const View& view, double scale) {
    DVec3 centre;
    std::array<DVec3, 3> axes = world_axes;
    const Light* const light = light_chosen();
    if (light) {
        centre = light->direction ? view.camera.look_at : position_of(seen, *bodies.light());
    } else {
        const Box box = world_bounds(seen.primitives[std::size_t(bodies.number())]);
        centre = box.finite() ? box.centre() : bodies.choice()->point;
        if (mode == HandleMode::scale) axes = own_axes();
    }
    if (light && light->spot && mode == HandleMode::scale) {
        const Light& now = seen.lights[std::size_t(bodies.number())];
        handles.emplace(now.position, *now.spot, view);
    } else {
        const HandleMode shown = !light || light->spot ? mode : light->direction ? HandleMode::turn : HandleMode::move;
        handles.emplace(shown, centre, axes, handle_pixels * scale, view);
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

void BodyHandles::pull(const glm::dvec2& to, bool steps) {
    pointer = to;
    if (drag) dragged_to = DragPoint{to, steps};
}

bool BodyHandles::change_text() {
    const auto to = std::exchange(dragged_to, std::nullopt);
    if (!drag || !to) return false;
    const std::string text = drag->text(to->place, to->steps);
    if (text == bodies.edited.text()) return false;
    const char* const what = mode == HandleMode::move ? " moved" : mode == HandleMode::turn ? " turned" : " scaled";
    bodies.edited.change(text, {session.edits, bodies.name() + what, std::exchange(dragged, true)});
    if (bodies.choice()) bodies.move_point(clicked + drag->moved(to->place, to->steps));
    return true;
}

void BodyHandles::draw(Overlay::Tools& tools) const {
    if (handles) tools.handles = handles->lines();
    tools.pointed = pointed;
}

}  // namespace strahl
