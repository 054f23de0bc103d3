// Makes kernels of POV-Ray's finishes.
#include <algorithm>
#include <utility>

#include "trace/world/pattern_space.h"

namespace strahl {
namespace {

/// Do rays that go on from a material have colours, or strengths that vary with the angle, or are some not counted as a
/// new generation?
bool sends_colors(const Material& own) {
    const auto reflects = [](const Material& m) { return m.reflection > 0; };
    const bool even = own.mirror == Color(own.mirror.x) && own.gilding == 0 && own.irid == 0 && own.facing == 1 &&
                      own.fresnel == 0 && own.coats.empty();
    return (!even && (reflects(own) || std::ranges::any_of(own.coats, reflects))) || own.rgb.clear() || own.seen == 0 ||
           own.mirrored == 0 || own.shares() || (own.transmits() && (!own.coats.empty() || own.fades()));
}

}  // namespace

/// Adds the finish of a material whose body has the matrix `to_world`.
template <class T>
void WorldArrays<T>::add_finish(const Material& material, const Scene& scene, const glm::dmat4& to_world,
                                const Placement& placement, const PlacesKernel& places) {
    using M = Made<T>;
    const auto number = [](double v) { return static_cast<T>(v); };
    const auto set_pattern = [&](const Pigment& pigment, double gamma, PatternKernel<T>& pattern) {
        pattern.form = PatternForm::constant;
        if (pigment.pattern) pattern = kernel_of<T>(*pigment.pattern, to_world, placement);
        pattern.places = places;
        add_colors(pigment, pattern, gamma, to_world, placement);
    };
    world.finishes.carries |= sends_colors(material);
    const auto first_bend = static_cast<std::int32_t>(finishes.bends.size());
    const auto add_layer = [&](const Material& own) {
        LayerKernel<T> layer{};
        set_pattern(own.rgb, scene.settings.assumed_gamma, layer.pattern);
        layer.ambient = Vec3<T>(cast<M>(scene.settings.ambient_light * own.glow) * M(own.ambient));
        layer.diffuse = number(own.diffuse), layer.behind = number(own.behind);
        layer.irid = number(own.irid), layer.film = number(own.film);
        layer.brilliance = number(own.brilliance);
        layer.phong = number(own.specular), layer.phong_size = number(own.pow);
        layer.blinn = number(own.blinn), layer.blinn_size = number(1 / own.roughness);
        layer.metallic = number(own.metallic), layer.gilding = number(own.gilding);
        layer.mirror = cast<T>(own.reflection * own.mirror);
        layer.facing = number(own.facing), layer.falloff = number(own.falloff), layer.fresnel = own.fresnel > 0;
        world.finishes.fresnel |= layer.fresnel, world.finishes.film |= layer.irid > 0;
        layer.conserves = own.conserve > 0, layer.old_opacity = own.old_opacity > 0;
        layer.share = -1, layer.outside = layer.inside = 1, layer.bend = 0;
        if (&own != &material && material.bends_apart(own)) {
            finishes.bends.push_back(bend_of(own, to_world, placement, places));
            layer.bend = static_cast<std::int32_t>(finishes.bends.size()) - first_bend;
        }
        finishes.layers.push_back(layer);
    };
    const auto end_stack = [&](const Material& lowest) {
        LayerKernel<T>& layer = finishes.layers.back();
        layer.share = static_cast<std::int32_t>(finishes.shares.size());
        layer.outside = number(lowest.outside), layer.inside = number(lowest.inside);
        set_pattern(lowest.share, 0, finishes.shares.emplace_back());
    };
    const auto scatters = [](double diffuse) { return diffuse > 0; };
    const bool clear = material.transmits() && material.rgb.clear();
    finishes.list.push_back({material.plain(),
                             static_cast<std::int32_t>(finishes.layers.size()),
                             static_cast<std::int32_t>(1 + material.coats.size()),
                             number(material.refraction),
                             number(material.ior),
                             number(clear ? material.clarity : material.reflection + material.refraction),
                             number(material.clarity),
                             clear,
                             scene.settings.passed_over > 0 && !material.transmits(),
                             material.shadow > 0,
                             material.seen > 0,
                             material.mirrored > 0,
                             material.both_sides > 0,
                             material.behind > 0 || std::ranges::any_of(material.coats, scatters, &Material::behind),
                             material.common > 0,
                             finishes.group_number(material.group),
                             0,
                             0,
                             number(material.fades() ? 1 / (material.fade_distance * placement.scale) : 0),
                             number(material.fade_power),
                             cast<T>(material.fade_color)});
    world.finishes.follows |= material.fades() || (material.transmits() && material.has_sides());
    world.finishes.hides |= !(material.seen > 0 && material.mirrored > 0);
    world.finishes.behind |= finishes.list.back().both_sides || finishes.list.back().behind;
    const Material* lowest = &material;
    add_layer(material);
    for (const Material& coat : material.coats) {
        if (coat.shares()) end_stack(*std::exchange(lowest, &coat));
        add_layer(coat);
    }
    if (lowest != &material || material.shares()) end_stack(*lowest);
    FinishKernel<T>& finish = finishes.list.back();
    finish.first_bend = first_bend, finish.bends = static_cast<std::int32_t>(finishes.bends.size()) - first_bend;
    world.finishes.most_bends = std::max(world.finishes.most_bends, int(finish.bends));
}

/// Adds the finishes of the scene's materials, if it has any of POV-Ray's. Those of patterned ones follow later, for
/// each space in which they are.
template <class T>
void WorldArrays<T>::add_finishes(const Scene& scene, const Placement& placement) {
    if (!scene.finished()) return;
    for (const Light& light : scene.lights)
        if (light.group > 0) finishes.groups.push_back(light.group);
    const auto chooses = [](const Material& own) { return own.common == 0; };
    world.finishes.groups = !finishes.groups.empty() || std::ranges::any_of(scene.materials, chooses);
    for (std::size_t i = 0; const Material& own : scene.materials) {
        add_finish(own, scene, glm::dmat4(1), placement, {});
        MaterialKernel<T>& kernel = materials[i++];
        if (own.plain()) continue;
        Color reflected(0);
        double shine = 0;
        const auto add = [&](const Material& layer) {
            reflected = reflected + layer.reflection * layer.mirror;
            shine += layer.specular + layer.blinn;
        };
        add(own);
        const Color through = own.passed(own.refraction * own.rgb.color);
        for (const Material& coat : own.coats) add(coat);
        const auto most = [](const Color& c) { return std::max({c.x, c.y, c.z}); };
        kernel.filter = own.shadow > 0 ? cast<T>(through) : Vec3<T>(1);  // shadow rays multiply light by it
        kernel.refraction = own.transmits() ? static_cast<T>(std::max(most(through), own.refraction)) : T(0);
        kernel.reflection = static_cast<T>(most(reflected));
        kernel.specular = static_cast<T>(shine);
        world.transparent |= kernel.refraction > 0 || own.shadow == 0;
    }
    world.finishes.bailout = static_cast<T>(scene.settings.adc_bailout);
    world.finishes.carries |= world.finishes.bailout > 0 || (scene.fog && scene.fog->filter > 0);
}

template void WorldArrays<float>::add_finish(const Material&, const Scene&, const glm::dmat4&, const Placement&,
                                             const PlacesKernel&);
template void WorldArrays<double>::add_finish(const Material&, const Scene&, const glm::dmat4&, const Placement&,
                                              const PlacesKernel&);
template void WorldArrays<long double>::add_finish(const Material&, const Scene&, const glm::dmat4&, const Placement&,
                                                   const PlacesKernel&);
template void WorldArrays<float>::add_finishes(const Scene&, const Placement&);
template void WorldArrays<double>::add_finishes(const Scene&, const Placement&);
template void WorldArrays<long double>::add_finishes(const Scene&, const Placement&);

}  // namespace strahl
