// Compares Strahl's picture with POV-Ray's: which pixels differ, and whether they are on an edge.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "image/picture.h"
#include "povref/compare/run_povray.h"
#include "trace/tracer.h"

namespace strahl {

/// Differences are counted in steps of 1/65535 between 16-bit values.
struct Verdict {
    std::size_t pixels = 0;
    int worst_off_edges = 0;                   // the largest difference there
    std::size_t beyond_off_edges = 0;          // pixels that differ by more than one step
    std::size_t beyond_on_edges = 0;           // pixels on edges beyond one step
    std::size_t in_areas = 0;                  // pixels that count as off the edges, in areas full of edges
    std::size_t unsure = 0;                    // such pixels where POV-Ray's rounding decides
    int x = -1, y = -1;                        // of the worst pixel off the edges, if it is beyond one step
    std::vector<std::array<int, 2>> places{};  // x and y of all pixels that beyond_off_edges counts
};

/// A pixel this near to an edge, in pixels, may differ, because POV-Ray ignores lengths below 1e-4 and 1e-3.
inline constexpr double edge_radius = 0.01;

/// How many pixels amid edges may differ in a square of 17 pixels: single ones do in glass and in mirrors of mirrors.
inline constexpr int most_amid = 6;

/// Makes this part of POV-Ray's picture once more by its own camera, with rays that are moved by some millionths of a
/// pixel, for each number by others, and for every other one by another hierarchy of boxes: those in single precision
/// may hide one of two faces in one place.
using Again = std::function<Picture(int number, const PicturePart& part)>;
inline constexpr int most_again = 8;

/// Is POV-Ray unsure of more than one pixel in 50? Too few are left to compare.
inline bool too_unsure(const Verdict& verdict) { return verdict.unsure * 50 > verdict.pixels; }

/// Compares POV-Ray's picture of a view, `theirs`, with the tracer's, `ours`. Searches for edges where they differ,
/// until one pixel in 50 does off the edges: all that differ after that count as off the edges, except in
/// `worst_off_edges`. Edges are lines: pixels of which six in eight neighbours are on edges as well, as they are where
/// rounding sprinkles a face, are on none if more than `most_amid` of them differ within eight pixels. POV-Ray's
/// rounding decides in a pixel if one of its pictures made again differs there from `theirs` by more than two steps and
/// by half of what `ours` does; no more are made once four in a row, or one if so many differ, show no other pixel of
/// that kind. Throws Stopped once `stop` is true.
Verdict judge(Tracer& tracer, const View& view, const Frame& ours, const Picture& theirs,
              const std::atomic<bool>* stop = nullptr, const Again& again = {});

}  // namespace strahl
