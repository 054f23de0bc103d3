// Wall time.
#pragma once
#include <chrono>
#include <utility>

namespace strahl {

class Stopwatch {
  public:
    /// Seconds since the last call.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
};

}  // namespace strahl
