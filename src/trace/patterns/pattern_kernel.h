// Colours and normals of patterns. scene/pattern.h defines the patterns.
#pragma once
#include <algorithm>
#include <bit>

#include "trace/patterns/footprint_kernel.h"
#include "trace/patterns/pattern_calls.h"
#include "trace/patterns/pattern_means.h"
#include "trace/patterns/quick_mean_kernel.h"
#include "trace/patterns/relief_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns where points of the world, which are on these surfaces, are in the pattern's space.
template <class S>
STRAHL_INLINE Vec3<S> place_of(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                               const Vec3<S>& position, const S& surface) {
    if (!pattern.by_uv) return in_space_of(pattern, position);
    return in_space_of(pattern, place_in(placed_triangles(world, pattern.places, surface), position));
}

/// A colour, and the shares of light that come through where a surface has it.
template <class S>
struct ClearColor {
    Vec3<S> color;
    S filter{0}, transmit{0};
};
/// Finds mean colours of a pattern over footprints; lanes not in `lanes` get any colour. Of patterns among colours the
/// footprints may be divided once.
template <class S>
[[gnu::noinline]] Filtering<S> filtered_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                           const Vec3<S>& position, const S& surface, const Footprint<S>& footprint,
                                           Mask<S> lanes, Vec3<S>& color, bool may_divide = true);
template <bool clear, class S>
ClearColor<S> nested_color_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                              const Vec3<S>& position, const S& surface, const S& value, const Footprint<S>* footprint);

/// Returns the colour of a pattern where it has this value, and if `clear` the shares. Colours that are patterns
/// themselves are means over the footprint, if there is one.
template <bool clear, class S>
STRAHL_INLINE ClearColor<S> clear_color_of(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                           const Vec3<S>& position, const S& surface, const S& value,
                                           const Footprint<S>* footprint = nullptr) {
    if (pattern.nests) [[unlikely]]
        return nested_color_at<clear>(world, pattern, position, surface, value, footprint);
    const auto* stop = world.patterns.stops + pattern.first_stop;
    ClearColor<S> found{splat<S>(stop->color)};
    if constexpr (clear) found.filter = S(stop->filter), found.transmit = S(stop->transmit);
    Vec3<S>& color = found.color;
    for (int i = 1; i < pattern.stops; ++i) {
        const auto *const before = stop++, *const after = stop;
        const Mask<S> beyond = value > S(before->at);
        if (none(beyond)) break;
        // Two stops in one place make a jump: there, `per` is infinite.
        const S share = min((value - S(before->at)) * S(after->per), S(1)), rest = S(1) - share;
        for (int c = 0; c < 3; ++c)
            color[c] = select(beyond, fma(share, S(after->color[c]), rest * S(before->color[c])), color[c]);
        if constexpr (clear) {
            found.filter = select(beyond, fma(share, S(after->filter), rest * S(before->filter)), found.filter);
            found.transmit = select(beyond, fma(share, S(after->transmit), rest * S(before->transmit)), found.transmit);
        }
    }
    return found;
}
/// Returns the colour of a pattern at points of the world, which are on these surfaces, and if `clear` the shares.
template <bool clear, class S>
STRAHL_INLINE ClearColor<S> clear_color_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                           const Vec3<S>& position, const S& surface) {
    const Vec3<S> p = place_of(world, pattern, position, surface);
    if (pattern.form == PatternForm::image) return {image_color(pattern.image, p)};
    return clear_color_of<clear>(world, pattern, position, surface, value_at(pattern, p));
}

