// Rays traced, and the light that was left out.
#pragma once
#include <cstdint>

namespace strahl {

/// Rays by type, and the deepest generation that had any.
struct Counts {
    std::uint64_t camera = 0, reflected = 0, refracted = 0, shadow = 0;
    int depth = 0;
    // No pixel lacks more light than this in any channel: by rays pruned (View::error), and by generations past
    // View::depth; infinite where those have no bound.
    double dropped = 0, past = 0;
    double lost() const { return dropped + past; }
    Counts& operator+=(const Counts& other);
    std::uint64_t total() const { return camera + reflected + refracted + shadow; }
};

}  // namespace strahl
