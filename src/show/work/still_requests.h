// The stills that the user asks for: what becomes of them, and the end of the program, which waits for them.
#pragma once
#include <functional>
#include <string>

#include "show/session/view_options.h"
#include "show/work/notes.h"
#include "show/work/stills.h"

namespace strahl {

class StillRequests {
  public:
    /// Tells the user if the folder for stills cannot be used. `notify` is called from another thread when there is
    /// something to tell.
    StillRequests(const ViewOptions& options, Notes& notes, Pace& pace, std::function<void()> notify);

    /// Queues a still of this view. `ending` is that of its file, .bmp or .png.
    void add(const Session& session, const std::string& scene_path, View view, const std::string& ending);
    /// Tells the user about the stills that are done, and logs progress every 2 seconds.
    void tell_done();

    /// Begins the end of the program: waits for the stills that are queued. Asked for again, drops them.
    void finish();
    /// Are all stills done or dropped, after finish()?
    bool finished() const { return finishing && stills.pending() == 0; }
    /// Could a still not be written?
    bool failed() const { return any_failed; }

    /// "A still: 30 %, 1 more waiting", or "".
    std::string progress_text() const;
    /// Returns the progress of the still being traced, 0 to 1.
    double progress() const { return stills.progress(); }

  private:
    const ViewOptions& options;
    Notes& notes;
    Pace& pace;
    Stills stills;
    double told = 0;  // when progress was logged last
    bool any_failed = false, finishing = false;
};

}  // namespace strahl
