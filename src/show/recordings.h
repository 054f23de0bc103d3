// Makes what the window records: stills, films, and with --benchmark pictures of the flight. Ends the program when they
// are done.
#pragma once
#include <atomic>
#include <functional>
#include <vector>

#include "show/film_recorder.h"
#include "show/motion/benchmark.h"
#include "show/motion/flown_pictures.h"
#include "show/window/overlay.h"
#include "show/work/still_requests.h"
#include "show/work/trace_thread.h"

namespace strahl {

class Recordings {
  public:
    /// `notify` is called from another thread when there is something to tell.
    Recordings(const ViewOptions& options, Notes& notes, Pace& pace, const std::function<void()>& notify)
        : stills(options, notes, pace, notify), film(options, notes, pace, notify), options(options), pace(pace) {}

    /// Keeps some pictures of the flight for the benchmark, but none that was refined before it began.
    void keep_flown(const Fresh& fresh, const Session& session);
    /// Reports the figures of the flight. They include its quality, unless the program is interrupted.
    void report_benchmark(const BenchmarkSetting& setting, const Exposure& exposure,
                          const std::atomic<bool>& interrupted) const;

    /// Begins the end of the program, see StillRequests::finish and FilmRecorder::finish.
    void finish() { stills.finish(), film.finish(); }
    /// Tells the user about what is done. Returns true if the program can end.
    bool tell_done();
    bool failed() const { return stills.failed() || film.failed(); }
    bool under_way() const { return !stills.progress_text().empty() || film.under_way(); }
    std::vector<Overlay::Bar> bars() const;

    StillRequests stills;
    FilmRecorder film;

  private:
    const ViewOptions& options;
    Pace& pace;
    FlownPictures flown;
};

}  // namespace strahl
