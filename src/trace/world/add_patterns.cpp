// Makes kernels of patterns, each in the spaces of the bodies that have it.
#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "files/error.h"
#include "scene/leaves.h"
#include "trace/world/pattern_space.h"

namespace strahl {
namespace {

/// Returns the kernel of a material's pattern, without its stops, its pixels and its ambient light.
template <class T>
PatternKernel<T> kernel_of(const Material& material, const glm::dmat4& to_world, const Placement& placement) {
    PatternKernel<T> kernel{};
    kernel.form = PatternForm::constant;
    if (material.rgb.pattern) kernel = kernel_of<T>(*material.rgb.pattern, to_world, placement);
    kernel.diffuse = static_cast<T>(material.diffuse);
    kernel.refraction = static_cast<T>(material.refraction);
    return kernel;
}

}  // namespace

template <class T>
void WorldArrays<T>::add_image(const std::shared_ptr<const Pixels>& from, double gamma, bool colors,
                               ImageKernel<T>& kernel) {
    kernel.number = images->add(from, gamma, colors);
    kernel.pixels = (*images)[kernel.number].own->values.data();
}

template <class T>
void WorldArrays<T>::add_colors(const Pigment& pigment, PatternKernel<T>& kernel, double gamma,
                                const glm::dmat4& to_world, const Placement& placement) {
    using M = Made<T>;
    const Pattern* const pattern = pigment.pattern.get();
    const ImagePattern* const image = image_of(pigment.pattern);
    if (image) add_image(image->pixels, gamma, true, kernel.image);
    patterns.kept.push_back(pigment.pattern);
    const std::vector<ColorStop> colors =
        pattern ? pattern->colors : std::vector{ColorStop{0, pigment.color, pigment.filter, pigment.transmit}};
    std::vector<std::int32_t> nested(colors.size(), -1);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (!colors[i].pattern) continue;
        PatternKernel<T> own = kernel_of<T>(*colors[i].pattern, matrix_of(*pattern, to_world), placement);
        own.places = kernel.places;
        Pigment inner(Color(0));
        inner.pattern = colors[i].pattern;
        add_colors(inner, own, gamma, matrix_of(*pattern, to_world), placement);
        nested[i] = static_cast<std::int32_t>(patterns.nested.size());
        patterns.nested.push_back(own);
    }
    kernel.nests = pattern && pattern->nests();
    kernel.first_stop = static_cast<std::int32_t>(patterns.stops.size());
    for (double before = 0; const ColorStop& stop : colors) {
        patterns.stops.push_back({static_cast<T>(stop.at), static_cast<T>(1 / (M(stop.at) - before)),
                                  cast<T>(stop.color), static_cast<T>(stop.filter), static_cast<T>(stop.transmit),
                                  nested[std::size_t(&stop - colors.data())]});
        before = stop.at;
    }
    kernel.stops = static_cast<std::int32_t>(colors.size());
    if constexpr (!std::is_same_v<T, float>) measure_colors(colors, image, kernel.slack);
}

template <class T>
PlacesKernel WorldArrays<T>::add_places(const Shape& shape, int first_surface) {
    const Mesh* const mesh = std::get_if<Mesh>(&shape);
    if (!mesh || mesh->data->places.empty()) return {};
    patterns.meshes.push_back(mesh->data);
    return {first_surface, static_cast<std::int32_t>(mesh->data->triangles.size()), mesh->data->place_numbers(),
            mesh->data->places.data()};
}

