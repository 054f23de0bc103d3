// Makes kernels of patterns in the spaces of bodies.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "trace/world/pattern_slack.h"
#include "trace/world/world_arrays.h"

namespace strahl {

/// Borders are this much before whole coordinates: 1e-10, as in POV-Ray, if rounding leaves so much of it.
template <class T>
constexpr double border = std::max(1e-10, 0x1p6 * static_cast<double>(std::numeric_limits<T>::epsilon()));

/// Finds for each kind of pattern how its own space becomes the kernel's, whose coordinates may be shifted by `period`
/// (0 where they may not).
template <class T>
struct KernelSpace {
    PatternKernel<T>& kernel;
    glm::dmat4 matrix{1};
    DVec3 period{0};

    void operator()(const Checker&) {
        kernel.form = PatternForm::checker;
        matrix[3] = {border<T>, border<T>, border<T>, 1};
        period = DVec3(2);
    }
    void operator()(const Brick& brick) {
        kernel.form = PatternForm::brick;
        for (int c = 0; c < 3; ++c) {
            matrix[c][c] = 1 / brick.size[c];
            matrix[3][c] = (border<T> + brick.mortar) / brick.size[c];
            kernel.mortar[c] = static_cast<T>(brick.mortar / brick.size[c]);
        }
        period = {1, 2, 1};
    }
    void operator()(const Gradient& gradient) {
        kernel.form = PatternForm::ramp;
        const DVec3 axis = normalize(gradient.axis);
        for (int c = 0; c < 3; ++c) matrix[c] = {axis[c], 0, 0, 0};
        matrix[3].x = border<T>;
        kernel.border = static_cast<T>(border<T>);
        period = {1, 0, 0};
    }
    void operator()(const Noise& noise) {
        kernel.form = PatternForm::noise;
        if (sum(noise, 1)) period = DVec3(289);
    }
    void operator()(const Marble& marble) {
        kernel.form = PatternForm::layers;
        if (sum(marble, marble.turbulence)) period = DVec3(289);
    }
    void operator()(const Wood& wood) {
        kernel.form = PatternForm::rings;
        if (sum(wood, wood.turbulence)) period = {0, 0, 289};
    }
    void operator()(const ImagePattern& image) {
        kernel.form = PatternForm::image;
        const double shift = image.sharp ? border<T> : 0;
        const bool repeats[2]{!image.once && image.wrap[0] == ImageWrap::repeat,
                              !image.once && image.wrap[1] == ImageWrap::repeat};
        const bool mirrors[2]{!image.once && image.wrap[0] == ImageWrap::mirror,
                              !image.once && image.wrap[1] == ImageWrap::mirror};
        kernel.image = {nullptr,
                        image.pixels->width,
                        image.pixels->height,
                        image.map,
                        image.once.has_value(),
                        image.sharp,
                        {!repeats[0], !repeats[1]},
                        {mirrors[0], mirrors[1]},
                        cast<T>(image.once.value_or(Color(0))),
                        static_cast<T>(border<T>),
                        {static_cast<T>(shift / image.pixels->width), static_cast<T>(shift / image.pixels->height)},
                        0};
        if (image.map == ImageMap::spherical) return;
        for (int axis = 0; axis < 2; ++axis) {
            const int along = image.map == ImageMap::planar ? axis : axis == 1 ? 2 : -1;
            if (along >= 0) period[along] = repeats[axis] ? 1 : mirrors[axis] ? 2 : 0;
        }
    }
    void operator()(const SolidPattern& solid) { kernel.form = PatternForm::solid, kernel.solid = &solid; }
    /// Takes the numbers of a sum of noises. Returns whether the sum repeats itself as noise does.
    bool sum(const Octaves& octaves, double turbulence) {
        kernel.turbulence = static_cast<T>(turbulence);
        kernel.octaves = {static_cast<std::int32_t>(octaves.octaves), static_cast<T>(octaves.omega),
                          static_cast<T>(octaves.lambda)};
        return octaves.lambda == std::floor(octaves.lambda);
    }
};

inline const ImagePattern* image_of(const std::shared_ptr<const Pattern>& pattern) {
    return pattern ? std::get_if<ImagePattern>(&pattern->kind) : nullptr;
}
/// Returns the matrix from the pattern's own space into the world, or to the places by uv.
inline glm::dmat4 matrix_of(const Pattern& pattern, const glm::dmat4& to_world) {
    const glm::dmat4 own = matrix(pattern.transformations);
    return pattern.by_uv ? own : to_world * own;
}
/// Returns the kernel of a pattern whose body has the matrix `to_world`, without its stops, pixels and material.
template <class T>
PatternKernel<T> kernel_of(const Pattern& pattern, const glm::dmat4& to_world, const Placement& world) {
    PatternKernel<T> kernel{};
    KernelSpace<T> space{kernel};
    std::visit(space, pattern.kind);
    kernel.by_uv = pattern.by_uv;
    const glm::dmat4 own = space.matrix * glm::inverse(matrix_of(pattern, to_world));
    // world = (scene - origin) * scale
    const Placement placement = pattern.by_uv ? Placement{} : world;
    DVec3 offset = transform_point(own, placement.origin);
    for (int c = 0; c < 3; ++c) {
        // Far from the pattern's origin a T has no digits left for where in a cell a point is. A double has.
        if (space.period[c] > 0) offset[c] -= space.period[c] * std::round(offset[c] / space.period[c]);
        for (int k = 0; k < 3; ++k) kernel.rows[c][k] = static_cast<T>(own[k][c] / placement.scale);
    }
    kernel.offset = cast<T>(offset);
    return kernel;
}

/// Notes for proofs how far a kernel is off. `body` takes the body that has the pattern into the world, if that
/// matters. The first call for a kernel sets its numbers if it is in long double.
template <class T>
void compare(const Pattern& pattern, const std::vector<Transformation>& body, const Placement& placement, bool first,
             PatternKernel<T>& kernel) {
    if constexpr (!std::is_same_v<T, float>) {
        std::vector<Transformation> steps = pattern.transformations;
        if (!pattern.by_uv) steps.insert(steps.end(), body.begin(), body.end());
        PatternKernel<T> own{};
        KernelSpace<T> space{own};
        std::visit(space, pattern.kind);
        const Placement& world = pattern.by_uv ? Placement{} : placement;
        const PatternSlack<T> before = kernel.slack;
        compare_pattern(pattern, steps, world, space.period, border<T>, first, kernel);
        if (kernel.solid) kernel.slack.turned = std::numeric_limits<T>::infinity();
        if (first) return;
        kernel.slack.turned = std::max(before.turned, kernel.slack.turned);
        kernel.slack.moved = std::max(before.moved, kernel.slack.moved);
    }
}
/// Notes for proofs how far a kernel is off that bends normals.
template <class T>
void compare(const Material& material, const std::vector<Transformation>& body, const Placement& placement, bool first,
             BendKernel<T>& kernel);

}  // namespace strahl
