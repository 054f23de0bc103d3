// Means of patterns over footprints: what a sample's square of the view shows of them. Compiled once, in double,
// because it works on one sample at a time.
//
// Over a parallelogram a coordinate changes linearly; other areas are divided into such ones. The mean of a periodic
// function of one coordinate follows from the function's second integral; of products of such functions, one for each
// coordinate, from sums over the pieces in which all but one of them are constant. Compare A. Apodaca and L. Gritz,
// "Advanced RenderMan", 1999, chapter 11, on antialiasing by analytic integration; it has boxes along the axes, here
// parallelograms are what they are.
#pragma once
#include <array>

#include "num/vec.h"
#include "trace/world/world_patterns.h"

namespace strahl {

/// Describes what a square of the view shows of a plane, in a pattern's space. The point i sides right of its middle
/// and j below, from -1/2 to 1/2, is middle + (i across + j down) / (1 + i shrink[0] + j shrink[1]): a parallelogram
/// where all of it is as far away, and else a quadrilateral whose further parts are larger. Means are over the square
/// of the view.
template <class S>
struct SeenArea {
    Vec3<S> middle, across, down;
    S weight{1};  // of the ray that sees it: means of little weight are less exact
    std::array<S, 2> shrink{S(0), S(0)};

    Vec3<S> at(const S& i, const S& j) const {
        const S per = S(1) / (S(1) + i * shrink[0] + j * shrink[1]);
        Vec3<S> point;
        for (int c = 0; c < 3; ++c) point[c] = middle[c] + per * (i * across[c] + j * down[c]);
        return point;
    }
    /// Returns a rectangle of the square, around (i, j), with sides of these shares of the square's.
    SeenArea part(const S& i, const S& j, const S& width, const S& height) const {
        const S per = S(1) / (S(1) + i * shrink[0] + j * shrink[1]), sides[2] = {per * width, per * height};
        SeenArea own{at(i, j), across, down, weight, {sides[0] * shrink[0], sides[1] * shrink[1]}};
        for (int c = 0; c < 3; ++c) {
            own.across[c] = sides[0] * (across[c] - shrink[0] * (own.middle[c] - middle[c]));
            own.down[c] = sides[1] * (down[c] - shrink[1] * (own.middle[c] - middle[c]));
        }
        return own;
    }
};
using PatternArea = SeenArea<double>;

/// Values that a pattern has in equal shares, from the least to the largest.
inline constexpr int most_anywhere = 256;
using ValuesAnywhere = std::array<double, most_anywhere>;

/// Values of noise, layers, rings or a solid pattern, not yet folded or limited, at the corners of a parallelogram's
/// columns and rows.
struct ValueGrid {
    static constexpr int most_steps = 10, most_values = (most_steps + 1) * (most_steps + 1);
    static constexpr int room = (most_values + 15) / 16 * 16;  // a whole number of packs
    int columns, rows;
    double spread = 0;    // the standard deviation of what the values lack of the finest detail
    double loose = 0;     // the share of their variation over areas beside each other that they lack, from 0 to 1
    double unseen = 0;    // the variance of the area's mean that they do not show, as a share of that of values
    double cells = 0;     // how many cells of the finest detail that counts the sides of the area cross
    bool coarse = false;  // detail is lost between values: colours of these count, not of what lies between
    double lost = 0;      // to this share the area shows so many cells that any value may be anywhere
    const ValuesAnywhere* anywhere = nullptr;  // the values of the pattern in all of space
    alignas(64) double values[room] = {};      // row by row
};

/// The grid has so many steps for each cell of the finest detail that counts, if these are not too many. Detail counts
/// from this share of the strongest on (tests/bench/tried.md).
inline constexpr int steps_per_cell = 5;
inline constexpr double least_strength = 1. / 16;
/// Returns the share of the steps that a grid needs, of rays of weight 1, for a pattern whose colours differ by this
/// much; above 1 for all and more.
template <class T>
double share_of_steps(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops);
/// Returns the fewest steps of a grid: where colours jump, values between corners decide whether they do.
template <class T>
int least_steps(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops) {
    for (int i = 1; i < pattern.stops; ++i)
        if (stops[i].at == stops[i - 1].at) return 3;
    return 1;
}
/// Finds values of a solid pattern at some points of a grid, see smoothed_value().
using SmoothedValues = void (*)(const SolidPattern&, const double (&at)[3][ValueGrid::room], int count, double step,
                                double* values);
void values_one_by_one(const SolidPattern& solid, const double (&at)[3][ValueGrid::room], int count, double step,
                       double* values);

/// Returns the variance of a mean over one cell of detail that points `step` cells apart do not show, as a share of
/// that of its values: all of it if they are further apart than cells. Between them values are linear, unless they
/// jump: then only pieces that borders cross are unknown, a share of `step` of all.
template <class S>
S unseen_of_cell(const S& step, bool jumps) {
    using std::min;
    const S share = min(step, S(1)), cube = share * share * share;
    return jumps ? cube : share * cube;
}

/// Most stops of patterns whose weights are found.
inline constexpr int most_weighed = 16;

/// The mean colour of a pattern over an area. It is detailed if colours have edges in an area three times as long and
/// wide: samples around may see what this one does not.
struct PatternMean {
    DVec3 color;
    bool detailed;
    double loose, doubt = 0;  // see Filtering
};
/// `weights`, unless null, get the shares of the pattern's stops: the mean is the sum of their colours times these.
template <class T>
PatternMean mean_over(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops, const PatternArea& area,
                      double* weights = nullptr, SmoothedValues find = values_one_by_one);
template <class T>
PatternMean mean_over(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops, const ValueGrid& grid,
                      double* weights = nullptr);

/// Returns whether means of this form need no grid of values from the caller.
inline bool has_mean(PatternForm form) {
    return form == PatternForm::checker || form == PatternForm::brick || form == PatternForm::ramp ||
           form == PatternForm::solid;
}

}  // namespace strahl
