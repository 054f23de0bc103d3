#include "trace/patterns/pattern_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "num/lattice_noise.h"
#include "num/vec_math.h"
#include "scene/solid/solid.h"
#include "scene/solid/solid_lanes.h"

namespace strahl {
namespace {

/// Shorter ways than this along a coordinate count as none: there, differences of integrals would be rounding errors.
constexpr double shortest = 1e-6;
/// Most pieces that are summed up along the coordinate that changes second most. Over more, coordinates are taken for
/// independent.
constexpr double most_pieces = 24;

/// How loose filters count at least, found by experiment: they take surfaces for flat and their light for even
/// (tests/bench/sampling.md).
constexpr double exact = .03;
/// How loose means of points on a grid count.
constexpr double of_points = .3;
/// Grids have fewer steps, in proportion, where the difference of colours times the weight of a ray is less than this:
/// the error of a mean is about that over the root of the number of values (tests/bench/sampling.md).
constexpr double full_contrast = .5;
/// Noise is detailed from so many of its finest cells on.
constexpr double finely = .25;

double fraction(double x) { return x - std::floor(x); }
double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// A periodic function less its mean, and its integrals, which are periodic too.
struct Square {  // 1 from 0 to 1 and -1 from 1 to 2
    static constexpr double mean = 0;
    double value(double x) const { return fraction(x / 2) < .5 ? 1 : -1; }
    double integral(double x) const { return std::abs(2 * fraction(x / 2) - 1) * -1 + .5; }
    double second(double x) const {
        const double t = 2 * fraction(x / 2);
        return t < 1 ? t * (t - 1) / 2 : (t - 1) * (2 - t) / 2;
    }
};
struct Course {  // 0 from 0 to `mortar` and 1 from there to 1
    double mortar, mean = 1 - mortar;
    double value(double x) const { return fraction(x) > mortar ? mortar : -mean; }
    double integral(double x) const {
        const double t = fraction(x), least = -mean * mortar;
        return (t < mortar ? -mean * t : least + mortar * (t - mortar)) - least / 2;
    }
    double second(double x) const {
        const double t = fraction(x), start = mean * mortar / 2;
        if (t < mortar) return t * (start - mean * t / 2);
        const double since = t - mortar;
        return mortar * (start - mean * mortar / 2) + since * (-start + mortar * since / 2);
    }
};

/// Returns the mean of a function less its mean, whose argument is x in the middle of a parallelogram and changes by a
/// and by b along its sides: the two boxes, one after the other, are a trapezoid.
template <class Function>
auto mean_of(const Function& function, double x, double a, double b) {
    a = std::abs(a), b = std::abs(b);
    if (a < b) std::swap(a, b);
    if (a < shortest) return function.value(x);
    if (b < shortest) return (function.integral(x + a / 2) - function.integral(x - a / 2)) / a;
    const double outer = (a + b) / 2, inner = (a - b) / 2;
    return (function.second(x + outer) - function.second(x + inner) - function.second(x - inner) +
            function.second(x - outer)) /
           (a * b);
}

/// A convex part of a parallelogram, whose area is 1: where its corners are along both sides, and in the pattern's
/// space.
struct AreaPart {
    struct AreaCorner {
        double i, j;
        DVec3 at;
    };
    std::array<AreaCorner, 12> corners;
    int count = 0;

    explicit AreaPart(const PatternArea& area) {
        for (const auto& [i, j] : {std::pair(-.5, -.5), {.5, -.5}, {.5, .5}, {-.5, .5}})
            add({i, j, area.middle + i * area.across + j * area.down});
    }
    void add(const AreaCorner& corner) { corners[count++] = corner; }