template <class T>
void WorldArrays<T>::add_sky(const Scene& scene, bool proves) {
    const Pattern* const pattern = scene.background.pattern.get();
    if (!pattern && scene.background_coats.empty()) return;
    const auto add = [&](const Pigment& pigment, PatternKernel<T>& kernel) {
        kernel = {};
        kernel.form = PatternForm::constant;
        if (pigment.pattern) kernel = kernel_of<T>(*pigment.pattern, glm::dmat4(1), {});
        add_colors(pigment, kernel, scene.settings.assumed_gamma, glm::dmat4(1), {});
    };
    add(scene.background, patterns.sky.emplace());
    for (const Pigment& coat : scene.background_coats) add(coat, patterns.coats.emplace_back());
    if (proves && pattern && !pattern->nests() && scene.background_coats.empty())
        compare(*pattern, {}, {}, true, *patterns.sky);
}
template <class T>
void WorldArrays<T>::add_patterns(const Scene& scene, const Placement& placement, bool proves) {
    using M = Made<T>;
    add_sky(scene, proves);
    const bool any_bent = std::ranges::any_of(scene.materials, &Material::bends);
    const auto varies = [&](const Material& m) { return any_bent || m.patterned(); };
    if (std::ranges::none_of(scene.materials, varies)) return;
    auto& [list, bends, stops, sky, nested, coats, meshes, leaf_materials, first_leaf, kept] = patterns;
    world.patterns.first = static_cast<int>(materials.size());
    std::vector<PatternKernel<T>> ranges(scene.materials.size());
    for (std::size_t i = 0; i < ranges.size(); ++i)
        if (varies(scene.materials[i]))
            add_colors(scene.materials[i].rgb, ranges[i], scene.settings.assumed_gamma, glm::dmat4(1), placement);
    const bool any_uv = std::ranges::any_of(scene.materials, &Material::by_uv), finished = scene.finished();
    std::map<std::tuple<int, int, std::array<double, 16>>, std::int32_t> numbers;
    ItemCounts before;  // set for patterns by uv only
    for (const Primitive& primitive : scene.primitives) {
        first_leaf.push_back(static_cast<std::int32_t>(leaf_materials.size()));
        const std::vector<LeafWay> ways = proves ? ways_of(primitive) : std::vector<LeafWay>();
        for_each_leaf_placed(primitive, [&](const Primitive& leaf, const LeafMatrices& matrices) {
            const Material& material = scene.materials[leaf.material];
            const int surface = static_cast<int>(before.surfaces);
            if (any_uv) count_items<T>(leaf, before);
            const std::size_t own_way = leaf_materials.size() - first_leaf.back();
            if (!varies(material)) return leaf_materials.push_back(leaf.material);
            const bool by_uv = material.by_uv(), nests = material.rgb.pattern && material.rgb.pattern->nests();
            const bool compared = proves && material.rgb.pattern && !nests;
            std::array<double, 16> values{};  // the entries of the matrix, if they matter
            for (int i = 0; i < 16 && material.patterned(); ++i) values[i] = matrices.material[i / 4][i % 4];
            const auto [entry, is_new] = numbers.try_emplace({leaf.material, by_uv ? surface : -1, values},
                                                             static_cast<std::int32_t>(materials.size()));
            leaf_materials.push_back(entry->second);
            if (!is_new) {
                // Equal matrices made by other steps may differ in exact arithmetic.
                const int known = entry->second - world.patterns.first;
                if (compared) compare(*material.rgb.pattern, ways[own_way].material, placement, false, list[known]);
                if (proves && any_bent) compare(material, ways[own_way].material, placement, false, bends[known]);
                return;
            }
            materials.push_back(MaterialKernel<T>(materials[leaf.material]));
            copied_materials.push_back(leaf.material);
            PatternKernel<T> kernel = kernel_of<T>(material, matrices.material, placement);
            if (by_uv) kernel.places = add_places(leaf.shape, surface);
            kernel.first_stop = ranges[leaf.material].first_stop, kernel.stops = ranges[leaf.material].stops;
            kernel.image.pixels = ranges[leaf.material].image.pixels;
            kernel.image.number = ranges[leaf.material].image.number;
            kernel.slack = ranges[leaf.material].slack;
            if (nests) add_colors(material.rgb, kernel, scene.settings.assumed_gamma, matrices.material, placement);
            if (compared) compare(*material.rgb.pattern, ways[own_way].material, placement, true, kernel);
            kernel.ambient = Vec3<T>(cast<M>(scene.settings.ambient_light) * M(material.ambient));
            if (finished) add_finish(material, scene, matrices.material, placement, kernel.places);
            list.push_back(kernel);
            if (any_bent) bends.push_back(bend_of(material, matrices.material, placement, kernel.places));
            if (proves && any_bent) compare(material, ways[own_way].material, placement, true, bends.back());
        });
    }
    if (static_cast<double>(materials.size()) > World<T>::capacity)
        throw FileError(
            "this scene has patterns in more bodies than can be told apart in this precision; trace it with "
            "--precision double");
}

template void WorldArrays<float>::add_image(const std::shared_ptr<const Pixels>&, double, bool, ImageKernel<float>&);
template void WorldArrays<double>::add_image(const std::shared_ptr<const Pixels>&, double, bool, ImageKernel<double>&);
template void WorldArrays<long double>::add_image(const std::shared_ptr<const Pixels>&, double, bool,
                                                  ImageKernel<long double>&);
template void WorldArrays<float>::add_patterns(const Scene&, const Placement&, bool);
template void WorldArrays<double>::add_patterns(const Scene&, const Placement&, bool);
template void WorldArrays<long double>::add_patterns(const Scene&, const Placement&, bool);

}  // namespace strahl
