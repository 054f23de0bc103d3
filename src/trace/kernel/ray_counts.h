// Counts of the rays traced, and bounds of the light that was left out.
#pragma once
#include <cstdint>

namespace strahl {

/// Counts rays by type, with the deepest generation that had any.
struct Counts {
    std::uint64_t camera = 0, reflected = 0, refracted = 0, shadow = 0;
    int depth = 0;
    std::uint64_t split = 0;  // batches traced again in halves, as their rays did not fit; varies with the threads
    // Upper bounds of the light that a pixel lacks in any channel: by pruned rays (View::error), and by generations
    // past View::depth; infinite where those have no bound.
    double dropped = 0, past = 0;
    double lost() const { return dropped + past; }
    Counts& operator+=(const Counts& other);
    std::uint64_t total() const { return camera + reflected + refracted + shadow; }
};

}  // namespace strahl
