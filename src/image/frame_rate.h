// Stores the rate of a film as a fraction, because rates such as 59.94, which is 60000/1001, have no finite decimals.
#pragma once
#include <algorithm>
#include <cmath>
#include <string>

namespace strahl {

/// `frames` frames last `seconds` seconds; both are from 1 to 2147483647, which is what ffmpeg can hold.
struct FrameRate {
    int frames = 25, seconds = 1;
    /// Returns the moment of a frame in seconds; frame 0 is at 0.
    double moment(int frame) const { return double(frame) * seconds / frames; }
    /// Returns the number of frames of a film that lasts so many seconds, at least 1.
    double frames_in(double duration) const { return std::max(std::ceil(duration * per_second() - 1e-6), 1.); }
    double per_second() const { return double(frames) / seconds; }
    /// Returns "60000/1001", or "60000:1001" as streams write it.
    std::string text(char between = '/') const { return std::to_string(frames) + between + std::to_string(seconds); }
};

}  // namespace strahl
