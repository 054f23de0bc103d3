// The progress line: how much is done and how long the rest will take.
#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace strahl {

/// "  42 %, 1:05 left" for `share` (0 to 1) done after `seconds`; the rest is left out until it can be told.
std::string progress_text(double share, double seconds);

/// A line on standard error that is rewritten in place, at most ten times a second, and erased at the end. Silent if
/// `quiet` or if standard error is no terminal.
class Progress {
  public:
    /// `label` stands before the percentage, as "frame 3 of 90 ".
    explicit Progress(bool quiet, std::string label = "");
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// From any thread; `total` above 0.
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
