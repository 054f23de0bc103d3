// Means over a rectangle of the light that it sends to a point.
//
// If nothing can hide any of the rectangle the means need no shadow rays. Else it is divided into cells, as a pixel is:
// shadow rays go to their corners, and cells whose corners do not all get the same light are divided further.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "num/lane_math.h"
#include "trace/forms/items_kernel.h"
#include "trace/lights/area_light_calls.h"
#include "trace/lights/area_mean_kernel.h"
#include "trace/lights/grid_parts.h"
#include "trace/lights/shaft_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Finds the bodies that may be in the way of a light, in a shaft that begins on a surface. Returns true if none are.
template <class S, class T>
bool nothing_in(const World<T>& world, const Shaft<T>& shaft, T surface, Start<S>& start) {
    const ShaftStart<T> from{surface, start.light, start.bin, bool(bits(start.outside) & 1)};
    if (!world.bin_per_item) return !anything_in<S>(world, shaft, from);
    start.only = bodies_in<S>(world, shaft, from);
    return start.only == 0;
}

/// Squares of a rectangle, given by their corners with the smallest coordinates, in units of the smallest squares.
struct AreaCells {
    static constexpr int side = 64, largest = 8, most = side * side;  // side: of the rectangle, in units
    int count = 0;
    std::array<std::uint8_t, most> x, y;
    void add(int cell_x, int cell_y) {
        x[count] = static_cast<std::uint8_t>(cell_x), y[count] = static_cast<std::uint8_t>(cell_y);
        ++count;
    }
};

/// Returns the edges of a light's grid, turned if it turns to what it lights. `middle` is the way to its middle.
template <class T>
std::pair<Vec3<T>, Vec3<T>> edges_of_grid(const AreaKernel<T>& area, const Vec3<T>& middle) {
    if (!area.orient) return {area.u, area.v};
    const Vec3<T> seen(T(1), T(1), area.mirrored ? T(-1) : T(1));
    const Vec3<T> l = scale(T(1) / sqrt(dot(middle, middle)), middle) * seen;
    const Vec3<T> across = cross(l, abs(abs(l.z) - T(1)) < T(.01) ? Vec3<T>(0, 1, 0) : Vec3<T>(0, 0, 1));
    const T size = sqrt(dot(area.u, area.u));
    const Vec3<T> u = scale(size / sqrt(dot(across, across)), across);
    return {u * seen, cross(l, u) * seen};
}
/// Returns the ways to places on a light's grid that are a and b times its edges u and v off its middle.
template <class S, class T>
Vec3<S> way_on_grid(const AreaKernel<T>& area, const Vec3<T>& middle, const Vec3<T>& u, const Vec3<T>& v, S a, S b) {
    if (area.circular) {
        a += S(T(.001)), b += S(T(.001));
        const S inwards = max(abs(a), abs(b)) / sqrt(a * a + b * b);
        a *= inwards, b *= inwards;
    }
    return fma(a, splat<S>(u), fma(b, splat<S>(v), splat<S>(middle)));
}

/// The places from which the light of a grid comes whose points jitter, along each of its edges: equal steps are equal
/// shares of the light.
template <class T>
struct SpreadGrid {
    static constexpr int steps = AreaCells::side;
    struct SpreadEdge {
        std::array<T, steps + 1> places{};         // times the edge, off its middle
        std::array<std::uint8_t, steps> points{};  // by step: the number of the point that it belongs to
        std::array<int, steps> shares{};           // by point: of the light, in steps
    };
    SpreadEdge across, down;
    bool adapts;  // does it depend on the light of their corners whether quarters of the grid are divided?

    explicit SpreadGrid(const AreaKernel<T>& area)  // one with a grid
        : across(edge_of(area.columns)),
          down(edge_of(area.rows)),
          adapts(area.adaptive < 31 && (std::max(area.columns, area.rows) - 1) >> area.adaptive > 1) {}

