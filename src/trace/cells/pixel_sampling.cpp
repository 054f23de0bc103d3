#include "trace/cells/pixel_sampling.h"

#include <cmath>
#include <numeric>

namespace strahl {

Sampled& Sampled::operator+=(const Sampled& other) {
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] += other.pixels[i];
    squares += other.squares;
    return *this;
}

std::uint64_t Sampled::count() const { return std::accumulate(pixels.begin(), pixels.end(), std::uint64_t(0)); }

int Sampled::median() const {
    std::uint64_t left = (count() + 1) / 2;
    std::size_t i = 0;
    for (; i + 1 < pixels.size() && pixels[i] < left; ++i) left -= pixels[i];
    return static_cast<int>(i);
}

int Sampled::most() const {
    std::size_t i = pixels.size() - 1;
    while (i > 0 && pixels[i] == 0) --i;
    return static_cast<int>(i);
}

double Sampled::error() const { return count() ? std::sqrt(squares / static_cast<double>(count())) : 0; }

}  // namespace strahl