    std::pair<double, double> range(int axis) const {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int k = 0; k < count; ++k) {
            low = std::min(low, corners[k].at[axis]);
            high = std::max(high, corners[k].at[axis]);
        }
        return {low, high};
    }
    /// Returns the part of it that is on one side of a plane across an axis.
    AreaPart cut(int axis, double place, double side) const {
        AreaPart rest = *this;
        rest.count = 0;
        for (int k = 0; k < count; ++k) {
            const AreaCorner &from = corners[k], &to = corners[k + 1 < count ? k + 1 : 0];
            const double a = side * (from.at[axis] - place), b = side * (to.at[axis] - place);
            if (a >= 0) rest.add(from);
            if ((a >= 0) == (b >= 0)) continue;
            const double share = a / (a - b);
            AreaCorner between{from.i + share * (to.i - from.i), from.j + share * (to.j - from.j),
                               from.at + share * (to.at - from.at)};
            between.at[axis] = place;
            rest.add(between);
        }
        return rest;
    }
    AreaPart between(int axis, double low, double high) const {
        const auto [least, most] = range(axis);
        if (least >= low && most <= high) return *this;
        return cut(axis, low, 1).cut(axis, high, -1);
    }
    double area() const {
        double sum = 0;
        for (int k = 2; k < count; ++k)
            sum += (corners[k - 1].i - corners[0].i) * (corners[k].j - corners[0].j) -
                   (corners[k].i - corners[0].i) * (corners[k - 1].j - corners[0].j);
        return sum / 2;
    }
    DVec3 middle() const {
        DVec3 sum(0);
        for (int k = 0; k < count; ++k) sum += corners[k].at;
        return (1. / count) * sum;
    }
    /// Returns the integral of a function of a coordinate, which changes by a and by b along the parallelogram's sides:
    /// that of its integral around the border (by the divergence theorem).
    template <class Function>
    double integral(const Function& function, int axis, double a, double b) const {
        if (count < 3) return 0;
        const double squared = a * a + b * b;
        double sum = 0;
        if (squared < shortest * shortest) return area() * (function.mean + function.value(middle()[axis]));
        for (int k = 0; k < count; ++k) {
            const AreaCorner &from = corners[k], &to = corners[k + 1 < count ? k + 1 : 0];
            const double x = from.at[axis], way = to.at[axis] - x;
            const double mean = std::abs(way) < shortest ? function.integral(x + way / 2)
                                                         : (function.second(x + way) - function.second(x)) / way;
            sum += (a * (to.j - from.j) - b * (to.i - from.i)) * mean;
        }
        return area() * function.mean + sum / squared;
    }
};

/// Points further out count as anywhere: rounding leaves nothing of where in a piece they are.
constexpr double furthest = 1e9;
bool is_far(const PatternArea& area) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += std::abs(area.middle[c]) + std::abs(area.across[c]) + std::abs(area.down[c]);
    return !(sum < furthest);
}

double extent(const PatternArea& area, int axis) { return std::abs(area.across[axis]) + std::abs(area.down[axis]); }

/// Returns whether a coordinate comes to a whole number within three times the area.
bool has_border(const PatternArea& area, int axis, double shift = 0) {
    const double middle = area.middle[axis] + shift, reach = 1.5 * extent(area, axis);
    return std::floor(middle - reach) != std::floor(middle + reach);
}

/// Returns the mean of the product of square waves of all coordinates.
double mean_of_checks(const PatternArea& area) {
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::sort(axes, {}, [&](int axis) { return extent(area, axis); });
    const auto [first, second, last] = axes;
    const Square square;
    if (is_far(area)) return 0;
    if (extent(area, second) > most_pieces) {
        double product = 1;
        for (const int axis : axes)
            product *= mean_of(square, area.middle[axis], area.across[axis], area.down[axis]);
        return product;
    }
    const AreaPart whole(area);
    const auto each = [](const AreaPart& part, int axis, const auto& visit) {
        if (part.count < 3) return;
        const auto [low, high] = part.range(axis);
        for (double k = std::floor(low); k <= std::floor(high); ++k) visit(part.between(axis, k, k + 1), k);
    };
    double sum = 0;
    each(whole, first, [&](const AreaPart& slab, double i) {
        each(slab, second, [&](const AreaPart& part, double j) {
            const double own = part.integral(square, last, area.across[last], area.down[last]);
            sum += std::fmod(std::abs(i + j), 2) == 0 ? own : -own;
        });
    });
    return sum;
}