    static SpreadEdge edge_of(int points) {
        SpreadEdge edge;
        edge.shares[0] = steps;
        if (points < 2) return edge;
        edge.shares[0] = 0;
        const auto halve = [&edge](const auto& self, int first, int last, int share) -> void {
            if (last - first < 2) {
                edge.shares[first] += share / 2, edge.shares[last] += share / 2;
                return;
            }
            self(self, first, (first + last) / 2, share / 2), self(self, (first + last + 1) / 2, last, share / 2);
        };
        halve(halve, 0, points - 1, steps);
        const auto place = [points](T point) { return (point - T(.5)) / T(points - 1) - T(.5); };
        int step = 0;
        for (int i = 0; i < points; ++i)
            for (int k = 0; k < edge.shares[i]; ++k) {
                edge.points[step] = static_cast<std::uint8_t>(i);
                edge.places[step++] = place(T(i) + T(k) / T(edge.shares[i]));
            }
        edge.places[step] = place(T(points));
        return edge;
    }
};

/// Gathers the light of the points of a grid that jitter, from the cells of its steps.
template <class T>
class GatheredPoints {
  public:
    GatheredPoints(const SpreadGrid<T>& spread, const AreaKernel<T>& area)
        : spread(spread), area(area), points(std::size_t(area.columns) * area.rows), sums(points.size()) {}

    /// Adds a cell, whose light is between these shares.
    void add(int x, int y, int size, const Vec3<T>& mean, const Vec3<T>& low, const Vec3<T>& high) {
        for (int i = x; i < x + size; ++i)
            for (int k = y; k < y + size; ++k) {
                const int column = spread.across.points[i], row = spread.down.points[k];
                const std::size_t number = std::size_t(column) * area.rows + row;
                const T part = T(1) / T(spread.across.shares[column] * spread.down.shares[row]);
                JitteredPoint<T>& own = points[number];
                const bool is_first = sums[number] == Vec3<T>(0) && own.chance == T(0);
                own.low = is_first ? low : min(own.low, low), own.high = is_first ? high : max(own.high, high);
                own.chance += part, sums[number] = fma(part, mean, sums[number]);
            }
    }
    /// Returns the mean share of the light of all points, where it would have this color.
    Vec3<T> mean(const Vec3<T>& color) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            JitteredPoint<T>& own = points[i];
            const Vec3<T> apart = own.high - own.low;
            const int c = apart.x >= apart.y && apart.x >= apart.z ? 0 : apart.y >= apart.z ? 1 : 2;
            own.chance = apart[c] > T(0) ? std::clamp((sums[i][c] - own.low[c]) / apart[c], T(0), T(1)) : T(0);
            // Shadows of several colours have more than two shares: their mean stays.
            if (own.chance > T(0)) own.high = own.low + scale(T(1) / own.chance, sums[i] - own.low);
        }
        return AdaptiveMean<T>(points, area.columns, area.rows, area.adaptive, color).mean();
    }

  private:
    const SpreadGrid<T>& spread;
    const AreaKernel<T>& area;
    std::vector<JitteredPoint<T>> points;  // `chance` is at first the share of the point that is gathered
    std::vector<Vec3<T>> sums;
};

/// Computes the means for one hit; with a `spread`, of a grid whose points jitter, only the share of its light.
template <class S>
class AreaSum {
    using T = Element<S>;
    static constexpr int side = AreaCells::side, row = side + 1;

