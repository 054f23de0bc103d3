// Progressive refinement: resolution levels, and the passes of a picture at rest.
#pragma once
#include <array>
#include <span>

#include "trace/tracer.h"

namespace strahl {

/// Distances between traced pixels, powers of two.
struct Steps {
    int x = 1, y = 1;
    bool operator==(const Steps&) const = default;
};

/// Each level has twice the pixels of the one before: every 16th in both directions, then every 8th column of every
/// 16th row, every 8th, ... and finally all. This is the scheme of interlaced PNG ("Adam7") with two more levels
/// before.
inline constexpr int finest_level = 8;
/// All pixels are averages over their squares, as in stills.
inline constexpr int averaged_level = finest_level + 1;
/// As a limit of pictures in motion: rays go where the picture needs them, not to pixels of equal distances.
inline constexpr int uneven_level = averaged_level;
Steps steps_of(int level);

/// Returns the level that has about as many pixels as this share of all.
int level_of(double share);

/// Returns the pixels of a level, 0 <= level <= finest_level.
Lattice pixels_of(int level, int width, int height);

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