/// Returns the share of bricks; the rest is mortar.
double share_of_bricks(const PatternArea& area, const DVec3& mortar) {
    const Course courses[3] = {{mortar.x}, {mortar.y}, {mortar.z}};
    const int fewer = extent(area, 0) < extent(area, 2) ? 0 : 2, last = 2 - fewer;
    const auto mean = [&](int axis, double shift = 0) {
        return courses[axis].mean +
               mean_of(courses[axis], area.middle[axis] + shift, area.across[axis], area.down[axis]);
    };
    if (is_far(area)) return courses[0].mean * courses[1].mean * courses[2].mean;
    if (extent(area, 1) > most_pieces)  // as many layers of one shift as of the other
        return mean(1) * (mean(0) * mean(2, .5) + mean(0, .5) * mean(2)) / 2;
    const AreaPart whole(area);
    const auto [low, high] = whole.range(1);
    double sum = 0;
    for (double k = std::floor(low); k <= std::floor(high); ++k) {
        AreaPart layer = whole.between(1, k + mortar.y, k + 1);
        if (layer.count < 3) continue;
        const double shift = std::fmod(std::abs(k), 2) == 1 ? .5 : 0, shifts[3] = {shift, 0, .5 - shift};
        if (extent(area, fewer) > most_pieces) {
            sum += layer.area() * mean(0, shifts[0]) * mean(2, shifts[2]);
            continue;
        }
        for (int c = 0; c < layer.count; ++c) layer.corners[c].at += DVec3(shifts[0], 0, shifts[2]);
        const auto [least, most] = layer.range(fewer);
        for (double i = std::floor(least); i <= std::floor(most); ++i)
            sum += layer.between(fewer, i + mortar[fewer], i + 1)
                       .integral(courses[last], last, area.across[last], area.down[last]);
    }
    return sum;
}

/// How the argument of a map becomes a value from 0 to 1.
enum class Fold {
    repeat,  // from 0 to 1, over and over
    wave,    // up to 1 and down again within a length of 1
    limit,   // smaller ones are 0 and larger ones 1
};

/// The colours of a map by its argument; of periodic ones less their mean.
template <class T>
class MapFunction {
  public:
    MapFunction(const ColorStopKernel<T>* own, int own_count, Fold own_fold)
        : stops(own), count(own_count), fold(own_fold) {
        if (fold == Fold::limit) return;
        if (fold == Fold::wave) half = sums_of_map(1);
        const Sums period = sums(1);
        mean = period.first, middle = period.second - .5 * mean;
    }
    DVec3 mean{0};

    DVec3 value(double x) const {
        x = fold == Fold::limit ? std::clamp(x, 0., 1.) : fraction(x);
        if (fold == Fold::wave) x = 1 - std::abs(2 * x - 1);
        DVec3 color = color_of(0);
        for (int i = 1; i < count && x > at(i - 1); ++i) {
            const double share = at(i) > at(i - 1) ? std::min((x - at(i - 1)) / (at(i) - at(i - 1)), 1.) : 1;
            color = color_of(i - 1) + share * (color_of(i) - color_of(i - 1));
        }
        return color - mean;
    }
    DVec3 integral(double x) const {
        if (fold != Fold::limit) x = fraction(x);
        const Sums own = sums(x);
        return own.first - x * mean - middle;
    }
    DVec3 second(double x) const {
        if (fold != Fold::limit) x = fraction(x);
        const Sums own = sums(x);
        return own.second - x * x / 2 * mean - x * middle;
    }
    /// Returns whether a colour jumps, or a value begins anew, for an argument in this range.
    bool has_jump(double low, double high) const { return has_stop(low, high, true); }
    /// Returns whether colours change linearly in this range.
    bool is_linear(double low, double high) const { return !has_stop(low, high, false); }

  private:
    bool has_stop(double low, double high, bool jumps) const {
        const auto within = [&](double place) {
            return fold == Fold::limit ? low < place && place < high
                                       : std::floor(low - place) != std::floor(high - place);
        };
        if (fold == Fold::repeat && within(0)) return true;
        if (fold == Fold::wave && !jumps && (within(0) || within(.5))) return true;
        for (int i = 0; i < count; ++i) {
            if (jumps && (i == 0 || at(i) > at(i - 1))) continue;
            if (fold == Fold::wave ? within(at(i) / 2) || within(1 - at(i) / 2) : within(at(i))) return true;
        }
        return false;
    }