  public:
    AreaSum(const World<T>& world, int number, const LitHits<S>& hits, int k, Visibility<S> visibility,
            const SpreadGrid<T>* spread)
        : world(world),
          spread(spread),
          visibility(visibility),
          position(at(hits.position, k)),
          normal(at(hits.normal, k)),
          flat(at(hits.flat, k)),
          reflected(at(hits.reflected, k)),
          surface(lane(hits.surface, k)),
          specular(lane(hits.specular, k)),
          pow(lane(hits.pow, k)),
          shines_from(lane(hits.shines_from, k)),
          start{number,
                hits.bin,
                first_lanes<S>((bits(hits.outside) >> k & 1) ? width<S> : 0),
                ~BodySet(0),
                S(lane(hits.medium, k)),
                hits.mediums} {
        const LightKernel<T>& light = world.lights[number];
        middle = light.position - position;
        std::tie(u, v) = edges_of_grid(light.rectangle, middle);
        first = middle - scale(T(.5), u + v);
        brightest = lane(hits.weight, k) * (lane(hits.diffuse, k) + specular) *
                    max(largest(light.color), largest(Vec3<T>(0) - light.color));
        soft = light.rectangle.soft;
        if (!spread || !spread->adapts) return;
        points.emplace(*spread, light.rectangle), color = scale(lane(hits.diffuse, k), light.color), gray = false;
        coarsest = AreaCells::largest / 2;  // what single points see counts more
    }

    void add_up(T error) {
        const AreaKernel<T>& own = world.lights[start.light].rectangle;
        const Vec3<T> across = scale(reach(own, own.columns), u), down = scale(reach(own, own.rows), v);
        const Vec3<T> corner = middle - scale(T(.5), across + down);
        const Vec3<T> ways[4]{corner, corner + across, corner + across + down, corner + down};
        int faced = 0;
        for (const Vec3<T>& way : ways) faced += (spread || dot(normal, way) > T(0)) && dot(flat, way) > T(0);
        if (faced == 0 && !spread) return;
        clear = (faced == 4 || !spread) &&
                nothing_in(world, Shaft<T>(position, ways, across, down, world.rounding), surface, start);
        glossy = may_shine(ways);
        if (clear && faced == 4 && !glossy) {
            share = Vec3<T>(T(1));
            if (!soft) diffuse = Vec3<T>(mean_cosine(normal, middle, u, v));
            return;
        }
        known.fill(0);
        AreaCells cells, mixed;
        int size = clear && faced < 4 ? 2 : coarsest;
        CornerList corners;
        for (int y = 0; y <= side; y += size)
            for (int x = 0; x <= side; x += size) {
                want(y * row + x, corners);
                if (x < side && y < side) cells.add(x, y);
            }
        trace(corners);
        for (;; size /= 2) {
            if (size == coarsest && (faced == 4 || spread) && is_even()) return;
            const T unevenness = split(cells, mixed, size);
            add(cells, size);
            constexpr T off = T(.15);  // measured: error, as a share, of the light of a cell that an edge crosses
            const T left = off * brightest * std::sqrt(unevenness) * area(size);
            if (size == 1 || !(left > error)) break;
            divide(mixed, cells, size / 2);
            trace_corners(cells, size / 2);
        }
        add(mixed, size);
        if (points) share = points->mean(color);
        if (!soft && faced == 4 && whole > 0) diffuse = scale(mean_cosine(normal, middle, u, v) / whole, diffuse);
    }

    Vec3<T> diffuse{0}, highlight{0}, share{0};  // of a light whose shadows alone are soft only the last
    std::int64_t rays = 0;

  private:
    static Vec3<T> at(const Vec3<S>& v, int k) { return {lane(v.x, k), lane(v.y, k), lane(v.z, k)}; }
    static T area(int size) { return T(size * size) / T(side * side); }

    /// Returns how long an edge of the outline is, times that of the light: as points jitter, or are off the middle of
    /// their circles.
    static T reach(const AreaKernel<T>& area, int points) {
        return area.jitter && points > 1 ? T(points) / T(points - 1) * T(area.circular ? 1.004 : 1) : T(1);
    }
    /// Returns true if the highlight of any point of the rectangle may be visible.
    bool may_shine(const Vec3<T> (&ways)[4]) const {
        if (!(specular > T(0))) return false;
        const T length = sqrt(dot(middle, middle)), along = dot(reflected, middle) / length;
        T cosine(1);
        for (const Vec3<T>& way : ways) cosine = min(cosine, dot(way, middle) / (length * sqrt(dot(way, way))));
        if (!(along < cosine)) return true;  // it is reflected towards a point of the cone around the rectangle
        const T sine = sqrt(max(T(1) - cosine * cosine, T(0))), across = sqrt(max(T(1) - along * along, T(0)));
        return !(along * cosine + across * sine < shines_from);
    }