/// Returns the colour of a pattern of these values that has patterns among its colours.
template <bool clear, class S>
[[gnu::noinline]] ClearColor<S> nested_color_at(const World<Element<S>>& world,
                                                const PatternKernel<Element<S>>& pattern, const Vec3<S>& position,
                                                const S& surface, const S& value, const Footprint<S>* footprint) {
    const auto color_of = [&](const ColorStopKernel<Element<S>>& stop) -> ClearColor<S> {
        if (stop.nested < 0) return {splat<S>(stop.color), S(stop.filter), S(stop.transmit)};
        if (footprint) {
            ClearColor<S> found;
            filtered_at(world, world.patterns.nested[stop.nested], position, surface, *footprint,
                        first_lanes<S>(width<S>), found.color);
            return found;
        }
        return clear_color_at<clear>(world, world.patterns.nested[stop.nested], position, surface);
    };
    const auto* stop = world.patterns.stops + pattern.first_stop;
    ClearColor<S> found = color_of(*stop), after = found;
    for (int i = 1; i < pattern.stops; ++i) {
        const auto* const before_stop = stop++;
        const Mask<S> beyond = value > S(before_stop->at);
        if (none(beyond)) break;
        const S share = min((value - S(before_stop->at)) * S(stop->per), S(1)), rest = S(1) - share;
        const ClearColor<S> before = after;
        after = color_of(*stop);
        const auto mix = [&](const S& a, const S& b, S& own) { own = select(beyond, fma(share, b, rest * a), own); };
        for (int c = 0; c < 3; ++c) mix(before.color[c], after.color[c], found.color[c]);
        mix(before.filter, after.filter, found.filter), mix(before.transmit, after.transmit, found.transmit);
    }
    return found;
}
template <class S>
[[gnu::noinline]] Vec3<S> color_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                   const Vec3<S>& position, const S& surface) {
    return clear_color_at<false>(world, pattern, position, surface).color;
}

/// Calls visit(which, lanes) for each lane among `lanes`.
template <class S, class Visit>
STRAHL_INLINE void each_lane(Mask<S> lanes, const Visit& visit) {
    for (unsigned left = bits(lanes); left != 0; left &= left - 1) visit(std::countr_zero(left));
}
/// Returns a lane of a vector.
template <class S>
STRAHL_INLINE DVec3 lane_of(const Vec3<S>& v, int k) {
    return {static_cast<double>(lane(v.x, k)), static_cast<double>(lane(v.y, k)), static_cast<double>(lane(v.z, k))};
}

/// Returns approximate mean colours of a pattern over footprints, which are parallelograms around p in its space.
template <class S>
[[gnu::noinline]] Vec3<S> quick_mean(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                     const Vec3<S>& position, const S& surface, const Footprint<S>& footprint,
                                     const Vec3<S>& p, const Vec3<S>& across, const Vec3<S>& down) {
    const auto color_of = [&](const S& value) {
        return clear_color_of<false>(world, pattern, position, surface, value, &footprint).color;
    };
    if (pattern.form == PatternForm::checker || pattern.form == PatternForm::brick)
        return color_of(mean_of_steps(pattern, p, across, down));
    if (pattern.form == PatternForm::solid) return color_of(value_at(pattern, p));
    const SpreadValue<S> value = spread_value(pattern, p, across, down);
    const S middle = folded(pattern, value.middle);
    const auto* const stops = world.patterns.stops + pattern.first_stop;
    const Vec3<S> color = color_of(middle);
    const Mask<S> crossing = crosses_stops(pattern, stops, middle, value.width);
    if (pattern.nests || none(crossing)) return color;
    return select(crossing, mean_of_range(pattern, stops, value.middle, value.width), color);
}

/// Means in lanes, one after the other.
template <class S>
struct PatternMeans {
    using T = Element<S>;
    alignas(64) T values[5][width<S>] = {};
    alignas(64) T weights[most_weighed][width<S>];  // of the stops, for patterns with nested patterns only
    /// Sets the mean of a lane; find(weights) returns it.
    template <class Find>
    void set(const PatternKernel<T>& pattern, int k, const Find& find) {
        double own[most_weighed];
        const PatternMean mean = find(pattern.nests ? own : nullptr);
        for (int c = 0; c < 3; ++c) values[c][k] = static_cast<T>(mean.color[c]);
        values[3][k] = mean.detailed ? static_cast<T>(mean.loose) : T(-1);
        values[4][k] = static_cast<T>(mean.doubt);
        for (int i = 0; i < pattern.stops && pattern.nests; ++i) weights[i][k] = static_cast<T>(own[i]);
    }
    Filtering<S> get(Vec3<S>& color) const {
        for (int c = 0; c < 3; ++c) color[c] = load_lanes<S>(values[c]);
        return {S(1), load_lanes<S>(values[3]), load_lanes<S>(values[4])};
    }
};

