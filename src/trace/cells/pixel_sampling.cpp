#include "trace/cells/pixel_sampling.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strahl {

MeasuredError& MeasuredError::operator+=(const MeasuredError& other) {
    checked += other.checked, squares += other.squares, variance += other.variance;
    return *this;
}

Sampled& Sampled::operator+=(const Sampled& other) {
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] += other.pixels[i];
    measured += other.measured;
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

void Sampled::add(std::span<const std::uint32_t> samples) {
    for (const std::uint32_t count : samples) ++pixels[std::min<std::size_t>(count, pixels.size() - 1)];
}

double Sampled::error() const {
    const double squares = std::max(measured.squares, std::sqrt(measured.variance));
    return count() ? std::sqrt(squares / static_cast<double>(count())) : 0;
}

}  // namespace strahl
