// The number of pixels of a picture that are proved.
#pragma once
#include <cstdint>

namespace strahl {

struct ProofCounts {
    int bits = 8;  // of each value in the file
    std::int64_t proved = 0, in_extended = 0, undecided = 0;  // pixels; `in_extended` are among `proved`
    double median = 0;  // of the bounds on the errors of pixels
};

}  // namespace strahl