/// Finds values of a solid pattern, a pack of points at a time.
template <class D>
void smoothed_values(const SolidPattern& solid, const double (&at)[3][ValueGrid::room], int count, double step,
                     double* values) {
    for (int i = 0; i < count; i += width<D>) {
        const Vec3<D> p(load_lanes<D>(at[0] + i), load_lanes<D>(at[1] + i), load_lanes<D>(at[2] + i));
        store_lanes(values + i, smoothed_solid(solid, p, step));
    }
}

/// Returns how many of the finest cells that count noise, layers or rings have in a unit of their space.
template <class T>
T finest_detail(const PatternKernel<T>& pattern) {
    const bool noisy = pattern.form == PatternForm::noise || pattern.turbulence != 0;
    return noisy ? finest_octave(pattern.octaves, T(least_strength)) : T(1);
}

/// Finds mean colours of noise, layers or rings around p: from their values on a grid over the footprint, between which
/// these are taken for linear. Octaves that are finer than the grid fade away.
template <class S>
[[gnu::noinline]] void mean_of_values(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                      const SeenArea<S>& area, Mask<S> lanes, PatternMeans<S>& means) {
    using T = Element<S>;
    const auto& [p, across, down, weight, shrink] = area;
    const S finest(finest_detail(pattern)), one(1);
    const S lengths[2] = {sqrt(dot(across, across)), sqrt(dot(down, down))};
    const T contrast = static_cast<T>(share_of_steps(pattern, world.patterns.stops + pattern.first_stop));
    const S share = min(S(contrast) * weight, one);
    const S least(static_cast<T>(least_steps(pattern, world.patterns.stops + pattern.first_stop)));
    const auto steps_along = [&](const S& own, const S& other) {
        const S most = select(own < other, S(T(ValueGrid::most_steps / 2)), S(T(ValueGrid::most_steps)));
        return max(-floor(share * -min(S(T(steps_per_cell)) * finest * own, most)), least);
    };
    const S columns = steps_along(lengths[0], lengths[1]), rows = steps_along(lengths[1], lengths[0]);
    const S steps[2] = {lengths[0] / columns, lengths[1] / rows}, step = max(steps[0], steps[1]);
    const S fine = finest * (lengths[0] + lengths[1]);
    const LostOctaves<S> lost = lost_octaves(pattern, p, across, down, steps, lengths);
    // Packs hold points of one grid: grids have different sizes.
    constexpr int lanes_of = width<S>, most_packs = (ValueGrid::most_values + lanes_of - 1) / lanes_of;
    alignas(64) T along[2][most_packs * lanes_of], values[most_packs * lanes_of];
    const auto of = [](const S& all, int k) { return static_cast<double>(lane(all, k)); };
    each_lane<S>(lanes, [&](int k) {
        ValueGrid grid{.columns = static_cast<int>(lane(columns, k)),
                       .rows = static_cast<int>(lane(rows, k)),
                       .spread = of(lost.spread, k),
                       .loose = of(lost.loose, k),
                       .unseen = of(lost.unseen, k),
                       .cells = of(fine, k)};
        int n = 0;
        for (int j = 0; j <= grid.rows; ++j)
            for (int i = 0; i <= grid.columns; ++i, ++n) {
                along[0][n] = static_cast<T>(i) / lane(columns, k) - T(.5);
                along[1][n] = static_cast<T>(j) / lane(rows, k) - T(.5);
            }
        for (; n % lanes_of != 0; ++n) along[0][n] = along[1][n] = 0;
        const auto whole = [&](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, k)), S(lane(v.y, k)), S(lane(v.z, k))); };
        const SeenArea<S> own{
            whole(p), whole(across), whole(down), weight, {S(lane(shrink[0], k)), S(lane(shrink[1], k))}};
        const S own_step(lane(step, k));
        for (int i = 0; i < n; i += lanes_of) {
            const S x = load_lanes<S>(along[0] + i), y = load_lanes<S>(along[1] + i);
            store_lanes(values + i, smoothed_value(pattern, own.at(x, y), own_step));
        }
        std::copy_n(values, (grid.rows + 1) * (grid.columns + 1), grid.values);
        means.set(pattern, k, [&](double* weights) {
            return mean_over(pattern, world.patterns.stops + pattern.first_stop, grid, weights);
        });
    });
}

