// A drag of a handle, and other ways to place bodies: the text that they make of the one in which they began.
#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "num/ray.h"
#include "scene/scene.h"
#include "show/session/body_editor.h"
#include "show/session/handles.h"
#include "text/body_text.h"
#include "text/place_body.h"

namespace strahl {

/// Bodies as they stand in a text, to be placed elsewhere together, again and again.
class PlacedBodies {
  public:
    /// Finds bodies by their numbers; nothing if the text does not have them all. `scene` is that of the text.
    static std::optional<PlacedBodies> find(const std::string& text, const Scene& scene, std::span<const int> numbers);
    /// Returns the text in which all are placed so; see PlacedBody::text.
    std::string text(const Placing& placing, int decimals) const;

  private:
    std::string original;
    std::vector<PlacedBody> bodies;
};

/// Returns the box around all of these bodies of a scene.
Box bounds_of(const Scene& scene, std::span<const int> bodies);

/// Returns how bodies move so that they stand on the surface that a ray meets first, with the middle of their side
/// there at that point. They stand against the surface; with `up` they stand upright, this way. Nothing if the ray
/// meets none, or if they have no end. The ray does not meet bodies with the numbers of `passed`.
std::optional<DVec3> way_onto(const Scene& scene, std::span<const Primitive> bodies, const std::set<int>& passed,
                              const Ray<double>& ray, const std::optional<DVec3>& up = {});

class Drag {
  public:
    /// Begins a drag of what is chosen, from a point of the picture. Returns nothing if it cannot be moved in the
    /// text; then `why` says why. `scene` is that of the text.
    static std::optional<Drag> begin(const BodyEditor& editor, const Scene& scene, const Handles& handles,
                                     Handle handle, const glm::dvec2& from, std::string& why);

    /// Returns what a drag to this point does. `steps`: see Handles::drag.
    Placing placing(const glm::dvec2& to, bool steps) const { return handles.drag(held, from, to, steps); }
    /// Returns what a drag does if bodies that are moved stand on others: on what is seen at the point, or, along an
    /// axis, on what is below them. `seen` is the scene in the picture, and `hidden` are bodies that it lacks.
    Placing placing_on_surface(const glm::dvec2& to, const Scene& seen, std::set<int> hidden) const;
    /// Returns the text that this makes. `steps` rounds angles to whole degrees.
    std::string text(const Placing& placing, bool steps) const;
    Handle handle() const { return held; }

  private:
    struct LightNumbers {
        std::string text;
        BodyValue value{};
        double least = 0, most = 90;  // degrees of a spotlight
    };
    using Dragged = std::variant<PlacedBodies, LightNumbers>;
    Drag(const Handles& handles, Handle handle, const glm::dvec2& from, Dragged what)
        : handles(handles), held(handle), from(from), what(std::move(what)) {}

    Handles handles;
    Handle held;
    glm::dvec2 from;
    Dragged what;
    std::vector<int> numbers;           // of the bodies
    std::vector<Primitive> primitives;  // as they were when the drag began
};

}  // namespace strahl
