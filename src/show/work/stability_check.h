// Finds in the background the pixels whose colour in float or double differs from that in long double, and those whose
// colour in double is not proved (tests/proof/README.md).
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "show/work/worker.h"
#include "trace/tracer.h"

namespace strahl {

/// A pixel whose 8-bit colour differs from that of long double.
struct Mark {
    int x = 0, y = 0;
    bool in_double = false;  // double differs too
};

/// The pixels of a view that depend on rounding. All colours have 8 bits.
struct Stability {
    std::vector<Mark> marks;
    /// Consecutive pixels of a row that are not proved.
    struct Run {
        int x = 0, y = 0, columns = 0;
    };
    std::vector<Run> undecided;
    std::optional<double> proved;  // share of all pixels; none if this program cannot prove
};

class StabilityCheck {
  public:
    /// `notify` is called from another thread when there is progress.
    StabilityCheck(int threads, std::function<void()> notify) : threads(threads), worker(std::move(notify)) {}

    /// Starts, after cancelling what is under way.
    void start(std::shared_ptr<const Scene> scene, const View& view);
    /// Ends what is under way and forgets what was found; takes at most one tile in long double.
    void cancel();
    /// Is it under way, or is there something found?
    bool active() const { return started; }
    bool under_way() const { return worker.unfinished() > 0; }
    /// The share of the picture that is done, 0 to 1.
    double progress() const { return share; }
    /// Returns true once, when it has come to its end.
    bool take();
    /// Returns the result, which is empty until the check has ended.
    const Stability& found() const { return result; }

  private:
    const int threads;
    bool started = false;
    std::atomic<double> share = 0;
    Stability result;
    Worker<Stability> worker;
};

}  // namespace strahl
