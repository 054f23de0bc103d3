// How many pixels of a picture are proved.
#pragma once
#include <cstdint>

namespace strahl {

struct ProofCounts {
    int bits = 8;  // of the file's values
    std::int64_t proved = 0, in_extended = 0, undecided = 0;  // pixels; the second ones are among the first
    double median = 0;  // of the bounds of the pixels' errors
};

}  // namespace strahl