    /// The integral of the colours from 0 on, and the integral of that.
    struct Sums {
        DVec3 first{0}, second{0};
    };
    double at(int i) const { return double(stops[i].at); }
    DVec3 color_of(int i) const {
        return {double(stops[i].color.x), double(stops[i].color.y), double(stops[i].color.z)};
    }
    Sums sums(double x) const {
        if (fold != Fold::wave) return sums_of_map(x);
        if (x <= .5) {
            const Sums own = sums_of_map(2 * x);
            return {.5 * own.first, .25 * own.second};
        }
        const Sums rest = sums_of_map(2 - 2 * x);
        return {half.first - .5 * rest.first, (x - .5) * half.first + .25 * rest.second};
    }
    Sums sums_of_map(double x) const {
        if (x < 0) return {x * color_of(0), x * x / 2 * color_of(0)};
        Sums sums;
        double since = 0;
        const auto add = [&](double until, const DVec3& from, const DVec3& to) {
            const double full = until - since, way = std::min(until, x) - since;
            if (!(way > 0)) return;
            const DVec3 slope = (1 / full) * (to - from);
            sums.second += way * sums.first + way * way / 2 * from + way * way * way / 6 * slope;
            sums.first += way * from + way * way / 2 * slope;
            since = until;
        };
        add(at(0), color_of(0), color_of(0));
        for (int i = 1; i < count && since < x; ++i) add(at(i), color_of(i - 1), color_of(i));
        add(std::max(1., x), color_of(count - 1), color_of(count - 1));
        return sums;
    }

    const ColorStopKernel<T>* stops;
    int count;
    Fold fold;
    DVec3 middle{0};  // of the integral
    Sums half;        // the integrals over the way up of a wave
};

/// Finds the values of a solid pattern over an area.
ValueGrid values_over(const SolidPattern& solid, const SolidDetails& details, const PatternArea& area, double share,
                      SmoothedValues find) {
    double largest = 0, finest = 0;
    const std::span sizes(details.sizes.data(), static_cast<std::size_t>(details.count));
    for (const SolidDetail& size : sizes) largest = std::max(largest, size.deviation);
    for (const SolidDetail& size : sizes)
        if (size.deviation >= least_strength * largest || size.deviation == 0) finest = std::max(finest, size.fineness);
    const double lengths[2] = {length(area.across), length(area.down)};
    const auto steps_along = [&](double own, double other) {
        const double most = own < other && !details.jumps ? ValueGrid::most_steps / 2 : ValueGrid::most_steps;
        const double wanted = details.jumps ? most : std::min(steps_per_cell * finest * own, most);
        return static_cast<int>(std::max(std::ceil(share * wanted), 1.));
    };
    if (is_far(area)) return {.columns = 1, .rows = 1};
    if (!details.known) {
        ValueGrid point{.columns = 1, .rows = 1, .loose = 1, .cells = HUGE_VAL};
        std::fill_n(point.values, 4, smoothed_value(solid, area.middle, 0));
        return point;
    }
    ValueGrid grid{.columns = steps_along(lengths[0], lengths[1]), .rows = steps_along(lengths[1], lengths[0])};
    grid.cells = finest * (lengths[0] + lengths[1]);
    // Values that jump are not linear in between: all points count as they are.
    const double step = details.jumps ? 0 : std::max(lengths[0] / grid.columns, lengths[1] / grid.rows);
    double squares = 0, missed = 0, all = 0;
    for (const auto& [fineness, deviation] : sizes) {
        const double own = fineness * step, lost = deviation * (1 - lattice::left_of_noise(own));
        squares += lost * lost;
        double varies = deviation * deviation;
        for (const double length : lengths) varies /= std::max(fineness * length, 1.);
        const double share = std::min(own, 1.);
        missed += varies * share * share, all += varies;
    }
    grid.spread = std::sqrt(squares);
    grid.loose = details.jumps ? of_points : all > 0 ? std::sqrt(missed / all) : std::min(finest * step, 1.);
    alignas(64) double at[3][ValueGrid::room] = {};
    int n = 0;
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i, ++n) {
            const double x = double(i) / grid.columns - .5, y = double(j) / grid.rows - .5;
            for (int c = 0; c < 3; ++c) at[c][n] = area.middle[c] + x * area.across[c] + y * area.down[c];
        }
    find(solid, at, n, step, grid.values);
    return grid;
}