/// Finds mean colours of a pattern that is no image over areas in its space.
template <class S>
[[gnu::noinline]] void find_means_of(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                     const SeenArea<S>& area, Mask<S> lanes, PatternMeans<S>& means) {
    if (!has_mean(pattern.form)) return mean_of_values(world, pattern, area, lanes, means);
    each_lane<S>(lanes, [&](int k) {
        means.set(pattern, k, [&](double* weights) {
            const auto of = [&](const S& all) { return static_cast<double>(lane(all, k)); };
            return mean_over(pattern, world.patterns.stops + pattern.first_stop,
                             PatternArea{lane_of(area.middle, k),
                                         lane_of(area.across, k),
                                         lane_of(area.down, k),
                                         of(area.weight),
                                         {of(area.shrink[0]), of(area.shrink[1])}},
                             weights, smoothed_values<Widest<double>>);
        });
    });
}
/// Makes footprints points where they are not known or go beyond the horizon.
template <class S>
STRAHL_INLINE void limit_ways(Vec3<S>& across, Vec3<S>& down) {
    const Mask<S> known = dot(across, across) + dot(down, down) < S(largest_gain);
    across = select(known, across, splat<S>(Vec3<Element<S>>(0)));
    down = select(known, down, splat<S>(Vec3<Element<S>>(0)));
}

/// Returns where a way beside a ray leads on a surface with this normal.
template <class S>
STRAHL_INLINE Vec3<S> along_surface(const Footprint<S>& footprint, const Vec3<S>& way, const Vec3<S>& normal) {
    return fma(-dot(way, normal) / dot(footprint.direction, normal), footprint.direction, way);
}

/// Returns a way in the world in the pattern's space.
template <class S>
STRAHL_INLINE Vec3<S> turned_for(const PatternKernel<Element<S>>& pattern, const Vec3<S>& way) {
    Vec3<S> own;
    for (int c = 0; c < 3; ++c) own[c] = dot(splat<S>(pattern.rows[c]), way);
    return own;
}

/// Footprints with edges of a pattern and of one among its colours are divided into so many parts in a row, and their
/// mean counts as so loose; found by experiment.
inline constexpr int divided_into = 3;
inline constexpr double divided_loose = .1;

/// The weights of stops in a footprint, and in its left and upper halves; of halves none if it may be divided.
template <class S>
struct NestedMeans {
    PatternMeans<S> whole, left, upper;
};
/// Returns how far aside of a footprint's middle a stop is seen, along both sides of it, from -1/2 to 1/2: exactly if
/// its border is straight and along a side.
template <class S>
std::array<S, 2> shift_of(const NestedMeans<S>& means, int stop, Mask<S> lanes) {
    using T = Element<S>;
    alignas(64) T shifts[2][width<S>] = {};
    each_lane<S>(lanes, [&](int k) {
        const T weight = means.whole.weights[stop][k];
        const T ways[2] = {1 - means.left.weights[stop][k] / weight, 1 - means.upper.weights[stop][k] / weight};
        const T sum = std::abs(ways[0]) + std::abs(ways[1]);
        for (int i = 0; i < 2 && sum > 0; ++i) {
            const T part = std::pow(weight, std::abs(ways[i]) / sum);  // share of the side's length on which it is seen
            shifts[i][k] = std::clamp(ways[i] * std::max(part, 1 - part) / 2, T(-.5), T(.5));
        }
    });
    return {load_lanes<S>(shifts[0]), load_lanes<S>(shifts[1])};
}

