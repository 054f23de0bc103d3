// Which panels lie over the picture.
#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "show/panels/add_panel.h"
#include "show/panels/body_panel.h"
#include "show/panels/outliner.h"
#include "show/panels/toolbar.h"
#include "show/session/session.h"
#include "show/timeline/timeline.h"
#include "show/work/pace.h"

namespace strahl {

class Panels {
  public:
    /// `no_text`: no panel is shown until the user asks for one. `gallery`: that is shown.
    Panels(Pace& pace, bool no_text, bool gallery) : quiet(no_text), gallery(gallery), pace(pace) {}

    /// Shows or hides what the action names: help, info, timeline, the list of what can be added, the outline, the
    /// toolbar, or all text (Action::quiet); or the gallery, which covers the window.
    void toggle(Action action);

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
    bool timeline_shown() const { return timeline_open && !quiet; }
    /// Is the help shown? It covers the window.
    bool help_shown() const { return help && !quiet; }
    /// The words that the help is searched for. Adds a character to them, or, with 0, removes the last one.
    const std::string& sought() const { return typed; }
    void search(unsigned character);
    /// Does one of these panels cover this point of the window?
    bool cover(double x, double y) const {
        return gallery || asking || help_shown() || (body_shown && body.area().has(x, y)) ||
               (add_shown() && add.area().has(x, y)) || (outline_shown() && outliner.area().has(x, y)) ||
               (toolbar_shown() && toolbar.area().has(x, y));
    }
    /// The width in pixels that it takes at the right of the window.
    float reserved_right() const { return body_shown && !body_left() ? body.width() : 0; }
    /// The width in pixels that the outline or the panel of a body takes at the left.
    float reserved_left() const { return outline_shown() ? outliner.width() : body_left() ? body.width() : 0; }
    /// The height in pixels of the toolbar at the top.
    float reserved_top() const { return toolbar_open && !quiet && !gallery && !help ? toolbar.height() : 0; }
    /// The height in pixels of what lies at the bottom of the window.
    float reserved() const { return timeline_shown() ? timeline.height() : 0; }
    /// Is there a panel that takes input, even if all text is hidden?
    bool take_input() const {
        return gallery || asking || timeline_open || body_shown || add_open || outline_open || toolbar_shown();
    }

    bool help = false, info = false, quiet, gallery;
    bool asking = false;         // a question covers the window, see Leaving
    bool toolbar_rests = false;  // it is left out, but keeps its place: drawing it would take time from pictures

    /// Closes a list or a menu that a panel has opened; or one of the panels. False if there is none.
    bool step_back_from_popup();
    bool step_back();

  private:
    bool& shown(Action action);
    bool add_shown() const { return add_open && !quiet; }
    bool outline_shown() const { return outline_open && !quiet; }
    bool toolbar_shown() const { return toolbar_open && !quiet && !gallery && !help && !toolbar_rests; }
    bool body_left() const { return body_shown && clicked_at_right && !outline_shown(); }
    Margins margins() const { return {0, reserved_top(), reserved()}; }

    Pace& pace;
    std::string typed;
    bool timeline_open = false;
    Timeline timeline;
    bool body_shown = false;
    std::optional<double> clicked_x;  // where a body was clicked since the last picture
    bool clicked_at_right = false;
    BodyPanel body;
    bool add_open = false;
    AddPanel add;
    bool outline_open = false;
    Outliner outliner;
    bool toolbar_open = !toolbar_hidden();
    Toolbar toolbar;
};

}  // namespace strahl
