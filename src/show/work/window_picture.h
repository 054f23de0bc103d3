// The picture in the window: which view is traced for it, how far that is, and the marks on it.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>

#include "show/work/notes.h"
#include "show/work/stability_check.h"
#include "show/work/trace_thread.h"

namespace strahl {

class WindowPicture {
  public:
    /// `notify` is called from other threads when there is something to take or to tell.
    WindowPicture(int threads, Notes& notes, Pace& pace, const std::function<void()>& notify)
        : notes(notes), pace(pace), tracing(threads, notify), check(threads, notify) {}

    /// Orders the picture of this scene, all of the session's or a part of it, that a window of this size should show,
    /// unless it is the one ordered last.
    void order(const Session& session, std::shared_ptr<const Scene> scene, int width, int height);
    /// Passes what is new since the last call to `upload`. False if nothing is new.
    bool take(const TraceThread::Upload& upload);

    /// Is there something to take?
    bool has_update() const { return tracing.has_update(); }
    /// Is the picture ordered last finished?
    bool finished() const { return tracing.finished(); }
    /// The progress of the picture on the screen.
    const Refinement& state() const { return progress; }
    /// Is the picture on the screen the one ordered last?
    bool newest() const { return progress.number == wanted.number; }
    int threads() const { return tracing.threads(); }
    /// Returns for how many seconds a scene is being made ready for it; 0 if none is.
    double seconds_built() const { return tracing.seconds_built(); }

    /// To be called when a motion ends: its last picture may have been finished before.
    void rest() { logged = 0; }
    /// Logs once per rest that the picture is finished.
    void log_finished();

    /// Starts to look for the pixels that rounding decides, if the camera rests; or removes their marks.
    void toggle_marks();
    /// Tells the user when they are found.
    void tell_marks();
    const StabilityCheck& marks() const { return check; }

  private:
    Notes& notes;
    Pace& pace;
    TraceThread tracing;
    StabilityCheck check;
    Order wanted;
    Refinement progress;
    std::uint64_t logged = 0;  // number of the last picture logged as finished
};

}  // namespace strahl