    /// Returns the vectors to points of the rectangle, by their coordinates in units of the smallest cells.
    Vec3<S> way_to(const S& x, const S& y) const {
        constexpr T unit = T(1) / side;
        return fma(x * S(unit), splat<S>(u), fma(y * S(unit), splat<S>(v), splat<S>(first)));
    }

    struct CornerList {
        int count = 0;
        std::array<std::int16_t, row * row> numbers;
    };
    /// Adds a corner to which no shadow ray went.
    void want(int corner, CornerList& list) {
        if (known[corner] == 0)
            known[corner] = dark_side, list.numbers[list.count++] = static_cast<std::int16_t>(corner);
    }
    /// Traces shadow rays to corners.
    void trace(const CornerList& list) {
        for (int i = 0; i < list.count; i += width<S>)
            trace_pack(list.numbers.data() + i, std::min(list.count - i, width<S>));
    }
    /// Traces shadow rays to the corners of cells that no earlier ones had.
    void trace_corners(const AreaCells& cells, int size) {
        CornerList list;
        for (int i = 0; i < cells.count; ++i)
            for (const int corner : corners_of(cells.x[i], cells.y[i], size)) want(corner, list);
        trace(list);
    }
    void trace_pack(const std::int16_t* corners, int lanes) {
        alignas(64) T xs[width<S>] = {}, ys[width<S>] = {};
        for (int k = 0; k < lanes; ++k) {
            const int x = corners[k] % row, y = corners[k] / row;
            xs[k] = spread ? spread->across.places[x] : T(x), ys[k] = spread ? spread->down.places[y] : T(y);
        }
        const S x = load_lanes<S>(xs), y = load_lanes<S>(ys);
        const Vec3<S> way =
            spread ? way_on_grid(world.lights[start.light].rectangle, middle, u, v, x, y) : way_to(x, y);
        const S distance = sqrt(dot(way, way));
        const Mask<S> before = dot(splat<S>(flat), way) > S(0);
        Mask<S> faces = first_lanes<S>(lanes) & (distance > S(0));
        if (!spread) faces = faces & (dot(splat<S>(normal), way) > S(0)) & before;
        one_sided = one_sided && bits(faces) == bits(first_lanes<S>(lanes));
        if (none(faces)) return;
        Start<S> own = start;
        if (spread) own.outside = own.outside & before;  // a body is in the way of light from behind its own surface
        Vec3<S> arrives(S(1), S(1), S(1));
        if (!clear) {
            const Ray<S> ray{splat<S>(position), scale(S(1) / distance, way), S(surface)};
            arrives = visibility(world, ray, distance, faces, own);
            rays += strahl::count(faces);
        }
        if (gray && any(faces & !((arrives.x == arrives.y) & (arrives.x == arrives.z))))
            gray = false, shares[1] = shares[2] = shares[0];
        alignas(64) T found[3][width<S>];
        for (int c = 0; c < channels(); ++c) store_lanes(found[c], arrives[c]);
        for (unsigned left = bits(faces); left; left &= left - 1) {
            const int k = std::countr_zero(left);
            known[corners[k]] = faced_side;
            for (int c = 0; c < channels(); ++c) shares[c][corners[k]] = found[c][k];
        }
    }
    /// Returns how many channels of the shares are known: the others have those of the first one.
    int channels() const { return gray ? 1 : 3; }
    /// Do all corners that are known face the surface, with gray shares? Then the four of a cell are quickly seen.
    bool plain() const { return gray && one_sided; }
    std::array<T, 4> plain_corners(int x, int y, int size) const {
        const T* const from = &shares[0][y * row + x];
        return {from[0], from[size], from[size * row], from[size * row + size]};
    }

