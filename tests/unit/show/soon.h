// Waits for what other threads do.
#pragma once
#include <chrono>
#include <functional>
#include <thread>

namespace strahl {

/// Waits until `done` returns true, for a minute at most; returns false after that.
inline bool soon(const std::function<bool()>& done) {
    for (int i = 0; i < 6000; ++i) {
        if (done()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

}  // namespace strahl
