// Decodes Ogg Vorbis files.
#pragma once
#include <atomic>
#include <cstdio>
#include <string>
#include <vector>

namespace strahl {

/// Samples of 16 bits, one per channel and moment.
struct Samples {
    std::vector<char> bytes;
    int channels = 0, rate = 0;
    std::string fault;  // why there are none, or ""
};

/// Returns the greatest amplitude in each hundredth of a second, from 0 to 1.
std::vector<float> peaks_of(const Samples& samples);

/// Decodes an Ogg Vorbis file of one channel or two to its end, or until it is asked to stop. Closes the file, which
/// may be null; `name` is for the message.
Samples decode_ogg(std::FILE* file, const std::string& name, const std::atomic<bool>& stop);

}  // namespace strahl