/// Finds mean colours of a pattern that has patterns among its colours: the means of these by the weights of its stops.
/// Divides footprints in which both have edges; in each part a stop counts as seen around one place.
template <class S>
[[gnu::noinline]] Filtering<S> mean_of_nested(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                              const Vec3<S>& position, const S& surface, const Footprint<S>& footprint,
                                              Mask<S> lanes, const NestedMeans<S>& means, Vec3<S>& color,
                                              bool may_divide) {
    using T = Element<S>;
    const S zero(0), one(1);
    const SeenArea<S> area{position, along_surface(footprint, footprint.across, footprint.normal),
                           along_surface(footprint, footprint.down, footprint.normal), footprint.weight,
                           footprint.shrink};
    const auto footprint_on = [&](const SeenArea<S>& part, const S& weight) {
        return Footprint<S>{footprint.direction, footprint.normal, part.across, part.down, weight, part.shrink};
    };
    Filtering<S> all = means.whole.get(color);
    color = splat<S>(Vec3<T>(0));
    Mask<S> crossed = first_lanes<S>(0);
    for (int i = 0; i < pattern.stops; ++i) {
        const S weight = load_lanes<S>(means.whole.weights[i]);
        const Mask<S> seen = lanes & (weight > S(T(1e-6))), others = seen & (weight < S(T(.999)));
        const ColorStopKernel<T>& stop = world.patterns.stops[pattern.first_stop + i];
        Vec3<S> own = splat<S>(stop.color);
        const auto add = [&](Mask<S> which, const Vec3<S>& middle, const Footprint<S>& part, bool divide) {
            if (none(which)) return;
            const Filtering<S> inner =
                filtered_at(world, world.patterns.nested[stop.nested], middle, surface, part, which, own, divide);
            const Mask<S> varies = which & (inner.loose >= zero) & (inner.length > zero);
            all.loose = select(varies, max(all.loose, inner.loose), all.loose);
            all.doubt = select(which, fma(weight, inner.doubt, all.doubt), all.doubt);
            crossed = crossed | (varies & others);
            for (int c = 0; c < 3; ++c) color[c] = select(which, fma(weight, own[c], color[c]), color[c]);
        };
        if (stop.nested < 0) {
            for (int c = 0; c < 3; ++c) color[c] = select(seen, fma(weight, own[c], color[c]), color[c]);
            continue;
        }
        add(seen & !others, position, footprint, may_divide);
        if (may_divide) {  // perhaps all of the footprint is divided
            add(others, position, footprint, false);
        } else if (any(others)) {
            const auto [x, y] = shift_of(means, i, others);
            const SeenArea<S> own = area.part(x, y, one - S(2) * abs(x), one - S(2) * abs(y));
            add(others, own.middle, footprint_on(own, footprint.weight * weight), false);
        }
    }
    if (!may_divide || none(crossed)) return all;
    const S per(T(1) / T(divided_into));
    Vec3<S> sum = splat<S>(Vec3<T>(0));
    for (int j = 0; j < divided_into; ++j)
        for (int i = 0; i < divided_into; ++i) {
            const auto middle = [&](int k) { return (S(static_cast<T>(k)) + S(T(.5))) * per - S(T(.5)); };
            const SeenArea<S> part = area.part(middle(i), middle(j), per, per);
            Vec3<S> own;
            // Errors of parts are independent: that of their mean is `per` times theirs.
            filtered_at(world, pattern, part.middle, surface, footprint_on(part, per * footprint.weight), crossed, own,
                        false);
            sum = fma(per * per, own, sum);
        }
    color = select(crossed, sum, color);
    all.loose = select(crossed, min(max(all.loose, S(T(divided_loose))), one), all.loose);
    return all;
}
template <class S>
Filtering<S> filtered_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                         const Vec3<S>& position, const S& surface, const Footprint<S>& footprint, Mask<S> lanes,
                         Vec3<S>& color, bool may_divide) {
    using T = Element<S>;
    if (pattern.form == PatternForm::constant || (pattern.nests && pattern.stops > most_weighed)) {
        color = color_at(world, pattern, position, surface);
        if (pattern.form != PatternForm::constant) return {S(1), S(1)};  // not filtered at all
        return {};
    }
    Vec3<S> place = position, across, down;
    if (pattern.by_uv) {
        const PlacedTriangles<S> triangles = placed_triangles(world, pattern.places, surface);
        const Vec3<S> normal = cross(triangles.e, triangles.f);
        place = place_in(triangles, position);
        across = way_in(triangles, along_surface(footprint, footprint.across, normal));
        down = way_in(triangles, along_surface(footprint, footprint.down, normal));
    } else {
        across = along_surface(footprint, footprint.across, footprint.normal);
        down = along_surface(footprint, footprint.down, footprint.normal);
    }
    const Vec3<S> p = in_space_of(pattern, place);
    across = turned_for(pattern, across), down = turned_for(pattern, down);
    if (pattern.form == PatternForm::image) {
        if (world.patterns.quick) return color = image_color(pattern.image, p), Filtering<S>{};
        const MipMapKernel& map = world.patterns.mip_maps[pattern.image.number];
        return filtered_color(pattern.image, map, p, across, down, lanes, color);
    }
    limit_ways(across, down);
    if (world.patterns.quick) {
        color = quick_mean(world, pattern, position, surface, footprint, p, across, down);
        return {};
    }
    const SeenArea<S> area{p, across, down, footprint.weight, footprint.shrink};
    NestedMeans<S> means;
    find_means_of(world, pattern, area, lanes, means.whole);
    if (!pattern.nests) return means.whole.get(color);
    if (!may_divide) {
        const S zero(0), half(T(.5)), one(1), aside(T(-.25));
        find_means_of(world, pattern, area.part(aside, zero, half, one), lanes, means.left);
        find_means_of(world, pattern, area.part(zero, aside, one, half), lanes, means.upper);
    }
    return mean_of_nested(world, pattern, position, surface, footprint, lanes, means, color, may_divide);
}
/// Does light come through somewhere?
template <class T>
bool is_clear(const World<T>& world, const PatternKernel<T>& pattern) {
    const auto* const stops = world.patterns.stops + pattern.first_stop;
    return std::any_of(stops, stops + pattern.stops, [&](const ColorStopKernel<T>& stop) {
        return stop.nested < 0 ? stop.filter != 0 || stop.transmit != 0
                               : is_clear(world, world.patterns.nested[stop.nested]);
    });
}
/// Does the same, and returns what light comes through. A pattern that lets any through is not filtered.
template <class S>
Filtering<S> filtered_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                         const Vec3<S>& position, const S& surface, const Footprint<S>& footprint, Mask<S> lanes,
                         ClearColor<S>& found) {
    if (pattern.form != PatternForm::constant && !is_clear(world, pattern))
        return filtered_at(world, pattern, position, surface, footprint, lanes, found.color);
    found = clear_color_at<true>(world, pattern, position, surface);
    if (pattern.form == PatternForm::constant) return {};
    return {S(1), S(1)};
}

