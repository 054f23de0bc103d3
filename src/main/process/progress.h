// The progress line: how much is done and how long the rest will take.
#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace strahl {

/// "  42 %, 1:05 left" for `share` (0 to 1) done after `seconds`; without the time left until it can be estimated.
std::string progress_text(double share, double seconds);

/// A line on standard error that is rewritten in place, at most ten times a second, and erased at the end. Nothing is
/// written if `quiet`, or if standard error is not a terminal.
class ProgressLine {
  public:
    /// `label` precedes the percentage, such as "frame 3 of 90 ".
    explicit ProgressLine(bool quiet, std::string label = "");
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// May be called from any thread; `total` is above 0.
    void advance(std::uint64_t done, std::uint64_t total);

  private:
    using Clock = std::chrono::steady_clock;
    const bool shown;
    const std::string label;
    const Clock::time_point start = Clock::now();
    std::mutex mutex;
    Clock::time_point last = start;
    std::uint64_t furthest = 0;
    bool written = false;
};

}  // namespace strahl
