// Which panels lie over the picture.
#pragma once
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "show/panels/add_panel.h"
#include "show/panels/body_panel.h"
#include "show/panels/outliner.h"
#include "show/panels/panel_room.h"
#include "show/panels/toolbar.h"
#include "show/session/session.h"
#include "show/timeline/timeline.h"
#include "show/work/pace.h"

namespace strahl {

class Panels {
  public:
    /// `no_text`: no panel is shown until the user asks for one. `gallery`: that is shown.
    Panels(Pace& pace, bool no_text, bool gallery) : quiet(no_text), gallery(gallery), pace(pace) {}

    /// Shows or hides what the action names: one of `panel_actions`, the help, the toolbar, or all text
    /// (Action::quiet); or the gallery, which covers the window. A panel that is open but has no room is shown in place
    /// of others. Returns false if the action names none of these.
    bool toggle(Action action);
    /// Finds out which panels have room. To be called before they are drawn.
    void arrange(const BodyEditor& editor);
    /// Shows the panel of what is chosen, or the timeline if it is open, in place of others if there is no room.
    void prefer_body() { chosen_before.reset(); }
    void prefer_timeline() {
        if (room.is_open(Panel::timeline)) room.open(Panel::timeline);
    }

    // These draw a panel, if it is shown, and return what the user did on it. Call them while ImGui makes a frame.

    /// Draws the timeline.
    /// `peaks` are those of the sound, `text_open` says whether the scene's text can be changed here, and `both`
    /// whether the flight is seen beside the view.
    TimelineInput draw_timeline(const Session& session, const std::vector<float>& peaks, bool text_open, bool both);
    /// Has the timeline remove the key that was clicked there last, if that was after the last call of forget_key().
    /// Returns false if there is none.
    bool delete_clicked_key();
    void forget_key() { timeline.forget_click(); }
    /// Has the panel of the body that is chosen stand on the other side, if it would cover the point clicked there.
    void keep_clear(double x) { clicked_x = x; }
    /// Draws the panel of the body that is chosen, if any. `file` is the name of the scene.
    BodyInput draw_body(const BodyEditor& editor, const std::string& file);
    /// Draws the list of what can be added. Returns what the user has clicked in it, or null.
    const NewBlock* draw_add();
    /// Draws the outline, see Outliner::draw.
    OutlinerInput draw_outline(const Session& session, const BodyEditor& editor, const std::set<int>& hidden,
                               const std::vector<Message>& notes);
    /// Draws the toolbar, unless the user has hidden it.
    std::optional<Command> draw_toolbar(const KeyMap& keys, ToolbarView view);
    bool timeline_shown() const { return shown(Panel::timeline); }
    bool info_shown() const { return shown(Panel::info) && !help; }
    /// Is the help shown? It covers the window.
    bool help_shown() const { return help && !quiet; }
    /// The words that the help is searched for. Adds a character to them, or, with 0, removes the last one.
    const std::string& sought() const { return typed; }
    void search(unsigned character);
    /// Does one of these panels cover this point of the window?
    bool cover(double x, double y) const {
        return gallery || asking || help_shown() || (toolbar_shown() && toolbar.area().has(x, y)) ||
               std::ranges::any_of(room.opened(),
                                   [&](Panel panel) { return shown(panel) && room.area(panel).has(x, y); });
    }
    /// The width in pixels that it takes at the right of the window.
    float reserved_right() const { return body_left() ? 0 : width(Panel::body); }
    /// The width in pixels that the outline or the panel of a body takes at the left, and the list beside it.
    float reserved_left() const { return beside_add() + width(Panel::add); }
    /// The height in pixels of the toolbar at the top.
    float reserved_top() const { return toolbar_open && !quiet && !gallery && !help ? toolbar.height() : 0; }
    /// The height in pixels of what lies at the bottom of the window.
    float reserved() const { return timeline_shown() ? timeline.height() : 0; }
    /// Is there a panel that takes input, even if all text is hidden?
    bool take_input() const { return gallery || asking || !room.opened().empty() || toolbar_shown(); }

    bool help = false, quiet, gallery;
    bool asking = false;         // a question covers the window, see Leaving
    bool toolbar_rests = false;  // it is left out, but keeps its place: drawing it would take time from pictures

    /// Closes a list or a menu that a panel has opened; or one of the panels. False if there is none.
    bool step_back_from_popup();
    bool step_back();

  private:
    bool shown(Panel panel) const { return room.shown(panel) && !quiet; }
    bool body_shown() const { return shown(Panel::body) && !help; }  // the help needs the room
    bool toolbar_shown() const { return toolbar_open && !quiet && !gallery && !help && !toolbar_rests; }
    /// The width that a panel takes, with the space beside it; 0 if it is not shown.
    float width(Panel panel) const {
        return (panel == Panel::body ? body_shown() : shown(panel)) ? room.area(panel).wide : 0;
    }
    float beside_add() const { return width(body_left() ? Panel::body : Panel::outline); }
    bool body_left() const { return body_shown() && clicked_at_right && !shown(Panel::outline); }
    Margins margins() const { return {0, reserved_top(), reserved()}; }

    Pace& pace;
    std::string typed;
    PanelRoom room;
    Timeline timeline;
    std::optional<double> clicked_x;  // where a body was clicked since the last picture
    bool clicked_at_right = false;
    std::optional<std::tuple<int, bool, std::optional<TopBlock>>> chosen_before;  // of what the panel was last shown
    BodyPanel body;
    Outliner outliner;
    bool toolbar_open = !toolbar_hidden();
    Toolbar toolbar;
};

}  // namespace strahl
