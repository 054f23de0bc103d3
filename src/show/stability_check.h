// What float decides otherwise than long double in the picture on show, found out in the background.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "trace/tracer.h"

namespace strahl {

/// A pixel whose 8-bit colour is not that of long double.
struct Mark {
    int x = 0, y = 0;
    bool in_double = false;  // in double, too
};

class StabilityCheck {
  public:
    /// `news` is called from another thread when the marks are there.
    StabilityCheck(int threads, std::function<void()> news);
    ~StabilityCheck();

    /// Begins anew, with the view in all three precisions.
    void start(std::shared_ptr<const Scene> scene, const View& view);
    /// Ends what is under way, within a tile of long double.
    void cancel();
    bool under_way() const { return thread.joinable() && !ready; }
    /// The marks, once, when they are there.
    std::optional<std::vector<Mark>> take();

  private:
    const int threads;
    const std::function<void()> news;
    std::atomic<bool> stop = false, ready = false;
    std::vector<Mark> marks;
    std::thread thread;
};

}  // namespace strahl