    /// Returns true if all corners of the first cells are in the dark or, of a light whose shadows alone are soft, if
    /// all light comes to all of them. Then the mean share is known.
    bool is_even() {
        const T own = shares[0][0];
        if (!(own == T(0) || (own == T(1) && world.lights[start.light].rectangle.soft))) return false;
        for (int y = 0; y <= side; y += coarsest)
            for (int x = 0; x <= side; x += coarsest)
                for (int c = 0; c < channels(); ++c)
                    if (shares[c][y * row + x] != own) return false;
        share = Vec3<T>(own);
        return true;
    }

    static std::array<int, 4> corners_of(int x, int y, int size) {
        const int corner = y * row + x;
        return {corner, corner + size, corner + size * row, corner + size * row + size};
    }
    /// Returns the least and the most light that corners get which face the surface; 1 is all light of a channel.
    std::pair<Vec3<T>, Vec3<T>> extremes(int x, int y, int size) const {
        Vec3<T> low{0}, high{0};
        bool any = false;
        for (const int corner : corners_of(x, y, size)) {
            if (known[corner] != faced_side) continue;
            const Vec3<T> own =
                gray ? Vec3<T>(shares[0][corner]) : Vec3<T>(shares[0][corner], shares[1][corner], shares[2][corner]);
            low = any ? min(low, own) : own, high = any ? max(high, own) : own;
            any = true;
        }
        return {low, high};
    }
    /// Returns by how much their light differs.
    T contrast(int x, int y, int size) const {
        if (plain()) {
            const auto [a, b, c, d] = plain_corners(x, y, size);
            return max(max(a, b), max(c, d)) - min(min(a, b), min(c, d));
        }
        const auto [low, high] = extremes(x, y, size);
        return largest(high - low);
    }
    /// Returns the mean share of light of the corners that face the surface.
    Vec3<T> mean_share(int x, int y, int size) const {
        if (plain()) {
            const auto [a, b, c, d] = plain_corners(x, y, size);
            return Vec3<T>(T(.25) * (a + b + c + d));
        }
        Vec3<T> sum{0};
        int count = 0;
        for (const int corner : corners_of(x, y, size)) {
            if (known[corner] != faced_side) continue;
            for (int c = 0; c < 3; ++c) sum[c] += shares[gray ? 0 : c][corner];
            ++count;
        }
        return count > 1 ? scale(T(1) / T(count), sum) : sum;
    }

    /// Moves cells whose corners do not get the same light to `mixed`. Returns the sum of the squares of their
    /// contrasts.
    T split(AreaCells& cells, AreaCells& mixed, int size) const {
        const int all = cells.count;
        T sum = 0;
        cells.count = mixed.count = 0;
        for (int i = 0; i < all; ++i) {
            const int x = cells.x[i], y = cells.y[i];
            const T own = contrast(x, y, size);
            (own == T(0) ? cells : mixed).add(x, y), sum += own * own;
        }
        return sum;
    }
    static void divide(const AreaCells& cells, AreaCells& quarters, int size) {
        quarters.count = 0;
        for (int i = 0; i < cells.count; ++i)
            for (int k = 0; k < 4; ++k) quarters.add(cells.x[i] + k % 2 * size, cells.y[i] + k / 2 * size);
    }

