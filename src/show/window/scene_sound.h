// Keeps the sound of a scene and its pictures together.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "show/session/session.h"
#include "show/window/sound.h"
#include "show/work/notes.h"
#include "show/work/pace.h"

namespace strahl {

class SceneSound {
  public:
    SceneSound(Notes& notes, Pace& pace) : notes(notes), pace(pace) {}

    /// Loads the sound that the scene names, if it is another file than before. `notify` is called from another thread
    /// when it is loaded.
    void load(const std::shared_ptr<const Scene>& scene, const std::string& scene_path,
              const std::function<void()>& notify);
    /// See Sound::peaks. Empty if there is no sound.
    const std::vector<float>& peaks() const;
    bool loading() const { return sound && sound->loading(); }

    /// Plays the sound where the flight is, and keeps the flight's clock on the sound device, which runs more evenly
    /// than any other: so the picture on the screen, not the one that is being traced, is that of the moment heard.
    void follow(Session& session);
    /// To be called when a picture is on the screen that was ordered for the moment `ordered` of the flight.
    void picture_shown(const Session& session, double ordered);
    /// How far pictures, the last ones at least, were ahead of the sound since the last call: the median and a range
    /// that has 95 of 100. "" if there was no sound.
    std::string report();

  private:
    Notes& notes;
    Pace& pace;
    std::shared_ptr<const Scene> known;  // the scene of this
    std::unique_ptr<Sound> sound;
    std::string file;
    bool told = false;  // why there is no sound
    struct Compared {
        double now, flight;  // when sound and picture were compared last, and the moment of the flight then
    };
    std::optional<Compared> last;  // while they run together
    double delay = 0;              // seconds from the order of a picture until it is on the screen, a sliding mean
    std::vector<double> ahead;     // seconds by which each of the last pictures was ahead of the sound
};

}  // namespace strahl
