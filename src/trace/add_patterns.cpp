// Patterns become kernels, each in the spaces of the bodies that have it.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "scene/error.h"
#include "scene/leaves.h"
#include "trace/pattern_slack.h"
#include "trace/world_arrays.h"

namespace strahl {
namespace {

/// Borders are this much before whole coordinates: 1e-10, as in POV-Ray, if rounding leaves so much of it.
template <class T>
constexpr double border = std::max(1e-10, 0x1p6 * static_cast<double>(std::numeric_limits<T>::epsilon()));

/// What is special about a kind: how the pattern's own space becomes the kernel's, whose coordinates may be shifted by
/// `period` (0 where they may not).
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
        kernel.image = {nullptr,
                        image.pixels->width,
                        image.pixels->height,
                        image.map,
                        image.once.has_value(),
                        cast<T>(image.once.value_or(Color(0))),
                        static_cast<T>(border<T>),
                        0};
        if (image.once || image.map == ImageMap::spherical) return;
        period = image.map == ImageMap::cylindrical ? DVec3(0, 0, 1) : DVec3(1, 1, 0);
    }
    /// Does the sum repeat itself as the noise does?
    bool sum(const Octaves& octaves, double turbulence) {
        kernel.turbulence = static_cast<T>(turbulence);
        kernel.octaves = static_cast<std::int32_t>(octaves.octaves);
        kernel.omega = static_cast<T>(octaves.omega), kernel.lambda = static_cast<T>(octaves.lambda);
        return octaves.lambda == std::floor(octaves.lambda);
    }
};

const ImagePattern* image_of(const std::shared_ptr<const Pattern>& pattern) {
    return pattern ? std::get_if<ImagePattern>(&pattern->kind) : nullptr;
}
/// What takes the pattern's own space into the world, or to where its body is by uv.
glm::dmat4 matrix_of(const Pattern& pattern, const glm::dmat4& to_world) {
    const glm::dmat4 own = matrix(pattern.transformations);
    return pattern.by_uv ? own : to_world * own;
}
/// The kernel of a pattern whose body's `to_world` is given, but for its stops, its pixels and its material.
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

/// Tells proofs how far a kernel is off. `body` takes the body that has the pattern into the world, if it matters. The
/// first one decides about the numbers of kernels in long double.
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
        compare_pattern(pattern, steps, world, space.period, border<T>, first, kernel);
    }
}

/// That of a material, but for its stops, its pixels and its ambient light.
template <class T>
PatternKernel<T> kernel_of(const Material& material, const glm::dmat4& to_world, const Placement& placement) {
    PatternKernel<T> kernel{};
    kernel.form = PatternForm::constant;
    if (material.rgb.pattern) kernel = kernel_of<T>(*material.rgb.pattern, to_world, placement);
    kernel.diffuse = static_cast<T>(material.diffuse);
    kernel.refraction = static_cast<T>(material.refraction);
    return kernel;
}

/// How much the space of a relief's pattern is scaled, in the direction of the most.
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
void WorldArrays<T>::add_image(const std::shared_ptr<const Pixels>& from, bool linear, bool colors,
                               ImageKernel<T>& kernel) {
    kernel.number = images->add(from, linear, colors);
    kernel.pixels = (*images)[kernel.number].own->values.data();
}

template <class T>
void WorldArrays<T>::add_colors(const Pigment& pigment, PatternKernel<T>& kernel, bool linear) {
    using M = Made<T>;
    const Pattern* const pattern = pigment.pattern.get();
    if (const auto* const image = image_of(pigment.pattern)) add_image(image->pixels, linear, true, kernel.image);
    kernel.first_stop = static_cast<std::int32_t>(stops.size());
    const std::vector<ColorStop> colors = pattern ? pattern->colors : std::vector{ColorStop{0, pigment.color}};
    for (double before = 0; const ColorStop& stop : colors) {
        stops.push_back({static_cast<T>(stop.at), static_cast<T>(1 / (M(stop.at) - before)), cast<T>(stop.color)});
        before = stop.at;
    }
    kernel.stops = static_cast<std::int32_t>(colors.size());
    if constexpr (!std::is_same_v<T, float>)
        if (pattern) measure_colors(*pattern, kernel.slack);
}

template <class T>
PlacesKernel WorldArrays<T>::add_places(const Shape& shape, int first_surface) {
    const Mesh* const mesh = std::get_if<Mesh>(&shape);
    if (!mesh || mesh->data->places.empty()) return {};
    meshes.push_back(mesh->data);
    return {first_surface, static_cast<std::int32_t>(mesh->data->triangles.size()), mesh->data->place_numbers(),
            mesh->data->places.data()};
}