/// Do values go through a wave that is not linear before colours are looked up?
template <class T>
bool has_wave(const PatternKernel<T>& pattern, const SolidDetails* details) {
    return details && details->known && pattern.solid->wave > 1;
}
/// Are values 0 everywhere beyond a distance?
bool ends_somewhere(Solid solid) {
    return solid == Solid::boxed || solid == Solid::cylindrical || solid == Solid::planar || solid == Solid::spherical;
}
/// Returns what a wave makes of a value, by a table; off by up to .00005.
double tabled_wave(const SolidPattern& solid, double value) {
    if (!(std::abs(value) < furthest)) return 0;
    constexpr int steps = 512;
    static const auto waves = [] {
        std::array<std::array<double, steps + 1>, 6> all;
        for (std::size_t k = 0; k < all.size(); ++k)
            for (std::size_t i = 0; i <= steps; ++i)
                all[k][i] = waved(SolidPattern{.wave = static_cast<double>(k)}, static_cast<double>(i) / steps);
        return all;
    }();
    const double at = steps * fraction(value / 1.00001), whole = std::floor(at);  // where waved() repeats
    const double* const wave = waves[static_cast<std::size_t>(std::min(solid.wave, 5.))].data();
    const auto i = static_cast<std::size_t>(std::clamp(whole, 0., steps - 1.));
    return wave[i] + (at - whole) * (wave[i + 1] - wave[i]);
}
/// Returns the least and the largest value that a wave makes of values from `low` to `high`.
std::pair<double, double> range_of_wave(const SolidPattern& solid, double low, double high) {
    // Sines turn at a quarter and at three quarters, scallops at halves, and cubic waves begin anew at whole numbers.
    const double first = solid.wave >= 2 && solid.wave < 3 ? .25 : 0, apart = solid.wave < 4 ? .5 : 1;
    const double last_turn = std::floor((high - first) / apart), turns = last_turn - std::floor((low - first) / apart);
    if (!(turns < 2) || (turns > 0 && solid.wave >= 4)) return {0, 1};
    const double ends[2] = {tabled_wave(solid, low), tabled_wave(solid, high)};
    const double turn = turns > 0 ? std::round(tabled_wave(solid, first + apart * last_turn)) : ends[0];
    return {std::min({ends[0], ends[1], turn}), std::max({ends[0], ends[1], turn})};
}
/// Returns the mean of the colours of values that change by a and by b along the sides of an area, after their wave. A
/// short part of a wave is taken for straight; the mean of others is that of `most` values (a power of two), spread
/// evenly in both directions and alike on both sides.
template <class T>
DVec3 mean_of_wave(const SolidPattern& solid, const MapFunction<T>& map, double x, double a, double b, int most) {
    const double length = std::abs(a) + b, low = x - length / 2, high = x + length / 2;
    if (length < .125 && (solid.wave < 4 || std::floor(low) == std::floor(high))) {
        const double middle = tabled_wave(solid, x), rise = tabled_wave(solid, high) - tabled_wave(solid, low);
        const double reach = std::abs(rise) / 2, slope = length < shortest ? 0 : rise / length;
        return map.is_linear(middle - reach, middle + reach) ? map.value(middle)
                                                             : mean_of(map, middle, slope * a, slope * b);
    }
    // Values of most kinds are between 0 and 1 before they repeat: a box around them ends there.
    const bool beyond = solid.solid == Solid::marble || solid.solid == Solid::wood || goes_on(solid);
    const double end = solid.phase + solid.frequency;
    const double first = beyond ? -HUGE_VAL : std::min(solid.phase, end);
    const double last = beyond || solid.frequency == 0 ? HUGE_VAL : std::max(solid.phase, end);
    DVec3 sum(0);
    for (int i = 0; i < most; ++i) {
        const double along = (i + .5) / most - .5, down = ((3 * i + 1) % most + .5) / most - .5;
        sum += map.value(tabled_wave(solid, std::clamp(x + a * along + b * down, first, last)));
    }
    return (1. / most) * sum;
}

template <class T>
Fold fold_of(const PatternKernel<T>& pattern, const SolidDetails* details) {
    using Repeat = SolidDetails::Repeat;
    if (has_wave(pattern, details)) return Fold::limit;
    if (details)
        return details->repeat == Repeat::ramp    ? Fold::repeat
               : details->repeat == Repeat::never ? Fold::limit
                                                  : Fold::wave;
    return pattern.form == PatternForm::noise ? Fold::limit : Fold::wave;
}

/// Calls mean(map) for maps in which one stop is 1 and all others are 0, three at a time, for the mean of each.
template <class T, class Mean>
void weigh(const ColorStopKernel<T>* stops, int count, Fold fold, double* weights, const Mean& mean) {
    std::array<ColorStopKernel<T>, most_weighed> own;
    std::copy_n(stops, count, own.begin());
    for (int first = 0; first < count; first += 3) {
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c) own[i].color[c] = i == first + c ? T(1) : T(0);
        const DVec3 shares = mean(MapFunction<T>(own.data(), count, fold));
        for (int c = 0; c < 3 && first + c < count; ++c) weights[first + c] = std::clamp(shares[c], 0., 1.);
    }
}

