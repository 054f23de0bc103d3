// Makes a film of the flight in the background, as `strahl render SCENE -o x.mp4` does.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "image/film.h"
#include "image/transfer.h"
#include "scene/scene.h"
#include "show/session/session.h"
#include "show/session/view_options.h"
#include "show/work/notes.h"
#include "show/work/pace.h"
#include "show/work/worker.h"
#include "trace/world/view.h"

namespace strahl {

/// A film to be made.
struct FilmOrder {
    Scene scene;       // its flight is what is filmed, at 25 frames a second
    View view;         // the size, even in both directions, and the depth; the camera is that of each moment
    bool fit = false;  // widens the view of a camera whose aspectratio is not that of the picture
    std::string path{};
    std::optional<FilmSound> sound{};
    Exposure exposure{};
};
/// Returns the film of the flight that the session has now, for a window of this size. Nothing if nothing flies.
std::optional<FilmOrder> film_of(const Session& session, const std::string& scene_path, int width, int height);

/// One film at a time, traced in double on all threads at low priority: it takes the processor time that the window
/// leaves.
class FilmRecorder {
  public:
    /// `notify` is called from another thread when there is something to tell.
    FilmRecorder(const ViewOptions& options, Notes& notes, Pace& pace, std::function<void()> notify)
        : options(options), notes(notes), pace(pace), worker(std::move(notify)) {}

    bool under_way() const { return worker.busy(); }
    /// Begins a film of the flight, in the folder for stills. If one is being made, ends it with the frames so far.
    void toggle(const Session& session, const std::string& scene_path, int width, int height);
    /// Begins the end of the program, which waits for the film. Asked for again, ends the film as above.
    void finish();
    /// Tells the user about a film that has ended.
    void tell_done();
    /// Could the film not be made?
    bool failed() const { return any_failed; }
    /// "A film: 30 %, scene.mp4; Ctrl+F12 ends it", or "".
    std::string progress_text() const;
    /// Returns its progress, 0 to 1.
    double progress() const { return share; }

  private:
    /// How a film ended.
    struct FilmEnd {
        std::string said, fault{};
    };
    FilmEnd make(const FilmOrder& order, const std::atomic<bool>& stop);

    const ViewOptions& options;
    Notes& notes;
    Pace& pace;
    std::string path;  // of the film under way
    std::atomic<double> share = 0;
    double began = 0;  // when the film was asked for
    bool finishing = false, any_failed = false;
    Worker<FilmEnd> worker;
};

}  // namespace strahl