/// Calls visit(which, lanes) for each different patterned material of a pack.
template <class S, class Visit>
STRAHL_INLINE void each_pattern(const World<Element<S>>& world, const int* materials, const Visit& visit) {
    using T = Element<S>;
    alignas(64) T numbers[width<S>];
    for (int k = 0; k < width<S>; ++k) numbers[k] = static_cast<T>(materials[k]);
    const S number = load_lanes<S>(numbers);
    Mask<S> left = number >= S(static_cast<T>(world.patterns.first));
    while (any(left)) {
        const T own = lane(number, first(left));
        const Mask<S> lanes = left & (number == S(own));
        visit(static_cast<int>(own) - world.patterns.first, lanes);
        left = left & !lanes;
    }
}

/// Gives a material the colours of its pattern.
template <class S>
STRAHL_INLINE void set_colors(const PatternKernel<Element<S>>& pattern, Mask<S> lanes, const Vec3<S>& color,
                              MaterialKernel<S>& values) {
    for (int c = 0; c < 3; ++c) {
        values.ambient[c] = select(lanes, S(pattern.ambient[c]) * color[c], values.ambient[c]);
        values.diffuse[c] = select(lanes, S(pattern.diffuse) * color[c], values.diffuse[c]);
    }
}

template <class S>
void PatternCalls<S>::paint(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                            MaterialKernel<S>& values) {
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const PatternKernel<T>& pattern = world.patterns.list[which];
        set_colors(pattern, lanes, color_at(world, pattern, position, surface), values);
    });
}

