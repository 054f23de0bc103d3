// Progressive refinement: resolution levels, and the passes between them.
#pragma once
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
/// After it pixels become averages over their squares, as in stills: tile by tile, of rays of their own.
inline constexpr int averaged_level = finest_level + 1;
Steps steps_of(int level);

/// All pixels of a level, 0 <= level <= finest_level.
Lattice pixels_of(int level, int width, int height);

/// The pixels of `level` (not 0) that the level before lacks. Without columns or rows if there are none.
Lattice new_pixels_of(int level, int width, int height);

inline double count(const Lattice& lattice) { return double(lattice.columns) * lattice.rows; }

}  // namespace strahl
