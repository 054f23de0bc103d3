// Places the handles of the body or the light that is chosen, finds the one under the pointer, and applies what the
// user drags by it.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "scene/scene.h"
#include "show/session/body_editor.h"
#include "show/session/drag.h"
#include "show/session/handles.h"
#include "show/session/session.h"
#include "show/window/overlay.h"
#include "show/work/pace.h"

namespace strahl {

class BodyHandles {
  public:
    /// `bodies` knows what is chosen and holds the text that drags change.
    BodyHandles(BodyEditor& bodies, Session& session, Pace& pace) : bodies(bodies), session(session), pace(pace) {}

    /// Chooses what the handles do: this, or what comes next. Returns what to tell the user.
    const char* change_mode(std::optional<HandleMode> newer = {});
    HandleMode handle_mode() const { return mode; }
    /// Places the handles in a view of the scene at its moment. `scale` is that of the window: 1 at a usual pixel
    /// density.
    void place(const Scene& seen, const View& view, double scale);
    void hide() { handles.reset(); }
    /// Is a handle at this point of the picture, or is one held?
    bool points_at(const glm::dvec2& point, double reach);

    /// Begins to drag the handle under the pointer, which is at this point. Returns why it cannot be dragged, or "".
    std::string hold(const glm::dvec2& point);
    /// Goes on to another point.
    void pull(const glm::dvec2& to, Snap snap);
    /// Changes the text by the drag up to the last point; those that came while it was read are skipped. `seen` is the
    /// scene in the picture, and `hidden` are bodies that it lacks. Returns true if the text changed.
    bool change_text(const Scene& seen, const std::set<int>& hidden);
    void let_go() { drag.reset(); }
    bool held() const { return drag.has_value(); }

    /// Adds what is to be drawn, in pixels of the picture.
    void draw(Overlay::Tools& tools) const;

  private:
    const Light* light_chosen() const;
    const std::array<DVec3, 3>& own_axes();
    void find_pointed();

    BodyEditor& bodies;
    Session& session;
    Pace& pace;
    HandleMode mode = HandleMode::move;
    std::optional<Handles> handles;

    /// The axes of a body, along which it is scaled.
    struct OwnAxes {
        std::shared_ptr<const Scene> scene;
        int body = -1;
        std::array<DVec3, 3> axes{};
    };
    OwnAxes own;

    std::optional<Handle> pointed;  // the one under the pointer
    glm::dvec2 pointer{-1};
    double pointer_reach = 0;

    struct DragPoint {
        glm::dvec2 place{0};
        Snap snap = Snap::none;
    };
    std::optional<Drag> drag;
    std::optional<DragPoint> dragged_to;  // not yet applied
    bool dragged = false;                 // this drag has changed the text
    DVec3 clicked{0};                     // the point that was clicked, when the drag began
};

}  // namespace strahl