/// Finds each second value of a row from those before and after it, by polynomials of degree 3 and, at the ends, 2.
void fill_between(double* values, int stride, int last) {
    const auto at = [&](int k) { return values[k * stride]; };
    for (int i = 1; i < last; i += 2)
        values[i * stride] = i == 1          ? (3 * at(0) + 6 * at(2) - at(4)) / 8
                             : i == last - 1 ? (3 * at(last) + 6 * at(last - 2) - at(last - 4)) / 8
                                             : (9 * (at(i - 1) + at(i + 1)) - at(i - 3) - at(i + 3)) / 16;
}
/// Returns a grid with twice the columns and twice the rows, each if they are few enough for that and at least two.
ValueGrid refined(const ValueGrid& grid) {
    const auto finer = [](int steps) { return steps > 1 && steps <= ValueGrid::most_steps / 2 ? 2 : 1; };
    const int x = finer(grid.columns), y = finer(grid.rows);
    ValueGrid all = grid;
    all.columns *= x, all.rows *= y;
    const int stride = all.columns + 1;
    for (int j = 0, n = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i) all.values[y * j * stride + x * i] = grid.values[n++];
    for (int j = 0; j <= all.rows && x == 2; j += y) fill_between(all.values + j * stride, 1, all.columns);
    for (int i = 0; i <= all.columns && y == 2; ++i) fill_between(all.values + i, stride, all.rows);
    return all;
}

template <class T>
PatternMean mean_of_grid(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops, const ValueGrid& given,
                         const SolidDetails* details, double* weights) {
    ValueGrid grid = given;
    const Fold fold = fold_of(pattern, details);
    const bool wave = has_wave(pattern, details), may_end = details && ends_somewhere(pattern.solid->solid);
    const double spread = grid.spread * std::sqrt(12.);  // the width of a box of this deviation
    struct Piece {
        double x, a, b;
        const double *top, *bottom;
    };
    const auto each_piece = [&](const auto& visit) {
        for (int j = 0; j < grid.rows; ++j)
            for (int i = 0; i < grid.columns; ++i) {
                const double* const top = &grid.values[j * (grid.columns + 1) + i];
                const double* const bottom = top + grid.columns + 1;
                const bool over = may_end && top[0] == top[1] && top[0] == bottom[0] && top[0] == bottom[1];
                visit(Piece{(top[0] + top[1] + bottom[0] + bottom[1]) / 4,
                            (top[1] - top[0] + bottom[1] - bottom[0]) / 2,
                            length_of((bottom[0] - top[0] + bottom[1] - top[1]) / 2, over ? 0 : spread), top, bottom});
            }
    };
    const auto mean_by = [&](const MapFunction<T>& map) {
        DVec3 sum(0);
        each_piece([&](const Piece& own) {
            const auto& [x, a, b, top, bottom] = own;
            const double reach = (std::abs(a) + b) / 2;
            const auto at = [&](double v) { return map.value(wave ? waved(*pattern.solid, v) : v); };
            if (details && details->jumps)
                sum += .25 * (at(top[0]) + at(top[1]) + at(bottom[0]) + at(bottom[1]));
            else if (wave)
                sum += mean_of_wave(*pattern.solid, map, x, a, b, grid.rows * grid.columns < 8 ? 16 : 8);
            else
                sum += map.is_linear(x - reach, x + reach) ? map.value(x) : mean_of(map, x, a, b);
        });
        return map.mean + 1. / (grid.rows * grid.columns) * sum;
    };
    const MapFunction<T> map(stops, pattern.stops, fold);
    double low = HUGE_VAL, high = -HUGE_VAL;
    each_piece([&](const Piece& own) {
        const double reach = 1.5 * (std::abs(own.a) + own.b);
        low = std::min(low, own.x - reach), high = std::max(high, own.x + reach);
    });
    const auto [least, most] = wave ? range_of_wave(*pattern.solid, low, high) : std::pair(low, high);
    const bool has_jump = map.has_jump(least, most);
    const bool detailed = grid.cells > finely || most - least > .25 || has_jump;
    if (has_jump && !(details && details->jumps)) grid = refined(given);
    const DVec3 color = mean_by(map);
    const bool known = std::abs(color.x) + std::abs(color.y) + std::abs(color.z) < furthest;
    if (weights) weigh(stops, pattern.stops, fold, weights, mean_by);
    return {known ? max(color, DVec3(0)) : map.mean + map.value(0), detailed, std::clamp(grid.loose, exact, 1.)};
}

}  // namespace

