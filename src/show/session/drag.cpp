#include "show/session/drag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>

#include "num/vec_math.h"
#include "scene/overlap.h"
#include "scene/ray_hits.h"
#include "text/light_text.h"

namespace strahl {

std::optional<PlacedBodies> PlacedBodies::find(const std::string& text, const Scene& scene,
                                               std::span<const int> numbers) {
    PlacedBodies found;
    found.original = text;
    for (const int number : numbers) {
        auto body = PlacedBody::find(text, scene, number);
        if (!body) return std::nullopt;
        found.bodies.push_back(*std::move(body));
    }
    return found;
}

std::string PlacedBodies::text(const Placing& placing, int decimals) const {
    std::vector<TextChange> all;
    for (const PlacedBody& body : bodies) std::ranges::move(body.changes(placing, decimals), std::back_inserter(all));
    return with_changes(original, std::move(all));
}

Box bounds_of(const Scene& scene, std::span<const int> bodies) {
    Box box;
    for (const int body : bodies) box.add(world_bounds(scene.primitives[std::size_t(body)]));
    return box;
}

std::optional<DVec3> way_onto(const Scene& scene, std::span<const Primitive> bodies, const std::set<int>& passed,
                              const Ray<double>& ray, const std::optional<DVec3>& up) {
    const std::vector<BodyHit> met = bodies_along(scene, ray);
    const auto surface = std::ranges::find_if(met, [&](const BodyHit& hit) { return !passed.contains(hit.body); });
    if (surface == met.end()) return std::nullopt;
    const double side = dot_product(surface->hit.normal, ray.direction) > 0 ? -1 : 1;
    const DVec3 w = up ? *up : side * surface->hit.normal;
    const DVec3 u = normalize(cross_product(w, std::abs(w.x) < .9 ? DVec3(1, 0, 0) : DVec3(0, 1, 0)));
    const DVec3 v = cross_product(w, u), point = ray.origin + surface->hit.t * ray.direction;
    // The bodies' box in a world with these axes: its lowest side is the one to stand on.
    const glm::dmat4 turn = glm::transpose(glm::dmat4({u, 0}, {v, 0}, {w, 0}, {0, 0, 0, 1}));
    Box box;
    for (const Primitive& body : bodies) box.add(transformed_bounds(body, turn));
    if (!box.finite()) return std::nullopt;
    const DVec3 foot(box.centre().x, box.centre().y, box.low.z);
    return point - (foot.x * u + foot.y * v + foot.z * w);
}

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
    std::vector<int> numbers = editor.bodies();
    auto bodies = PlacedBodies::find(text, scene, numbers);
    if (!bodies) return why = "the text does not say where this body is", std::nullopt;
    Drag drag(handles, handle, from, *std::move(bodies));
    for (const int number : numbers) drag.primitives.push_back(scene.primitives[std::size_t(number)]);
    drag.numbers = std::move(numbers);
    return drag;
}

Placing Drag::placing_on_surface(const glm::dvec2& to, const Scene& seen, std::set<int> hidden) const {
    const Placing free = placing(to, false);
    const auto* const move = std::get_if<MoveBy>(&free);
    if (!move || primitives.empty()) return free;
    hidden.insert(numbers.begin(), numbers.end());
    if (held == Handle::all) {
        const auto way = way_onto(seen, primitives, hidden, handles.ray(to));
        return way ? MoveBy{*way} : free;
    }
    Box box;
    for (const Primitive& body : primitives) box.add(world_bounds(body));
    if (!box.finite()) return free;
    // From the top of the bodies downwards, in the direction that is down in the scene's pictures.
    const DVec3 down = normalize(seen.camera.up), size = box.size();
    const double half = (std::abs(down.x) * size.x + std::abs(down.y) * size.y + std::abs(down.z) * size.z) / 2;
    const Ray<double> ray{box.centre() + move->by - half * down, down, -1};
    const auto way = way_onto(seen, primitives, hidden, ray, DVec3(0) - down);
    return way ? MoveBy{*way} : free;
}

std::string Drag::text(const Placing& placing, bool steps) const {
    if (const auto* const bodies = std::get_if<PlacedBodies>(&what)) return bodies->text(placing, handles.decimals());
    const auto& [text, value, least, most] = std::get<LightNumbers>(what);
    if (const auto* const scale = std::get_if<ScaleBy>(&placing)) {
        constexpr double degree = std::numbers::pi / 180;
        const double before = value.numbers[0], opened = scale->factors.x * std::tan(std::min(before, 80.) * degree);
        const double angle = std::clamp(rounded(std::atan(opened) / degree, before, steps ? 0 : 1), least, most);
        return value.slices.empty() ? with_own_value(text, value, {&angle, 1}) : with_numbers(text, value, {&angle, 1});
    }
    const DVec3 before(value.numbers[0], value.numbers[1], value.numbers[2]);
    DVec3 after = before;
    if (const auto* const move = std::get_if<MoveBy>(&placing)) after += move->by;
    if (const auto* const turn = std::get_if<TurnBy>(&placing))
        after = value.name == "direction" ? turned(before, *turn) : turn->about + turned(before - turn->about, *turn);
    for (int i = 0; i < 3; ++i) after[i] = std::clamp(after[i], value.range.low, value.range.high);
    after = rounded(after, before, value.name == "direction" ? 3 : handles.decimals());
    return with_numbers(text, value, std::array{after.x, after.y, after.z});
}

}  // namespace strahl