    /// Adds the light of cells, of a light whose shadows alone are soft the share: that of their middles, and for
    /// highlights that of grids so fine that highlights are smooth on them.
    void add(const AreaCells& cells, int size) {
        if (soft && !points) {
            for (int i = 0; i < cells.count; ++i)
                share = fma(area(size), mean_share(cells.x[i], cells.y[i], size), share);
            return;
        }
        for (int i = 0; i < cells.count; i += width<S>) {
            const int lanes = std::min(cells.count - i, width<S>);
            alignas(64) T xs[width<S>] = {}, ys[width<S>] = {}, cosines[width<S>], shines[width<S>];
            for (int k = 0; k < lanes; ++k) xs[k] = T(cells.x[i + k]), ys[k] = T(cells.y[i + k]);
            const S x = load_lanes<S>(xs), y = load_lanes<S>(ys), half(T(size) / 2);
            const Vec3<S> way = way_to(x + half, y + half);
            // The point may be on the light itself.
            const S length = max(sqrt(dot(way, way)), S(std::sqrt(std::numeric_limits<T>::min())));
            store_lanes(cosines, max(dot(splat<S>(normal), way), S(0)) / length);
            store_lanes(shines, glossy ? mean_highlight(x, y, size) : S(0));
            for (int k = 0; k < lanes; ++k) {
                const Vec3<T> arrives = mean_share(cells.x[i + k], cells.y[i + k], size);
                whole = fma(cosines[k], area(size), whole);
                diffuse = fma(cosines[k] * area(size), arrives, diffuse);
                highlight = fma(shines[k] * area(size), arrives, highlight);
                share = fma(area(size), arrives, share);
                if (!points) continue;
                const auto [low, high] = extremes(cells.x[i + k], cells.y[i + k], size);
                points->add(cells.x[i + k], cells.y[i + k], size, arrives, low, high);
            }
        }
    }
    /// Returns the means of Ks (h.l)^p over cells.
    S mean_highlight(const S& x, const S& y, int size) const {
        // A highlight's brightness falls by the exponential of -1/2 in the angle 1 / sqrt(p).
        const T reach = sqrt(max(dot(u, u), dot(v, v)) * (pow + T(1)) / dot(middle, middle));
        const T wanted = std::ceil(reach * T(2 * size) / T(side));
        const int n = wanted < T(8) ? std::max(1, static_cast<int>(wanted)) : 8;
        S sum(0);
        for (int i = 0; i < n * n; ++i) {
            const T dx = (T(i % n) + T(.5)) * T(size) / T(n), dy = (T(i / n) + T(.5)) * T(size) / T(n);
            const Vec3<S> way = way_to(x + S(dx), y + S(dy));
            const S length = sqrt(dot(way, way));
            const S shine = min(max(dot(splat<S>(reflected), way) / length, S(0)), S(1));
            const Mask<S> shines = (shine > S(shines_from)) & (dot(splat<S>(normal), way) > S(0));
            if (any(shines)) sum = sum + select(shines, power_of_uniform(shine, pow), S(0));
        }
        return sum * S(specular / T(n * n));
    }

    static constexpr std::uint8_t dark_side = 1, faced_side = 2;
    const World<T>& world;
    const SpreadGrid<T>* spread;
    Visibility<S> visibility;
    Vec3<T> position, normal, flat, reflected, u, v, middle, first;  // the last two are vectors from the position
    T surface, specular, pow, shines_from, brightest, whole = 0;
    Start<S> start;
    bool clear = false, glossy = false, soft = false;
    bool gray = true, one_sided = true;         // see channels() and plain()
    int coarsest = AreaCells::largest;          // the cells that shadow rays go to first
    std::optional<GatheredPoints<T>> points;    // of a grid whose points jitter and whose quarters may remain whole
    Vec3<T> color;                              // of the light, for these
    std::array<std::uint8_t, row * row> known;  // by corner: 0 if not known, else on which side of the surface it is
    std::array<T, row * row> shares[3];  // by corner: the share of light on the side of the surface that it faces
};

/// Computes the mean over a grid for one hit after the other.
template <class S>
class GridSum {
    using T = Element<S>;