void values_one_by_one(const SolidPattern& solid, const double (&at)[3][ValueGrid::room], int count, double step,
                       double* values) {
    for (int i = 0; i < count; ++i) values[i] = smoothed_value(solid, {at[0][i], at[1][i], at[2][i]}, step);
}

template <class T>
double share_of_steps(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops) {
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (int i = 0; i < pattern.stops; ++i)
            low = std::min(low, double(stops[i].color[c])), high = std::max(high, double(stops[i].color[c]));
        most = std::max(most, high - low);
    }
    return pattern.nests ? 1 : most / full_contrast;
}

template <class T>
PatternMean mean_over(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops, const PatternArea& area,
                      double* weights, SmoothedValues find) {
    const auto mixed = [&](double share) {
        share = std::clamp(share, 0., 1.);  // rounding may lead out of this
        if (weights) weights[0] = 1 - share, weights[1] = share;
        DVec3 color;
        for (int c = 0; c < 3; ++c)
            color[c] = double(stops[0].color[c]) + share * (double(stops[1].color[c]) - double(stops[0].color[c]));
        return color;
    };
    const auto any_border = [&] { return has_border(area, 0) || has_border(area, 1) || has_border(area, 2); };
    switch (pattern.form) {
        case PatternForm::checker:
            return {mixed((1 - mean_of_checks(area)) / 2), any_border(), exact};
        case PatternForm::brick: {
            const DVec3 mortar(double(pattern.mortar.x), double(pattern.mortar.y), double(pattern.mortar.z));
            bool detailed = false;
            for (int c = 0; c < 3; ++c)
                for (const double border : {0., mortar[c]})
                    for (const double shift : {0., c == 1 ? 0. : .5})
                        detailed = detailed || has_border(area, c, shift - border);
            return {mixed(share_of_bricks(area, mortar)), detailed, exact};
        }
        case PatternForm::solid: {
            const SolidDetails details = details_of(*pattern.solid);
            const double share = std::min(1., area.weight * share_of_steps(pattern, stops));
            return mean_of_grid(pattern, stops, values_over(*pattern.solid, details, area, share, find), &details,
                                weights);
        }
        default: {
            const MapFunction<T> map(stops, pattern.stops, Fold::repeat);
            const double x = area.middle.x - double(pattern.border), reach = 1.5 * extent(area, 0);
            const bool detailed = reach > .25 || map.has_jump(x - reach, x + reach);
            const auto mean_by = [&](const MapFunction<T>& own) {
                return is_far(area) ? own.mean : own.mean + mean_of(own, x, area.across.x, area.down.x);
            };
            if (weights) weigh(stops, pattern.stops, Fold::repeat, weights, mean_by);
            return {max(mean_by(map), DVec3(0)), detailed || is_far(area), exact};
        }
    }
}

template <class T>
PatternMean mean_over(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops, const ValueGrid& grid,
                      double* weights) {
    return mean_of_grid(pattern, stops, grid, nullptr, weights);
}

template double share_of_steps(const PatternKernel<float>&, const ColorStopKernel<float>*);
template double share_of_steps(const PatternKernel<double>&, const ColorStopKernel<double>*);
template double share_of_steps(const PatternKernel<long double>&, const ColorStopKernel<long double>*);
template PatternMean mean_over(const PatternKernel<float>&, const ColorStopKernel<float>*, const PatternArea&, double*,
                               SmoothedValues);
template PatternMean mean_over(const PatternKernel<double>&, const ColorStopKernel<double>*, const PatternArea&,
                               double*, SmoothedValues);
template PatternMean mean_over(const PatternKernel<long double>&, const ColorStopKernel<long double>*,
                               const PatternArea&, double*, SmoothedValues);
template PatternMean mean_over(const PatternKernel<float>&, const ColorStopKernel<float>*, const ValueGrid&, double*);
template PatternMean mean_over(const PatternKernel<double>&, const ColorStopKernel<double>*, const ValueGrid&, double*);
template PatternMean mean_over(const PatternKernel<long double>&, const ColorStopKernel<long double>*,
                               const ValueGrid&, double*);

}  // namespace strahl
