// Does in the window what an editor of tracks asks for.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "show/work/notes.h"
#include "show/work/rocket.h"

namespace strahl {

class TrackEditor {
  public:
    /// `rocket` is the connection to the editor; null if there is none, and then nothing here has an effect. `notify`
    /// is called from another thread when there is something to follow.
    TrackEditor(std::unique_ptr<Rocket> rocket, Session& session, Notes& notes, Pace& pace,
                std::function<void()> notify);

    bool connected() const { return rocket != nullptr; }
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
    void take_tracks();

    std::unique_ptr<Rocket> rocket;
    Session& session;
    Notes& notes;
    Pace& pace;
    std::optional<double> heard;  // when the editor sent a change that is not on the screen yet
};

}  // namespace strahl