  public:
    GridSum(const World<T>& world, int number, const LitHits<S>& hits, Visibility<S> visibility)
        : world(world),
          area(world.lights[number].rectangle),
          number(number),
          hits(hits),
          visibility(visibility),
          known(std::size_t(area.columns) * area.rows),
          shares(known.size()) {
        // Divides what is divided for every hit. Its points are traced together, so that packs are fuller.
        parts.assign(1, {0, 0, area.columns - 1, area.rows - 1});
        want_corners();
        for (int level = 0; level < area.adaptive && !parts.empty(); ++level)
            refine([](const GridPart&) { return true; });
        first_known = known, first_wanted = wanted, first_parts = parts, first_whole = whole, first_weight = weight;
    }

    /// Finds the mean for the hit of lane k, at which the light would have this colour.
    Vec3<T> mean(int k, const Vec3<T>& color) {
        const auto at = [k](const Vec3<S>& v) { return Vec3<T>(lane(v.x, k), lane(v.y, k), lane(v.z, k)); };
        position = at(hits.position), flat = at(hits.flat), surface = lane(hits.surface, k);
        middle = world.lights[number].position - position;
        std::tie(u, v) = edges_of_grid(area, middle);
        outside = bits(hits.outside) >> k & 1;
        start = {number,      hits.bin, first_lanes<S>(outside ? width<S> : 0), ~BodySet(0), S(lane(hits.medium, k)),
                 hits.mediums};
        if (nothing_before()) return Vec3<T>(1);
        known = first_known, wanted = first_wanted, parts = first_parts, whole = first_whole, weight = first_weight;
        trace_wanted();
        while (!parts.empty()) {
            refine([&](const GridPart& part) { return mixed(part, color); });
            trace_wanted();
        }
        Vec3<T> sum(0);
        for (const auto& [part, share] : whole)
            for (const int corner : part.corners(area.rows)) sum = fma(share, shares[corner], sum);
        return sum;
    }
    std::int64_t rays = 0;

  private:
    /// Divides those of the parts that are large enough and of which `divides` returns true; the others remain whole.
    /// Notes the corners of the new parts.
    template <class Divides>
    void refine(const Divides& divides) {
        weight *= T(.25), quarters.clear();
        for (const GridPart& part : parts)
            if (part.divisible() && divides(part))
                std::ranges::copy(part.quarters(), std::back_inserter(quarters));
            else
                whole.emplace_back(part, weight);
        parts.swap(quarters);
        want_corners();
    }
    bool mixed(const GridPart& part, const Vec3<T>& color) const {
        std::array<Vec3<T>, 4> own;
        std::ranges::transform(part.corners(area.rows), own.begin(), [&](int corner) { return shares[corner]; });
        return differs(own, color);
    }
    /// Returns true if all points of the grid are in front of the surface, and no body can be in between.
    bool nothing_before() {
        const T around = area.circular ? T(1.004) : T(1);  // circles are off their middle by .001
        const Vec3<T> across = scale(around, u), down = scale(around, v), first = middle - scale(T(.5), across + down);
        const Vec3<T> ways[4]{first, first + across, first + across + down, first + down};
        for (const Vec3<T>& way : ways)
            if (!(dot(flat, way) > T(0))) return false;
        return nothing_in(world, Shaft<T>(position, ways, across, down, world.rounding), surface, start);
    }
    /// Notes the corners of parts to which no shadow rays went.
    void want_corners() {
        for (const GridPart& part : parts)
            for (const int corner : part.corners(area.rows))
                if (!known[corner]) known[corner] = 1, wanted.push_back(corner);
    }
    void trace_wanted() {
        const int all = static_cast<int>(wanted.size());
        for (int i = 0; i < all; i += width<S>) trace_pack(wanted.data() + i, std::min(all - i, width<S>));
        wanted.clear();
    }
    void trace_pack(const int* points, int lanes) {
        alignas(64) T numbers[width<S>] = {};
        std::copy_n(points, lanes, numbers);
        const S number = load_lanes<S>(numbers), column = floor((number + S(T(.5))) / S(T(area.rows)));
        const Vec3<S> way = way_to(column, number - column * S(T(area.rows)));
        const S distance = sqrt(dot(way, way));
        const Mask<S> active = first_lanes<S>(lanes) & (distance > S(0));
        // A body is in the way of light from behind its own surface.
        Start<S> own = start;
        own.outside = own.outside & (dot(splat<S>(flat), way) > S(0));
        const Ray<S> ray{splat<S>(position), scale(S(1) / distance, way), S(surface)};
        const Vec3<S> arrives = select(active, visibility(world, ray, distance, active, own), splat<S>(Vec3<T>(1)));
        rays += strahl::count(active);
        for (int k = 0; k < lanes; ++k)
            shares[points[k]] = {lane(arrives.x, k), lane(arrives.y, k), lane(arrives.z, k)};
    }
    Vec3<S> way_to(const S& column, const S& row) const {
        const S a = area.columns > 1 ? column / S(T(area.columns - 1)) - S(T(.5)) : S(0);
        const S b = area.rows > 1 ? row / S(T(area.rows - 1)) - S(T(.5)) : S(0);
        return way_on_grid(area, middle, u, v, a, b);
    }