template <class S>
Filtering<S> PatternCalls<S>::paint_filtered(const World<T>& world, const int* materials, const Vec3<S>& position,
                                             const S& surface, const Footprint<S>& footprint,
                                             MaterialKernel<S>& values) {
    Filtering<S> all;
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const PatternKernel<T>& pattern = world.patterns.list[which];
        Vec3<S> color;
        const Filtering<S> own = filtered_at(world, pattern, position, surface, footprint, lanes, color);
        set_colors(pattern, lanes, color, values);
        all.length = select(lanes, own.length, all.length), all.loose = select(lanes, own.loose, all.loose);
        const S most(largest(pattern.ambient) + pattern.diffuse);
        all.doubt = select(lanes, most * own.doubt, all.doubt);
    });
    return all;
}

template <class S>
Vec3<S> PatternCalls<S>::bent(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                              const Vec3<S>& normal) {
    Vec3<S> all = normal;
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const BendKernel<T>& own = world.patterns.bends[which];
        Vec3<S> n = normal;
        if (!own.map.flat) n = bent_by(world, own.map, position, surface, n);
        if (!own.bump.flat) n = bent_by(world, own.bump, position, surface, normal, n);
        all = select(lanes, n, all);
    });
    return all;
}

/// Bumps whose finest detail is larger than so many footprints are as they are at points.
inline constexpr double coarse_bump = .5;

/// Sets normals that a bump bends to the mean directions over footprints, where these are not much smaller than the
/// bump's detail. There `length` becomes the length of their mean, if they are all as steep as at the middle.
template <class S>
[[gnu::noinline]] void mean_bent(const World<Element<S>>& world, const BumpKernel<Element<S>>& bump,
                                 const Vec3<S>& position, const Footprint<S>& footprint, Mask<S> lanes, Vec3<S>& bent,
                                 S& length) {
    using T = Element<S>;
    const PatternKernel<T>& pattern = bump.pattern;
    const Vec3<S>& normal = footprint.normal;
    const Vec3<S> p = in_space_of(pattern, position);
    Vec3<S> across = turned_for(pattern, along_surface(footprint, footprint.across, normal));
    Vec3<S> down = turned_for(pattern, along_surface(footprint, footprint.down, normal));
    limit_ways(across, down);
    if (!has_mean(pattern.form)) {  // others are found by grids of values
        const S finest(finest_detail(pattern)), cells = finest * (sqrt(dot(across, across)) + sqrt(dot(down, down)));
        lanes = lanes & (cells > S(T(coarse_bump)));
        if (none(lanes)) return;
    }
    Vec3<S> mean = splat<S>(Vec3<T>(0)), middle = mean, own;
    for (int i = 0; i < 4; ++i) {
        const Vec3<S> at = p + splat<S>(bump.steps[i]), bend = splat<S>(bump.bends[i]);
        PatternMeans<S> means;
        find_means_of(world, pattern, SeenArea<S>{at, across, down, footprint.weight, footprint.shrink}, lanes, means);
        mean = fma(load_lanes<S>(means.values[0]), bend, mean), middle = fma(value_at(pattern, at), bend, middle);
    }
    for (int c = 0; c < 3; ++c) own[c] = dot(splat<S>(bump.columns[c]), normal);
    const S steep = sqrt(dot(own, own));
    const auto slope = [&](const Vec3<S>& bend) {  // squared, along the surface
        const Vec3<S> along = scale(steep, fma(-dot(bend, normal), normal, bend));
        return dot(along, along);
    };
    length = select(lanes, S(1) / sqrt(S(1) + max(slope(middle) - slope(mean), S(0))), length);
    bent = select(lanes, unit_or(fma(steep, mean, normal), normal), bent);
}
template <class S>
Vec3<S> PatternCalls<S>::bent_filtered(const World<T>& world, const int* materials, const Vec3<S>& position,
                                       const S& surface, const Footprint<S>& footprint, S& length) {
    const Vec3<S>& normal = footprint.normal;
    Vec3<S> all = normal;
    length = S(1);
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const BendKernel<T>& own = world.patterns.bends[which];
        const PatternKernel<T>& bump = own.bump.pattern;
        Vec3<S> n = normal;
        if (!own.map.flat) n = bent_by(world, own.map, position, surface, n);
        if (!own.bump.flat) n = bent_by(world, own.bump, position, surface, normal, n);
        if (!own.bump.flat && own.map.flat && !own.bump.by_vectors && !bump.by_uv && bump.form != PatternForm::image)
            mean_bent(world, own.bump, position, footprint, lanes, n, length);
        all = select(lanes, n, all);
    });
    return all;
}

