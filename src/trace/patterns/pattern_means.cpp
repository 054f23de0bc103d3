#include "trace/patterns/pattern_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

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
/// (tests/bench/tried.md).
constexpr double exact = .03;
/// How loose means of points on a grid count.
constexpr double of_points = .3;
/// Grids have fewer steps, in proportion, where the difference of colours times the weight of a ray is less than this:
/// the error of a mean is about that over the root of the number of values (tests/bench/tried.md).
constexpr double full_contrast = .5;
/// Values so many cells apart are coarse: straight lines between them would deviate too little.
constexpr double coarse_step = .25;
/// Values of solid patterns repeat at this distance: those of exactly 1 are still at the end of the colours.
constexpr double period = 1.00001;
/// Noise is detailed from so many of its finest cells on.
constexpr double finely = .25;

double fraction(double x) { return x - std::floor(x); }

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

/// An area whose sides shrink by this share of their length is one parallelogram; others are divided into parts that
/// do. An edge in the middle of a side is off by a quarter of that at most, in sides of the part.
constexpr double even_enough = .01;

/// Returns the mean of what mean(part) returns for parts of an area that are nearly parallelograms.
template <class Mean>
auto mean_of_parts(const PatternArea& area, const Mean& mean) {
    constexpr double most_parts = 8;
    const auto parts_along = [&](int i) {
        return static_cast<int>(std::min(std::ceil(std::sqrt(std::abs(area.shrink[i]) / even_enough)), most_parts));
    };
    const int columns = std::max(parts_along(0), 1), rows = std::max(parts_along(1), 1);
    if (columns == 1 && rows == 1) return mean(area);
    const double width = 1. / columns, height = 1. / rows;
    decltype(mean(area)) sum(0);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            sum += width * height * mean(area.part((i + .5) * width - .5, (j + .5) * height - .5, width, height));
    return sum;
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
        for (const int axis : axes) product *= mean_of(square, area.middle[axis], area.across[axis], area.down[axis]);
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

/// How the argument of a map becomes a value from 0 to 1: smaller ones count as 0 and larger ones as 1, or it repeats
/// as the waves of solid patterns do.
enum class Fold { limit, ramp, triangle, sine, scallop, cubic };

/// The colours of a map by its argument, of periodic ones less their mean: linear between nodes, which are its stops
/// wherever a wave comes to them, and points of the wave in between.
class MapFunction {
  public:
    template <class T>
    MapFunction(const ColorStopKernel<T>* stops, int count, Fold own_fold) : fold(own_fold) {
        for (int i = 0; i < count; ++i)
            nodes.push_back(
                {double(stops[i].at), {double(stops[i].color.x), double(stops[i].color.y), double(stops[i].color.z)}});
        add_up();
        if (fold > Fold::ramp) follow_wave(), add_up();
        if (fold == Fold::limit) return;
        const Sums whole = sums(1);
        mean = whole.first, middle = whole.second - .5 * mean;
    }
    DVec3 mean{0};

    DVec3 value(double x) const {
        if (fold != Fold::limit) x = fraction(x);
        const Node* const node = before(x);
        return (node ? node->color + (x - node->at) * node->slope : nodes[0].color) - mean;
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
    bool has_jump(double low, double high) const { return has_node(low, high, true); }
    /// Returns whether colours change linearly in this range.
    bool is_linear(double low, double high) const { return !has_node(low, high, false); }

  private:
    /// The integral of the colours from 0 on, and the integral of that.
    struct Sums {
        DVec3 first{0}, second{0};
    };
    struct Node {
        double at;
        DVec3 color, slope{0}, first{0}, second{0};
        Sums sums(double x) const {
            return {first + x * (color + x / 2 * slope), second + x * (first + x / 2 * (color + x / 3 * slope))};
        }
    };
    static bool jumps_between(const Node& a, const Node& b) { return a.at == b.at && a.color != b.color; }
    const Node* before(double x) const {
        const auto next = std::ranges::lower_bound(nodes, x, {}, &Node::at);
        return next == nodes.begin() ? nullptr : &next[-1];
    }
    Sums sums(double x) const {
        const Node* const node = before(x);
        return node ? node->sums(x - node->at) : Sums{x * nodes[0].color, x * x / 2 * nodes[0].color};
    }
    bool has_node(double low, double high, bool jumps) const {
        const auto within = [&](double place) {
            return fold == Fold::limit ? low < place && place < high
                                       : std::floor(low - place) != std::floor(high - place);
        };
        if ((fold == Fold::ramp || fold == Fold::cubic) && within(0)) return true;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if ((!jumps || (i > 0 && jumps_between(nodes[i - 1], nodes[i]))) && within(nodes[i].at)) return true;
        return false;
    }

    /// Sets what follows from the places and colours of the nodes.
    void add_up() {
        DVec3 first = nodes[0].at * nodes[0].color, second = nodes[0].at / 2 * first;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            Node& node = nodes[i];
            const double way = i + 1 < nodes.size() ? nodes[i + 1].at - node.at : 0;
            node.slope = way > 0 ? (1 / way) * (nodes[i + 1].color - node.color) : DVec3(0);
            node.first = first, node.second = second;
            const Sums next = node.sums(way);
            first = next.first, second = next.second;
        }
    }
    /// Replaces the map by that of the argument of a wave, which goes up and down along these parts of its length.
    void follow_wave() {
        constexpr double turn = 2 * std::numbers::pi;
        MapFunction map = *this;
        map.fold = Fold::limit;
        const auto wave = [&](double x) {
            return fold == Fold::triangle  ? 1 - std::abs(2 * x - 1)
                   : fold == Fold::sine    ? (1 + std::sin(turn * x)) / 2
                   : fold == Fold::scallop ? std::abs(std::sin(turn / 2 * x))
                                           : x * x * (3 - 2 * x);
        };
        const auto place = [&](double v, bool up, double low) {
            switch (fold) {
                case Fold::triangle:
                    return up ? v / 2 : 1 - v / 2;
                case Fold::sine: {
                    const double off = std::asin(2 * v - 1) / turn;
                    return up ? off + std::round(low) : .5 - off;
                }
                case Fold::scallop:
                    return up ? 2 * std::asin(v) / turn : 1 - 2 * std::asin(v) / turn;
                default:
                    return .5 - std::sin(std::asin(1 - 2 * v) / 3);
            }
        };
        nodes.clear();
        const auto follow = [&](double low, double high, bool up) {
            std::vector<Node> own;
            for (std::size_t i = 0; i < map.nodes.size(); ++i) {
                const Node& stop = map.nodes[up ? i : map.nodes.size() - 1 - i];
                const double x = place(std::clamp(stop.at, 0., 1.), up, low);
                if (x >= low && x <= high) own.push_back({x, stop.color});
            }
            const auto known = [&](double x) {
                return std::ranges::any_of(own, [&](const Node& node) { return std::abs(node.at - x) < 1e-6; });
            };
            const int parts = fold == Fold::triangle ? 1 : static_cast<int>(std::ceil(48 * (high - low)));
            std::vector<Node> between;
            for (int i = 0; i <= parts; ++i) {
                const double x = low + i * (high - low) / parts;
                if (!known(x)) between.push_back({x, map.value(wave(x))});
            }
            std::ranges::merge(own, between, std::back_inserter(nodes), {}, &Node::at, &Node::at);
        };
        switch (fold) {
            case Fold::sine:
                follow(0, .25, true), follow(.25, .75, false), follow(.75, 1, true);
                break;
            case Fold::cubic:
                follow(0, 1, true);
                break;
            default:
                follow(0, .5, true), follow(.5, 1, false);
        }
    }

    Fold fold;
    std::vector<Node> nodes;
    DVec3 middle{0};  // of the integral
};

/// Returns the map of these stops. Each thread keeps the last ones, since making one takes as long as a mean; it stays
/// until the next call.
template <class T>
const MapFunction& kept_map(const ColorStopKernel<T>* stops, int count, Fold fold) {
    struct KeptMap {
        Fold fold;
        std::vector<std::array<double, 4>> stops;
        MapFunction map;
    };
    constexpr std::size_t most_kept = 16;
    static thread_local std::vector<KeptMap> all;
    const auto numbers = [](const ColorStopKernel<T>& stop) {
        return std::array{double(stop.at), double(stop.color.x), double(stop.color.y), double(stop.color.z)};
    };
    for (const KeptMap& own : all)
        if (own.fold == fold && own.stops.size() == static_cast<std::size_t>(count) &&
            std::equal(own.stops.begin(), own.stops.end(), stops,
                       [&](const auto& kept, const auto& stop) { return kept == numbers(stop); }))
            return own.map;
    if (all.size() == most_kept) all.clear();
    KeptMap& made = all.emplace_back(KeptMap{fold, {}, {stops, count, fold}});
    std::transform(stops, stops + count, std::back_inserter(made.stops), numbers);
    return made.map;
}

/// Values of a solid pattern that is alike everywhere, or everywhere in a plane across an axis.
struct KnownValues {
    SolidPattern solid;
    int axis;
    double place;
    ValuesAnywhere values;
};
/// Returns the values that the plane of an area shows in equal shares, where it lies across an axis, and else those of
/// space: there, what is seen of a floor at a whole number is not what is seen of others. They are the means of 8 each
/// of values at points spread evenly (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018), and
/// each thread keeps those that it has found.
const ValuesAnywhere& values_anywhere(const SolidPattern& solid, const SolidDetails& details, const PatternArea& area,
                                      SmoothedValues find) {
    constexpr std::size_t most_known = 64;
    static thread_local std::vector<std::unique_ptr<KnownValues>> known;
    const double longest = std::max({extent(area, 0), extent(area, 1), extent(area, 2)});
    int axis = -1;
    for (int c = 0; c < 3; ++c)
        if (extent(area, c) < shortest * longest) axis = c;
    const double place = axis < 0 ? 0 : std::round(area.middle[axis] * 4096) / 4096;
    for (const auto& own : known)
        if (own->axis == axis && own->place == place && own->solid == solid) return own->values;
    if (known.size() >= most_known) known.clear();
    constexpr int in_each = 8, count = most_anywhere * in_each;
    const double across = 64 / details.sizes[0].fineness;
    std::array<double, count> all;
    for (int first = 0; first < count; first += ValueGrid::room) {
        alignas(64) double at[3][ValueGrid::room], values[ValueGrid::room];
        for (int i = 0; i < ValueGrid::room; ++i)
            for (int c = 0; c < 3; ++c) {
                constexpr double steps[3] = {.8191725133961645, .6710436067037893, .5497004779019703};
                at[c][i] = c == axis ? place : across * fraction((first + i + .5) * steps[c]);
            }
        find(solid, at, std::min(ValueGrid::room, count - first), 0, values);
        std::copy_n(values, std::min(ValueGrid::room, count - first), all.begin() + first);
    }
    for (double& value : all)
        if (details.repeat != SolidDetails::Repeat::never) value /= period;
    std::ranges::sort(all);
    auto own = std::make_unique<KnownValues>(KnownValues{solid, axis, place, {}});
    for (int i = 0; i < count; ++i) own->values[static_cast<std::size_t>(i / in_each)] += all[i] / in_each;
    return known.emplace_back(std::move(own))->values;
}

/// Finds the values of a solid pattern over an area.
ValueGrid values_over(const SolidPattern& solid, const SolidDetails& details, const PatternArea& area, double share,
                      int least, SmoothedValues find) {
    double largest = 0, finest = 0;
    const std::span sizes(details.sizes.data(), static_cast<std::size_t>(details.count));
    for (const SolidDetail& size : sizes) largest = std::max(largest, size.deviation);
    for (const SolidDetail& size : sizes)
        if (size.deviation >= least_strength * largest || size.deviation == 0) finest = std::max(finest, size.fineness);
    const double lengths[2] = {length(area.across), length(area.down)};
    const double dense = steps_per_cell * finest * std::max(std::fabs(solid.frequency), 1.);
    const auto steps_along = [&](double own, double other) {
        const bool fewer = own < other && !details.jumps;
        const double most = fewer ? ValueGrid::most_steps / 2 : ValueGrid::most_steps;
        const double wanted = details.jumps ? most : std::min(dense * own, most);
        return static_cast<int>(std::max<double>(std::ceil(share * wanted), least));
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
    const double between = details.jumps ? 0 : 1, step_across = between * lengths[0] / grid.columns;
    const double step_down = between * lengths[1] / grid.rows, step = std::max(step_across, step_down);
    grid.coarse = details.jumps || (details.even && sizes[0].fineness * step > coarse_step);
    double squares = 0, missed = 0, all = 0, unseen = 0, total = 0;
    const double true_step = std::max(lengths[0] / grid.columns, lengths[1] / grid.rows);
    for (const auto& [fineness, deviation] : sizes) {
        const double own = fineness * step, left = lattice::left_of_noise(own);
        if (details.even && all == 0)
            grid.lost = 1 - left * left;
        else
            squares += deviation * deviation * lost_of_octave(left, fineness * step_across, fineness * step_down);
        double cells = 1;
        for (const double length : lengths) cells *= std::max(fineness * length, 1.);
        const double varies = deviation * deviation / cells, share = std::min(own, 1.);
        missed += varies * share * share, all += varies;
        const double strength = std::max(deviation * deviation, 1e-9);  // counts where all are 0
        unseen += strength * unseen_of_cell(fineness * true_step, details.jumps) / cells, total += strength;
    }
    grid.unseen = total > 0 ? unseen / total : 0;
    if (grid.lost > 0) grid.anywhere = &values_anywhere(solid, details, area, find);
    if (grid.lost == 1) grid.columns = grid.rows = 1;
    grid.spread = std::sqrt(squares);
    grid.loose = details.jumps ? of_points : all > 0 ? std::sqrt(missed / all) : std::min(finest * step, 1.);
    alignas(64) double at[3][ValueGrid::room] = {};
    int n = 0;
    for (int j = 0; j <= grid.rows; ++j)
        for (int i = 0; i <= grid.columns; ++i, ++n) {
            const double x = double(i) / grid.columns - .5, y = double(j) / grid.rows - .5;
            const DVec3 point = area.at(x, y);
            for (int c = 0; c < 3; ++c) at[c][n] = point[c];
        }
    find(solid, at, n, step, grid.values);
    for (int i = 0; i < n && details.repeat != SolidDetails::Repeat::never; ++i) grid.values[i] /= period;
    return grid;
}

/// Are values 0 everywhere beyond a distance?
bool ends_somewhere(Solid solid) {
    return solid == Solid::boxed || solid == Solid::cylindrical || solid == Solid::planar || solid == Solid::spherical;
}
template <class T>
Fold fold_of(const PatternKernel<T>& pattern, const SolidDetails* details) {
    if (!details) return pattern.form == PatternForm::noise ? Fold::limit : Fold::triangle;
    if (details->repeat == SolidDetails::Repeat::never) return Fold::limit;
    const double wave = std::floor(pattern.solid->wave);
    return wave < 5 ? static_cast<Fold>(static_cast<int>(Fold::ramp) + static_cast<int>(wave)) : Fold::ramp;
}

/// Calls mean(map) for maps in which one stop is 1 and all others are 0, three at a time, for the mean of each.
template <class T, class Mean>
void weigh(const ColorStopKernel<T>* stops, int count, Fold fold, double* weights, const Mean& mean) {
    std::array<ColorStopKernel<T>, most_weighed> own;
    std::copy_n(stops, count, own.begin());
    for (int first = 0; first < count; first += 3) {
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c) own[i].color[c] = i == first + c ? T(1) : T(0);
        const DVec3 shares = mean(MapFunction(own.data(), count, fold));
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

/// Returns the sides of a box with as much more of the sum of their squares, as even as they can be: sums of detail
/// have few values far from their mean.
std::pair<double, double> spread_out(double a, double b, double more) {
    const double even = (a * a + b * b + more) / 2, longer = std::max({a * a, b * b, even});
    const double shorter = std::max(2 * even - longer, 0.);
    return {std::copysign(std::sqrt(longer), a), std::sqrt(shorter)};
}

template <class T>
PatternMean mean_of_grid(const PatternKernel<T>& pattern, const ColorStopKernel<T>* stops, const ValueGrid& given,
                         const SolidDetails* details, double* weights) {
    ValueGrid grid = given;
    const Fold fold = fold_of(pattern, details);
    const bool may_end = details && ends_somewhere(pattern.solid->solid);
    /// Visits parts of the area with their shares of it, values in their middles, and how much these change across.
    const auto each_part = [&](const auto& visit) {
        // A half of the variance is that of three places with the kurtosis of a bell curve: with the boxes 2.85.
        const auto visit_spread = [&](double share, double x, double a, double b, double deviation) {
            if (deviation == 0) return visit(share, x, std::pair(a, std::abs(b)));
            const double variance = deviation * deviation, aside = std::sqrt(1.5 * variance);
            const auto sides = spread_out(a, b, 6 * variance);  // a box with a side of 1 has a twelfth of its square
            visit(2 * share / 3, x, sides);
            for (const double other : {x - aside, x + aside}) visit(share / 6, other, sides);
        };
        const int stride = grid.columns + 1, count = grid.rows * grid.columns;
        const auto at = [&](int i, int j) { return grid.values[j * stride + i]; };
        if (!grid.coarse) {
            for (int j = 0; j < grid.rows; ++j)
                for (int i = 0; i < grid.columns; ++i) {
                    const double top[2] = {at(i, j), at(i + 1, j)}, bottom[2] = {at(i, j + 1), at(i + 1, j + 1)};
                    const bool over = may_end && top[0] == top[1] && top[0] == bottom[0] && top[0] == bottom[1];
                    visit_spread(1. / count, (top[0] + top[1] + bottom[0] + bottom[1]) / 4,
                                 (top[1] - top[0] + bottom[1] - bottom[0]) / 2,
                                 (bottom[0] - top[0] + bottom[1] - top[1]) / 2, over ? 0 : grid.spread);
                }
            return;
        }
        const auto ends = [](int k, int last) { return k == 0 || k == last ? .5 : 1.; };
        for (int j = 0; j <= grid.rows; ++j)
            for (int i = 0; i <= grid.columns; ++i)
                visit_spread(ends(i, grid.columns) * ends(j, grid.rows) / count, at(i, j), 0, 0, grid.spread);
    };
    /// Returns the mean of the colours of parts, by their shares, and the variance of these.
    const auto mean_and_variance = [&](const MapFunction& map) {
        DVec3 sum(0), squares(0);  // less the map's mean
        const auto add = [&](double share, const DVec3& color) {
            sum += share * color, squares += share * color * color;
        };
        each_part([&](double share, double x, const auto& sides) {
            const auto& [a, b] = sides;
            const double reach = (std::abs(a) + b) / 2;
            const bool point = (details && details->jumps) || map.is_linear(x - reach, x + reach);
            add((1 - grid.lost) * share, point ? map.value(x) : mean_of(map, x, a, b));
        });
        if (grid.lost > 0)
            for (const double value : *grid.anywhere) add(grid.lost / most_anywhere, map.value(value));
        return std::pair(map.mean + sum, squares - sum * sum);
    };
    const MapFunction& map = kept_map(stops, pattern.stops, fold);
    double low = HUGE_VAL, high = -HUGE_VAL;
    each_part([&](double, double x, const auto& sides) {
        const double reach = 1.5 * (std::abs(sides.first) + sides.second);
        low = std::min(low, x - reach), high = std::max(high, x + reach);
    });
    const bool has_jump = map.has_jump(low, high);
    const bool detailed = grid.cells > finely || high - low > .25 || has_jump;
    if (has_jump && !grid.coarse) grid = refined(given);
    const auto [color, variance] = mean_and_variance(map);
    const double doubt = std::sqrt(grid.unseen * std::max({variance.x, variance.y, variance.z, 0.}));
    const bool known = std::abs(color.x) + std::abs(color.y) + std::abs(color.z) < furthest;
    if (weights)
        weigh(stops, pattern.stops, fold, weights,
              [&](const MapFunction& own) { return mean_and_variance(own).first; });
    return {known ? max(color, DVec3(0)) : map.mean + map.value(0), detailed, std::clamp(grid.loose, exact, 1.),
            known ? doubt : 0};
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
            return {mixed((1 - mean_of_parts(area, mean_of_checks)) / 2), any_border(), exact};
        case PatternForm::brick: {
            const DVec3 mortar(double(pattern.mortar.x), double(pattern.mortar.y), double(pattern.mortar.z));
            bool detailed = false;
            for (int c = 0; c < 3; ++c)
                for (const double border : {0., mortar[c]})
                    for (const double shift : {0., c == 1 ? 0. : .5})
                        detailed = detailed || has_border(area, c, shift - border);
            const auto share = [&](const PatternArea& part) { return share_of_bricks(part, mortar); };
            return {mixed(mean_of_parts(area, share)), detailed, exact};
        }
        case PatternForm::solid: {
            const SolidDetails details = details_of(*pattern.solid);
            const double share = std::min(1., area.weight * share_of_steps(pattern, stops));
            return mean_of_grid(pattern, stops,
                                values_over(*pattern.solid, details, area, share, least_steps(pattern, stops), find),
                                &details, weights);
        }
        default: {
            const MapFunction& map = kept_map(stops, pattern.stops, Fold::ramp);
            const double x = area.middle.x - double(pattern.border), reach = 1.5 * extent(area, 0);
            const bool detailed = reach > .25 || map.has_jump(x - reach, x + reach);
            const auto mean_by = [&](const MapFunction& own) {
                if (is_far(area)) return own.mean;
                return own.mean + mean_of_parts(area, [&](const PatternArea& part) {
                           return mean_of(own, part.middle.x - double(pattern.border), part.across.x, part.down.x);
                       });
            };
            if (weights) weigh(stops, pattern.stops, Fold::ramp, weights, mean_by);
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
template PatternMean mean_over(const PatternKernel<long double>&, const ColorStopKernel<long double>*, const ValueGrid&,
                               double*);

}  // namespace strahl
