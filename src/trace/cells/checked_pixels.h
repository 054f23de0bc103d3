// Measures the error of a picture at some of its pixels.
//
// Samples that agree cannot tell what lies between them, so the error of a picture cannot be judged from the samples
// that made it. Some pixels, chosen at random, are therefore traced once more, by many rays at random places.
#pragma once
#include <cstdint>
#include <span>

#include "trace/cells/cells.h"

namespace strahl {

/// A finished tile. Values and samples are by pixel, row by row.
struct FinishedTile {
    int columns;
    std::span<const double> rgb;
    std::span<const std::uint32_t> samples;
};

/// Traces points whose footprints are squares of this side, in pixels.
using TraceSquares = std::function<void(std::span<const Point>, double side, CellSample*)>;

/// Chooses pixels of a tile, each by chance: `share` times its number of samples and a quarter, since errors are where
/// many samples were needed. The expected value of the result is the sum over all pixels of the tile, whatever it shows
/// (D. Horvitz and D. Thompson, "A Generalization of Sampling Without Replacement From a Finite Universe", 1952).
MeasuredError measured_error(const FinishedTile& tile, double share, std::uint32_t seed, const TraceSquares& trace);

}  // namespace strahl
