// Says how the light of a pixel is averaged from samples, and how many that took.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace strahl {

/// The exact value of a pixel is the average of the picture over the pixel's square, of unclamped values.
struct Sampling {
    /// n > 0: n x n rays through the middles of equal squares; 1 is one ray through the pixel's middle. 0: as many rays
    /// as the picture needs.
    int grid = 0;
    bool centre = false;      // a grid has one ray more, through the pixel's middle: what POV-Ray's +AM1 averages
    double error = 1. / 510;  // without a grid: the RMS error aimed at over all pixels and channels, not below 1e-4
};

/// Averages aim no lower than this.
inline constexpr double least_sampling_error = 1e-4;

/// The errors of a picture as measured at some of its pixels.
struct MeasuredError {
    std::uint64_t checked = 0;  // how often a pixel was checked, all pixels together
    double squares = 0;         // the sum over all pixels of the mean square of their channels' errors; may be below 0
    double variance = 0;        // variance of that sum

    MeasuredError& operator+=(const MeasuredError& other);
};

/// Counts the samples that pixels of pictures without a grid needed.
struct Sampled {
    std::vector<std::uint64_t> pixels = std::vector<std::uint64_t>(4097);  // by their samples, the last one with more
    MeasuredError measured;

    Sampled& operator+=(const Sampled& other);
    std::uint64_t count() const;
    int median() const;
    int most() const;
    void add(std::span<const std::uint32_t> samples);
    /// Returns an estimate of the RMS error, not a bound: where errors are too small to be measured, the least that can
    /// be. 0 if no pixels were checked.
    double error() const;
};

}  // namespace strahl