template <class T>
BendKernel<T> WorldArrays<T>::bend_of(const Material& material, const glm::dmat4& to_world, const Placement& placement,
                                      const PlacesKernel& places) {
    BendKernel<T> own{kernel_of<T>(material.normal, to_world, placement),
                      kernel_of<T>(material.bump, to_world, placement)};
    const auto finish = [&](const Relief& relief, PatternKernel<T>& kernel) {
        kernel.places = places;
        if (const auto* const image = image_of(relief.pattern)) add_image(image->pixels, false, false, kernel.image);
    };
    finish(material.normal, own.map.pattern);
    finish(material.bump, own.bump.pattern);
    return own;
}

template <class T>
void WorldArrays<T>::add_sky(const Scene& scene, bool proves) {
    const Pattern* const pattern = scene.background.pattern.get();
    if (!pattern) return;
    sky = kernel_of<T>(*pattern, glm::dmat4(1), {});
    add_colors(scene.background, sky, scene.settings.linear);
    if (proves) compare(*pattern, {}, {}, true, sky);
    world.sky = &sky, world.stops = stops.data();
}
template <class T>
void WorldArrays<T>::add_patterns(const Scene& scene, const Placement& placement, bool proves) {
    using M = Made<T>;
    add_sky(scene, proves);
    const bool any_bent = std::ranges::any_of(scene.materials, &Material::bends);
    const auto varies = [&](const Material& m) { return any_bent || m.patterned(); };
    if (std::ranges::none_of(scene.materials, varies)) return;
    world.first_pattern = static_cast<int>(materials.size());
    std::vector<PatternKernel<T>> ranges(scene.materials.size());
    for (std::size_t i = 0; i < ranges.size(); ++i)
        if (varies(scene.materials[i])) add_colors(scene.materials[i].rgb, ranges[i], scene.settings.linear);
    const bool any_uv = std::ranges::any_of(scene.materials, &Material::by_uv);
    std::map<std::tuple<int, int, std::array<double, 16>>, std::int32_t> numbers;
    ItemCounts before;  // only by uv
    for (const Primitive& primitive : scene.primitives) {
        first_leaf.push_back(static_cast<std::int32_t>(leaf_materials.size()));
        const std::vector<LeafWay> ways = proves ? ways_of(primitive) : std::vector<LeafWay>();
        for_each_leaf_placed(primitive, [&](const Primitive& leaf, const LeafMatrices& matrices) {
            const Material& material = scene.materials[leaf.material];
            const int surface = static_cast<int>(before.surfaces);
            if (any_uv) count_items<T>(leaf, before);
            const std::size_t own_way = leaf_materials.size() - first_leaf.back();
            if (!varies(material)) return leaf_materials.push_back(leaf.material);
            const bool by_uv = material.by_uv(), compared = proves && material.rgb.pattern;
            std::array<double, 16> values{};  // those of the matrix, if they matter
            for (int i = 0; i < 16 && material.patterned(); ++i) values[i] = matrices.material[i / 4][i % 4];
            const auto [entry, is_new] = numbers.try_emplace({leaf.material, by_uv ? surface : -1, values},
                                                             static_cast<std::int32_t>(materials.size()));
            leaf_materials.push_back(entry->second);
            if (!is_new) {
                // The same matrix by other steps may be another one in exact arithmetic.
                PatternKernel<T>& known = patterns[entry->second - world.first_pattern];
                const T turned = known.slack.turned, moved = known.slack.moved;
                if (compared) compare(*material.rgb.pattern, ways[own_way].material, placement, false, known);
                known.slack.turned = std::max(turned, known.slack.turned);
                known.slack.moved = std::max(moved, known.slack.moved);
                return;
            }
            materials.push_back(MaterialKernel<T>(materials[leaf.material]));
            PatternKernel<T> kernel = kernel_of<T>(material, matrices.material, placement);
            if (by_uv) kernel.places = add_places(leaf.shape, surface);
            kernel.first_stop = ranges[leaf.material].first_stop, kernel.stops = ranges[leaf.material].stops;
            kernel.image.pixels = ranges[leaf.material].image.pixels;
            kernel.image.number = ranges[leaf.material].image.number;
            kernel.slack = ranges[leaf.material].slack;
            if (compared) compare(*material.rgb.pattern, ways[own_way].material, placement, true, kernel);
            kernel.ambient = Vec3<T>(cast<M>(scene.settings.ambient_light) * M(material.ambient));
            patterns.push_back(kernel);
            if (any_bent) bends.push_back(bend_of(material, matrices.material, placement, kernel.places));
        });
    }
    if (static_cast<double>(materials.size()) > World<T>::capacity)
        throw FileError(
            "this scene has patterns in more bodies than can be told apart in this precision; trace it with "
            "--precision double");
    world.patterns = patterns.data();
    if (any_bent) world.bends = bends.data();
    world.stops = stops.data();
}

template void WorldArrays<float>::add_patterns(const Scene&, const Placement&, bool);
template void WorldArrays<double>::add_patterns(const Scene&, const Placement&, bool);
template void WorldArrays<long double>::add_patterns(const Scene&, const Placement&, bool);

}  // namespace strahl