    const World<T>& world;
    const AreaKernel<T>& area;
    const int number;
    const LitHits<S>& hits;
    Visibility<S> visibility;
    Vec3<T> position, flat, middle, u, v;  // middle: the way there
    T surface = 0;
    bool outside = false;
    Start<S> start{};
    std::vector<std::uint8_t> known, first_known;  // by point, column by column
    std::vector<Vec3<T>> shares;
    std::vector<int> wanted, first_wanted;
    std::vector<GridPart> parts, quarters, first_parts;
    std::vector<std::pair<GridPart, T>> whole, first_whole;  // undivided parts, and what each of their corners counts
    T weight = 1, first_weight;                              // what each corner of a part counts of the level before
};

template <class S>
AreaMeans<S> AreaLightCalls<S>::grid_means(const World<T>& world, int light, const LitHits<S>& hits, const S& strength,
                                           Visibility<S> visibility) {
    alignas(64) T lanes[3][width<S>] = {};
    GridSum<S> sum(world, light, hits, visibility);
    for (unsigned left = bits(hits.lanes); left; left &= left - 1) {
        const int k = std::countr_zero(left);
        const Vec3<T> share = sum.mean(k, scale(lane(strength, k), world.lights[light].color));
        for (int c = 0; c < 3; ++c) lanes[c][k] = share[c];
    }
    return {.share = {load_lanes<S>(lanes[0]), load_lanes<S>(lanes[1]), load_lanes<S>(lanes[2])}, .rays = sum.rays};
}

template <class S>
AreaMeans<S> AreaLightCalls<S>::means(const World<T>& world, int light, const LitHits<S>& hits, T error,
                                      Visibility<S> visibility) {
    alignas(64) T lanes[9][width<S>] = {};
    AreaMeans<S> result;
    const AreaKernel<T>& own = world.lights[light].rectangle;
    const std::optional<SpreadGrid<T>> spread = own.jitter ? std::optional(SpreadGrid<T>(own)) : std::nullopt;
    for (unsigned left = bits(hits.lanes); left; left &= left - 1) {
        const int k = std::countr_zero(left);
        AreaSum<S> sum(world, light, hits, k, visibility, spread ? &*spread : nullptr);
        sum.add_up(error);
        result.rays += sum.rays;
        for (int c = 0; c < 3; ++c)
            lanes[c][k] = sum.diffuse[c], lanes[3 + c][k] = sum.highlight[c], lanes[6 + c][k] = sum.share[c];
    }
    for (int c = 0; c < 3; ++c) {
        result.diffuse[c] = load_lanes<S>(lanes[c]), result.highlight[c] = load_lanes<S>(lanes[3 + c]);
        result.share[c] = load_lanes<S>(lanes[6 + c]);
    }
    return result;
}

}  // namespace strahl::inline STRAHL_LEVEL
