// A drag of a handle: the text that it makes of the one in which it began.
#pragma once
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <variant>

#include "scene/scene.h"
#include "show/session/body_editor.h"
#include "show/session/handles.h"
#include "text/body_text.h"
#include "text/place_body.h"

namespace strahl {

class Drag {
  public:
    /// Begins a drag of what is chosen, from a point of the picture. Returns nothing if it cannot be moved in the
    /// text; then `why` says why. `scene` is that of the text.
    static std::optional<Drag> begin(const BodyEditor& editor, const Scene& scene, const Handles& handles,
                                     Handle handle, const glm::dvec2& from, std::string& why);

    /// Returns the text for a drag to this point. `steps`: see Handles::drag.
    std::string text(const glm::dvec2& to, bool steps) const;
    /// Returns by how much what is dragged moves as a whole.
    DVec3 moved(const glm::dvec2& to, bool steps) const;
    Handle handle() const { return held; }

  private:
    struct LightNumbers {
        std::string text;
        BodyValue value{};
        double least = 0, most = 90;  // degrees of a spotlight
    };
    using Dragged = std::variant<PlacedBody, LightNumbers>;
    Drag(const Handles& handles, Handle handle, const glm::dvec2& from, Dragged what)
        : handles(handles), held(handle), from(from), what(std::move(what)) {}

    Handles handles;
    Handle held;
    glm::dvec2 from;
    Dragged what;
};

}  // namespace strahl
