// The keys of the scene's tracks while they are edited, as the text of the file beside the scene.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/motion/track.h"
#include "show/session/edited_text.h"

namespace strahl {

class TrackKeys {
  public:
    /// Begins with the text of another file of tracks, or none.
    void open(const std::string& text);
    /// To be called when the file was read, with its text; see EditedText::reload.
    bool reload(const std::string& text);

    const std::vector<Track>& tracks() const { return present; }
    /// Returns the track of this name, perhaps without keys.
    Track track(const std::string& name) const;
    bool changed() const { return edited.changed(); }
    /// Returns the changed tracks that are not written yet; tracks that were removed have no keys.
    std::vector<Track> changes() const;
    std::vector<std::string> unwritten() const { return edited.unwritten(); }

    /// Gives a track these keys.
    void change(const Track& track, const Edit& edit);
    /// See EditedText.
    std::optional<std::string> undo(bool back, EditOrder& order);
    std::size_t next_step(bool back, const EditOrder& order) const { return edited.next_step(back, order); }

  private:
    EditedText edited;
    std::vector<Track> saved, present;
};

/// Returns a track in which the keys of the first beat, of so many rows, are repeated in each beat before `end`.
Track repeated(const Track& track, int beat, int end);

}  // namespace strahl
