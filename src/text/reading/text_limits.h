// Limits of one scene text.
#pragma once
#include <cstddef>

namespace strahl {

/// More than these is an error. Everything else is limited by the size of the text.
struct TextLimits {
    std::size_t primitives = 5'000'000;  // a float can number 2^24 surfaces, and a body has up to three
    std::size_t transformations = 1000;  // of one primitive
    std::size_t lights = 1 << 16;
    std::size_t keys = 1 << 20;
};

}  // namespace strahl