/// Returns the piece of PatternCalls::piece as three whole or half numbers.
template <class S>
[[gnu::noinline]] Vec3<S> piece_at(const World<Element<S>>& world, const PatternKernel<Element<S>>& pattern,
                                   const Vec3<S>& position, const S& surface, Mask<S> filtered) {
    using T = Element<S>;
    const Vec3<S> p = place_of(world, pattern, position, surface);
    const Vec3<S> whole(floor(p.x), floor(p.y), floor(p.z));
    const S zero(0);
    const auto unfiltered = [&](const Vec3<S>& piece) { return select(filtered, splat<S>(Vec3<T>(0)), piece); };
    switch (pattern.form) {
        case PatternForm::checker:
            return unfiltered(whole);
        case PatternForm::brick: {
            const S half = S(T(.5)), shift = select(fraction(p.y * half) > half, half, zero);
            const S mortar = select(brick_at(pattern.mortar, p) > zero, zero, half);
            return unfiltered({floor(p.x + shift), whole.y + mortar, floor(p.z + (half - shift))});
        }
        case PatternForm::ramp:
            return unfiltered({whole.x, zero, zero});
        case PatternForm::image:
            if (pattern.image.map == ImageMap::spherical || pattern.image.map == ImageMap::cylindrical) break;
            if (pattern.image.once) return {whole.x, whole.y, zero};
            return unfiltered({whole.x, whole.y, zero});
        default:
            break;
    }
    return {zero, zero, zero};
}
template <class S>
S PatternCalls<S>::piece(const World<T>& world, const int* materials, const Vec3<S>& position, const S& surface,
                         Mask<S> filtered) {
    S all(0);
    each_pattern<S>(world, materials, [&](int which, Mask<S> lanes) {
        const Vec3<S> p = piece_at(world, world.patterns.list[which], position, surface, filtered);
        // With square roots of primes as factors no two sums are the same, as long as numbers have the digits.
        const S number =
            fma(S(T(1.4142135623730951)), p.x, fma(S(T(1.7320508075688772)), p.y, S(T(2.23606797749979)) * p.z));
        all = select(lanes, number, all);
    });
    return all;
}

template <class S>
Vec3<S> PatternCalls<S>::sky(const World<T>& world, const Vec3<S>& direction) {
    const PatternTables<T>& tables = world.patterns;
    Vec3<S> color = color_at(world, *tables.sky, direction, S(-1));
    for (int i = 0; i < tables.coat_count; ++i) {
        const ClearColor<S> own = clear_color_at<true>(world, tables.coats[i], direction, S(-1));
        const S opacity = S(1) - own.filter - own.transmit;
        for (int c = 0; c < 3; ++c)
            color[c] = fma(fma(own.filter, own.color[c], own.transmit), color[c], opacity * own.color[c]);
    }
    return color;
}

template <class S>
Filtering<S> PatternCalls<S>::sky_filtered(const World<T>& world, const Footprint<S>& footprint, Vec3<S>& color) {
    if (world.patterns.coat_count > 0) return color = sky(world, footprint.direction), Filtering<S>{S(1), S(1)};
    const Mask<S> all = first_lanes<S>(width<S>);
    return filtered_at(world, *world.patterns.sky, footprint.direction, S(-1), footprint, all, color);
}

}  // namespace strahl::inline STRAHL_LEVEL
