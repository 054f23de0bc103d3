// Does in the window what an editor of tracks asks for.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "show/work/notes.h"
#include "show/work/rocket.h"
#include "show/work/worker.h"

namespace strahl {

class TrackEditor {
  public:
    /// `port` is that of the editor; without one nothing here has an effect. While there is no editor, waits for one.
    /// `notify` is called from another thread when there is something to follow.
    TrackEditor(std::optional<int> port, Session& session, Notes& notes, Pace& pace, std::function<void()> notify);

    /// Is there an editor, or is one waited for?
    bool wanted() const { return port.has_value(); }
    /// Asks the editor for the tracks that the scene follows. To be called for every new scene.
    void ask();
    /// Applies what the editor has sent since the last call, and tells it where the flight is. Returns whether it wants
    /// the tracks saved.
    bool follow();

    /// Is a change of the editor not on the screen yet?
    bool awaited() const { return heard.has_value(); }
    /// To be called when a picture is on the screen that has all changes.
    void shown();

  private:
    void await_editor();
    void take_editor();
    void take_tracks();

    const std::optional<int> port;
    Session& session;
    Notes& notes;
    Pace& pace;
    const std::function<void()> notify;
    std::unique_ptr<Rocket> rocket;
    std::optional<double> heard;  // when the editor sent a change that is not on the screen yet
    std::string fault;            // why there is no editor
    struct EditorSearch {
        std::unique_ptr<Rocket> found;  // null if there is none
        std::string fault;              // the reason
    };
    Worker<EditorSearch> worker;
};

}  // namespace strahl
