// Makes kernels of bumps and normal maps, one for each space of a body that has them.
#include "trace/world/pattern_space.h"

namespace strahl {
namespace {

/// Sets what bumps and normal maps have in common. Returns the largest factor by which the pattern's space is scaled.
template <class T>
double set_relief(const Relief& relief, const glm::dmat4& to_world, const Placement& placement,
                  ReliefKernel<T>& kernel) {
    kernel.flat = !relief.pattern;
    if (kernel.flat) return 0;
    kernel.pattern = kernel_of<T>(*relief.pattern, to_world, placement);
    const glm::dmat4 own = matrix_of(*relief.pattern, to_world);
    double longest = 0;
    for (int c = 0; c < 3; ++c) longest = std::max(longest, length(DVec3(own[c])));
    for (int c = 0; c < 3; ++c) kernel.columns[c] = cast<T>(DVec3(own[c]) / longest);
    return longest;
}
template <class T>
NormalMapKernel<T> kernel_of(const NormalMap& map, const glm::dmat4& to_world, const Placement& placement) {
    NormalMapKernel<T> kernel{};
    set_relief(map, to_world, placement, kernel);
    kernel.height = static_cast<T>(map.height);
    return kernel;
}
template <class T>
BumpKernel<T> kernel_of(const Bump& bump, const glm::dmat4& to_world, const Placement& placement) {
    BumpKernel<T> kernel{};
    const double longest = set_relief(bump, to_world, placement, kernel);
    if (kernel.flat) return kernel;
    KernelSpace<T> space{kernel.pattern};
    std::visit(space, bump.pattern->kind);
    const glm::dmat4 back = glm::inverse(matrix_of(*bump.pattern, to_world));
    kernel.by_vectors = std::holds_alternative<SolidPattern>(bump.pattern->kind);
    for (int i = 0; i < 3 && kernel.by_vectors; ++i)
        for (int c = 0; c < 3; ++c) kernel.bends[i][c] = static_cast<T>(bump.height * longest * back[c][i]);
    if (kernel.by_vectors) return kernel;
    const double strength = -bump.height * 3 / (4 * bump.step()) * longest;
    for (std::size_t i = 0; i < Bump::corners.size(); ++i) {
        const DVec3& v = Bump::corners[i];
        for (int c = 0; c < 3; ++c) {
            const DVec3 row(space.matrix[0][c], space.matrix[1][c], space.matrix[2][c]);
            kernel.steps[i][c] = static_cast<T>(bump.step() * dot_product(row, v));
            kernel.bends[i][c] = static_cast<T>(strength * dot_product(DVec3(back[c]), v));
        }
    }
    return kernel;
}

}  // namespace

template <class T>
BendKernel<T> WorldArrays<T>::bend_of(const Material& material, const glm::dmat4& to_world, const Placement& placement,
                                      const PlacesKernel& places) {
    BendKernel<T> own{kernel_of<T>(material.normal, to_world, placement),
                      kernel_of<T>(material.bump, to_world, placement)};
    const auto finish = [&](const Relief& relief, PatternKernel<T>& kernel) {
        kernel.places = places;
        patterns.kept.push_back(relief.pattern);
        if (const auto* const image = image_of(relief.pattern)) add_image(image->pixels, 0, false, kernel.image);
    };
    finish(material.normal, own.map.pattern);
    finish(material.bump, own.bump.pattern);
    // A bump's pattern gets the colours black and white, so that means of its colours are means of its values.
    own.bump.pattern.first_stop = static_cast<std::int32_t>(patterns.stops.size()), own.bump.pattern.stops = 2;
    for (int value = 0; value < 2; ++value)
        patterns.stops.push_back({.at = T(value), .per = 1 / T(value), .color = Vec3<T>(T(value))});
    return own;
}

template <class T>
void compare(const Material& material, const std::vector<Transformation>& body, const Placement& placement, bool first,
             BendKernel<T>& kernel) {
    const auto each = [&](const auto& relief, auto& own) {
        if constexpr (!std::is_same_v<T, float>) {
            if (!relief.pattern) return;
            std::vector<Transformation> steps = relief.pattern->transformations;
            if (!relief.pattern->by_uv) steps.insert(steps.end(), body.begin(), body.end());
            compare(*relief.pattern, body, placement, first, own.pattern);
            measure_colors(relief.pattern->colors, image_of(relief.pattern), own.pattern.slack);
            const ReliefSlack<T> before = own.slack;
            compare_relief(relief, steps, first, own);
            if (first) return;
            own.slack.columns = std::max(before.columns, own.slack.columns);
            own.slack.bends = std::max(before.bends, own.slack.bends);
            own.slack.steps = std::max(before.steps, own.slack.steps);
        }
    };
    each(material.normal, kernel.map);
    each(material.bump, kernel.bump);
}

template BendKernel<float> WorldArrays<float>::bend_of(const Material&, const glm::dmat4&, const Placement&,
                                                       const PlacesKernel&);
template void compare(const Material&, const std::vector<Transformation>&, const Placement&, bool, BendKernel<float>&);
template BendKernel<double> WorldArrays<double>::bend_of(const Material&, const glm::dmat4&, const Placement&,
                                                         const PlacesKernel&);
template void compare(const Material&, const std::vector<Transformation>&, const Placement&, bool, BendKernel<double>&);
template BendKernel<long double> WorldArrays<long double>::bend_of(const Material&, const glm::dmat4&, const Placement&,
                                                                   const PlacesKernel&);
template void compare(const Material&, const std::vector<Transformation>&, const Placement&, bool,
                      BendKernel<long double>&);

}  // namespace strahl
