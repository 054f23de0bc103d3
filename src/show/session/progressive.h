// Progressive refinement: resolution levels, and the passes of a picture at rest.
#pragma once
#include <array>
#include <span>

#include "trace/world/view.h"

namespace strahl {

/// Distances between traced pixels.
struct Steps {
    int x = 1, y = 1;
    int area() const { return x * y; }
    bool operator==(const Steps&) const = default;
};

/// The pixels of the picture for each traced one, by level: from every 16th in both directions to all. Each level has
/// at most twice the pixels of the one before, and up to a quarter of all at most 1.8 times as many, so that one fits
/// the time well.
inline constexpr std::array<int, 13> level_areas{256, 128, 64, 48, 36, 24, 16, 12, 9, 6, 4, 2, 1};
inline constexpr int sixteenth_level = 6, ninth_level = 8, finest_level = static_cast<int>(level_areas.size()) - 1;
/// All pixels are averages over their squares, as in stills.
inline constexpr int averaged_level = finest_level + 1;
/// The finest level for pictures in motion: some of the time goes to rays where the picture changes most
/// (motion/sharpener.h).
inline constexpr int sharpened_level = averaged_level;

/// Returns the steps of a level, 0 <= level <= finest_level, whose quotient x / y is nearest to `aspect`. They may have
/// up to 1/8 more traced pixels than the level.
Steps steps_of(int level, double aspect = 1);

/// Returns the pixels of a picture that are traced with these steps.
Lattice pixels_of(Steps steps, int width, int height);
inline Lattice pixels_of(int level, int width, int height) { return pixels_of(steps_of(level), width, height); }

/// Returns the side of the squares, in pixels, over which patterns are averaged in a picture of traced pixels with
/// these steps: less than their distance, as the picture is sharper so (tests/bench/motion_quality.md).
double averaged_side(Steps steps);

/// A pass of a picture at rest: its cells (trace/cells/cell_picture.h) are refined until no unfinished one is larger
/// than `finest` pixels; with 0 until all are finished. Then the picture is at least as good as this level.
struct Pass {
    int finest, level;
};
inline constexpr std::array<Pass, 3> passes{{{2, finest_level - 2}, {1, finest_level}, {0, averaged_level}}};

/// Returns the passes that a picture of this level still needs: those that lead to a finer level.
std::span<const Pass> passes_after(int level);

inline double count(const Lattice& lattice) { return double(lattice.columns) * lattice.rows; }

}  // namespace strahl
