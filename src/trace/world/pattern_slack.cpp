#include "trace/world/pattern_slack.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strahl {
namespace {

/// The way from a pattern's own space to the kernel's, exact but for rounding to long double.
struct ExtendedPatternSpace {
    std::array<ExtendedVector, 3> rows{ExtendedVector{1, 0, 0}, ExtendedVector{0, 1, 0}, ExtendedVector{0, 0, 1}};
    ExtendedVector offset{0}, mortar{0};

    /// Makes the space of a kind whose borders are this much before whole coordinates.
    ExtendedPatternSpace(const PatternKind& kind, Extended border) {
        if (const Brick* const brick = std::get_if<Brick>(&kind)) {
            for (int c = 0; c < 3; ++c) {
                const Extended size = brick->size[c];
                rows[c][c] = 1 / size;
                offset[c] = (border + brick->mortar) / size;
                mortar[c] = brick->mortar / size;
            }
        } else if (const Gradient* const gradient = std::get_if<Gradient>(&kind)) {
            rows = {quick_unit(extended(gradient->axis)), ExtendedVector(0), ExtendedVector(0)};
            offset = {border, 0, 0};
        } else if (std::holds_alternative<Checker>(kind)) {
            offset = ExtendedVector(border);
        }
    }
};

template <class T>
T upper(Extended x) {
    return x < 1e300L ? static_cast<T>(x) * T(1 + 1e-15) : T(HUGE_VAL);
}

/// The way out of a relief's space, and how long its longest column is.
struct ReliefColumns {
    ExtendedTransform to_world;
    std::array<ExtendedVector, 3> columns;
    Extended longest = 0;
    explicit ReliefColumns(std::span<const Transformation> steps) : to_world(steps, DVec3(0), 1) {
        columns = {to_world.turn({1, 0, 0}), to_world.turn({0, 1, 0}), to_world.turn({0, 0, 1})};
        for (const ExtendedVector& column : columns) longest = std::max(longest, quick_length(column));
    }
};
template <class T>
void compare_columns(const ReliefColumns& own, bool replace, ReliefKernel<T>& kernel) {
    Extended off = 0;
    for (int c = 0; c < 3; ++c) {
        const ExtendedVector exact = Extended(1) / own.longest * own.columns[c];
        if (replace && std::is_same_v<T, Extended>)
            for (int k = 0; k < 3; ++k) kernel.columns[c][k] = static_cast<T>(exact[k]);
        off +=
            sum_of(extended(kernel.columns[c]) - exact) + 2 * (own.to_world.rounding() + 4 * ExtendedTransform::unit);
    }
    kernel.slack.columns = own.to_world.known() ? upper<T>(off) : T(HUGE_VAL);
}

}  // namespace

/// With the columns of the way out into the world, rows are the dual ones, and the offset is what takes the place of
/// the space's origin back to 0. Lengths of rows are off by the share that columns are off, times twice how oblique
/// these are; four more roundings are those of products with the kind's own rows.
template <class T>
void compare_pattern(const Pattern& pattern, std::span<const Transformation> steps, const Placement& placement,
                     const DVec3& period, double border, bool replace, PatternKernel<T>& kernel) {
    PatternSlack<T>& slack = kernel.slack;
    const ExtendedTransform to_world(steps, placement.origin, placement.scale);
    if (!to_world.known()) return void(slack.turned = HUGE_VAL);
    const std::array columns{to_world.way(ExtendedVector{1, 0, 0}), to_world.way(ExtendedVector{0, 1, 0}),
                             to_world.way(ExtendedVector{0, 0, 1})};
    const std::array back = dual_of(columns);
    Extended condition = 0;
    for (int i = 0; i < 3; ++i) condition += quick_length(columns[i]) * quick_length(back[i]);
    constexpr Extended unit = ExtendedTransform::unit;
    const Extended share = condition * (2 * to_world.rounding() + 8 * unit);
    const ExtendedVector origin = to_world.point(ExtendedVector(0));
    const Extended origin_off = to_world.rounding(DVec3(0)), far = quick_length(origin);
    const ExtendedPatternSpace own(pattern.kind, border);
    Extended turned = 0, moved = 0;
    for (int c = 0; c < 3; ++c) {
        const ExtendedVector& within = own.rows[c];
        const ExtendedVector row = within.x * back[0] + within.y * back[1] + within.z * back[2];
        const Extended length = std::abs(within.x) * quick_length(back[0]) +
                                std::abs(within.y) * quick_length(back[1]) + std::abs(within.z) * quick_length(back[2]);
        const auto modulo = [&](Extended x) { return period[c] > 0 ? x - period[c] * std::round(x / period[c]) : x; };
        const Extended exact = own.offset[c] - dot_product(row, origin), offset = modulo(exact);
        if (replace && std::is_same_v<T, Extended>) {
            for (int k = 0; k < 3; ++k) kernel.rows[c][k] = static_cast<T>(row[k]);
            kernel.offset[c] = static_cast<T>(offset), kernel.mortar[c] = static_cast<T>(own.mortar[c]);
        }
        turned = std::max(turned, sum_of(extended(kernel.rows[c]) - row) + 2 * share * length);
        moved = std::max(moved, std::abs(modulo(kernel.offset[c] - exact)) + length * (share * far + origin_off) +
                                    8 * unit * (length * far + std::abs(own.offset[c]) + std::abs(exact)));
    }
    slack.turned = upper<T>(turned), slack.moved = upper<T>(moved);
}

/// A bend is a sum of rows, the dual vectors of the columns, which are as far off as those of patterns.
template <class T>
void compare_relief(const Bump& bump, std::span<const Transformation> steps, bool replace, BumpKernel<T>& kernel) {
    const ReliefColumns own(steps);
    compare_columns<T>(own, replace, kernel);
    const std::array back = dual_of(own.columns);
    Extended condition = 0, whole = 0;
    for (int c = 0; c < 3; ++c) {
        condition += quick_length(own.columns[c]) * quick_length(back[c]);
        whole += quick_length(back[c]);
    }
    constexpr Extended unit = ExtendedTransform::unit;
    const Extended share = condition * (2 * own.to_world.rounding() + 8 * unit), step = bump.step();
    const Extended strength = -bump.height * 3 / (4 * step) * own.longest;
    const ExtendedPatternSpace space(bump.pattern->kind, 0);
    Extended bends = 0, moved = 0;
    for (std::size_t i = 0; i < Bump::corners.size(); ++i) {
        const ExtendedVector v = extended(Bump::corners[i]);
        const ExtendedVector bend = strength * (v.x * back[0] + v.y * back[1] + v.z * back[2]);
        ExtendedVector by{0};
        for (int c = 0; c < 3; ++c) by[c] = step * dot_product(space.rows[c], v);
        for (int k = 0; replace && std::is_same_v<T, Extended> && k < 3; ++k)
            kernel.bends[i][k] = static_cast<T>(bend[k]), kernel.steps[i][k] = static_cast<T>(by[k]);
        bends =
            std::max(bends, sum_of(extended(kernel.bends[i]) - bend) + (share + 8 * unit) * std::abs(strength) * whole);
        moved = std::max(moved, sum_of(extended(kernel.steps[i]) - by) + 8 * unit * step);
    }
    kernel.slack.bends = upper<T>(bends), kernel.slack.steps = upper<T>(moved);
}
template <class T>
void compare_relief(const NormalMap&, std::span<const Transformation> steps, bool replace, NormalMapKernel<T>& kernel) {
    compare_columns<T>(ReliefColumns(steps), replace, kernel);
}

template <class T>
void measure_colors(std::span<const ColorStop> stops, const ImagePattern* image, PatternSlack<T>& slack) {
    Color least(HUGE_VAL), most(-HUGE_VAL);
    const auto include = [&](const Color& low, const Color& high) {
        for (int c = 0; c < 3; ++c) least[c] = std::min(least[c], low[c]), most[c] = std::max(most[c], high[c]);
    };
    for (const ColorStop& stop : stops) include(stop.color, stop.color);
    if (image) {
        include(Color(0), image->pixels->largest);
        if (image->once) include(*image->once, *image->once);
    }
    double apart = 0, largest = 0;
    for (int c = 0; c < 3; ++c) {
        apart = std::max(apart, (most[c] - least[c]) * (1 + 1e-15));
        largest = std::max({largest, std::abs(most[c]), std::abs(least[c])});
    }
    slack.apart = static_cast<T>(apart), slack.largest = static_cast<T>(largest);
    // No bound is known for patterns that stand in place of colours.
    if (std::ranges::any_of(stops, [](const ColorStop& stop) { return stop.pattern != nullptr; }))
        slack.apart = slack.largest = std::numeric_limits<T>::max();
}

template void compare_pattern(const Pattern&, std::span<const Transformation>, const Placement&, const DVec3&, double,
                              bool, PatternKernel<double>&);
template void compare_pattern(const Pattern&, std::span<const Transformation>, const Placement&, const DVec3&, double,
                              bool, PatternKernel<Extended>&);
template void compare_relief(const Bump&, std::span<const Transformation>, bool, BumpKernel<double>&);
template void compare_relief(const Bump&, std::span<const Transformation>, bool, BumpKernel<Extended>&);
template void compare_relief(const NormalMap&, std::span<const Transformation>, bool, NormalMapKernel<double>&);
template void compare_relief(const NormalMap&, std::span<const Transformation>, bool, NormalMapKernel<Extended>&);
template void measure_colors(std::span<const ColorStop>, const ImagePattern*, PatternSlack<double>&);
template void measure_colors(std::span<const ColorStop>, const ImagePattern*, PatternSlack<Extended>&);

}  // namespace strahl
