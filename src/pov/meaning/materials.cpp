#include "pov/meaning/materials.h"

#include <algorithm>
#include <cmath>

namespace strahl::pov {
namespace {

/// Limits a value to a range that scene text allows.
double share(double v) { return std::isfinite(v) ? std::clamp(tidy(v), 0., 1.) : 0; }
double coefficient(double v) { return std::isfinite(v) ? std::clamp(tidy(v), 0., 1e9) : 0; }
Color coefficients(const Color& c) { return {coefficient(c.x), coefficient(c.y), coefficient(c.z)}; }

bool same_finish(const LayerValues& a, const LayerValues& b) {
    const FinishValues &own = a.finish, &other = b.finish;
    return own == other && !a.normal.blend && !b.normal.blend;
}

/// Returns a texture for a pattern of textures: their pigments in the pattern, with the finish and the normal of the
/// one that it shows most. That is the same if they differ in their pigments only.
std::shared_ptr<const LayerValues> without_blend(const LayerValues& layer, const NoteTaker& notes) {
    const std::shared_ptr<const LayerValues> itself(std::shared_ptr<void>(), &layer);
    if (layer.blend.ignored == word("material_map"))
        notes.left_out(layer.place, "all textures of a material_map but the first");
    if (!layer.blend || !layer.blend.map || layer.blend.map->entries.empty()) return itself;
    std::vector<std::shared_ptr<const LayerValues>> parts;
    auto pigments = std::make_shared<MapThing>(*layer.blend.map);
    std::size_t most = 0;
    double width = -1;
    for (std::size_t i = 0; i < pigments->entries.size(); ++i) {
        MapEntry& entry = pigments->entries[i];
        const auto* const texture = dynamic_cast<const TextureThing*>(entry.thing.get());
        if (!texture) return itself;
        if (texture->layers.size() > 1)
            notes.approximated(layer.blend.place, "of layers in a pattern of textures the uppermost is shown");
        parts.push_back(without_blend(texture->layers.back(), notes));
        entry.thing = std::make_shared<PigmentThing>(parts.back()->pigment);
        const double before = i > 0 ? pigments->entries[i - 1].at : 0;
        const double own = (i + 1 < pigments->entries.size() ? pigments->entries[i + 1].at : 1) - before;
        if (own > width) width = own, most = i;
    }
    if (!std::ranges::all_of(parts, [&](const auto& part) { return same_finish(*part, *parts[most]); }))
        notes.approximated(layer.blend.place, "the finish of a pattern of textures is that of one of them");
    auto own = std::make_shared<LayerValues>(*parts[most]);
    append(own->normal.blend.steps, layer.blend.steps);
    own->pigment.blend = layer.blend;
    own->pigment.blend.map = std::move(pigments);
    return own;
}

/// Is the object a light, or does it hold one?
bool shines(const ObjectThing& object) {
    return object.light || std::ranges::any_of(object.parts, [](const auto& part) { return shines(*part); });
}

}  // namespace

bool MaterialMaker::lit() {
    if (!any_light)
        any_light = std::ranges::any_of(contents.objects, [](const PlacedObject& own) { return shines(*own.object); });
    return *any_light;
}

bool MaterialMaker::has_pattern(const TextureThing& texture) {
    return std::ranges::any_of(texture.layers, [](const LayerValues& layer) {
        return layer.blend || layer.pigment.blend || layer.normal.blend;
    });
}

int MaterialMaker::without_patterns(int number) {
    Material own = (*this)[number];
    own.rgb = Pigment(own.rgb.color);
    own.bump = {};
    own.coats.clear();
    return materials.number(own);
}

int MaterialMaker::without(double Material::*part, int number) {
    Material own = (*this)[number];
    own.*part = 0;
    return materials.number(own);
}

int MaterialMaker::apart(int number) {
    Material own = (*this)[number];
    const auto mark = [](const std::shared_ptr<const Pattern>& pattern) {
        Pattern marked = *pattern;
        marked.transformations.push_back(Scale{DVec3(1)});
        return marked;
    };
    if (own.rgb.pattern) own.rgb = Pigment(mark(own.rgb.pattern));
    if (own.bump.pattern) own.bump.pattern = std::make_shared<const Pattern>(mark(own.bump.pattern));
    return materials.number(own);
}

/// Sets what a finish says apart from ambient and diffuse light.
void MaterialMaker::set_finish(Material& material, const FinishThing& finish, const MaterialUse& use) {
    const auto approximated = [&](bool applies, const char* text) {
        if (applies && !use.shadow_only) notes.approximated(finish.place, text);
    };
    if (finish.phong > 0) {
        material.specular = coefficient(finish.phong), material.pow = coefficient(finish.phong_size);
        approximated(finish.specular > 0, "of 'phong' and 'specular' only 'phong' is shown");
    } else if (finish.specular > 0) {
        // (n . h)^e and (r . l)^(e/4) are the same near the middle of a highlight.
        material.specular = coefficient(finish.specular), material.pow = coefficient(.25 / finish.roughness);
        approximated(true, "'specular' is a highlight of Phong's");
    }
    const bool shines = material.specular > 0;
    const ReflectionValues& reflection = finish.reflection;
    const bool fresnel = reflection.fresnel || reflection.least != reflection.most;
    // At a right angle to the surface there is the least reflection; its mean over all directions is nearer to that.
    const Color reflected = fresnel ? reflection.least + (reflection.most - reflection.least) * .2 : reflection.most;
    material.reflection = share(mean(reflected));
    approximated(fresnel, "reflection that depends on the angle is the same at all angles");
    approximated(material.reflection > 0 && !is_grey(reflected), "coloured reflection is grey");
    approximated(material.reflection > 0 && reflection.exponent != 1, "'exponent' of a reflection is 1");
    approximated(finish.metallic != 0 && shines, "highlights of metal have the colour of the light");
    approximated(reflection.metallic != 0 && material.reflection > 0, "reflection of metal is grey");
    approximated(finish.brilliance != 1 && finish.diffuse > 0, "'brilliance' is 1");
    approximated(finish.diffuse_behind > 0, "light from behind does not shine through");
    approximated(finish.conserve_energy && material.refraction > 0, "'conserve_energy' changes nothing");
    if (use.shadow_only) return;
    if (finish.crand != 0) notes.left_out(finish.place, "'crand'");
    if (finish.irid) notes.left_out(finish.place, "'irid'");
    if (finish.subsurface) notes.left_out(finish.place, "'subsurface'");
}

/// Sets the terms of a layer's finish.
void MaterialMaker::set_layer(Material& layer, const FinishThing& finish) {
    const Color light = max(contents.ambient_light, Color(1e-9));
    const Color ambient = finish.ambient + finish.emission / light;
    layer.ambient = coefficient(max_of(ambient));
    if (!is_grey(ambient)) layer.glow = coefficients(ambient / max_of(ambient));
    layer.diffuse = coefficient(finish.diffuse), layer.brilliance = coefficient(finish.brilliance);
    layer.specular = coefficient(finish.phong), layer.pow = coefficient(finish.phong_size);
    layer.blinn = coefficient(finish.specular);
    if (layer.blinn > 0) layer.roughness = std::clamp(tidy(finish.roughness), 1e-9, 1e9);
    if (layer.specular > 0 || layer.blinn > 0) layer.metallic = coefficient(finish.metallic);
    const ReflectionValues& reflection = finish.reflection;
    const double most = max_of(reflection.most);
    const auto approximated = [&](bool applies, const char* text) {
        if (applies) notes.approximated(finish.place, text);
    };
    if (reflection.most != DVec3(0)) {
        layer.reflection = share(most);
        if (!is_grey(reflection.most)) layer.mirror = coefficients(reflection.most / most);
        layer.fresnel = reflection.fresnel ? 1 : 0;
        if (reflection.least != reflection.most || reflection.fresnel) {
            layer.facing = share(mean(reflection.least) / mean(reflection.most));
            layer.falloff = coefficient(reflection.falloff);
        }
        layer.gilding = coefficient(reflection.metallic);
        approximated(most > 1, "reflection above 1 is 1");
        approximated(length(reflection.least - layer.facing * reflection.most) > 1e-6,
                     "the two colours of a reflection are of one colour");
        approximated(reflection.exponent != 1, "'exponent' of a reflection is 1");
    }
    approximated(finish.diffuse_behind > 0, "light from behind does not shine through");
    if (finish.crand != 0) notes.left_out(finish.place, "'crand'");
    if (finish.irid) notes.left_out(finish.place, "'irid'");
    if (finish.subsurface) notes.left_out(finish.place, "'subsurface'");
}

Material MaterialMaker::layered_material_of(const TextureThing& texture, const InteriorThing* interior,
                                            const MaterialUse& use, const Steps& way) {
    Material whole;
    bool lowest = true;
    const std::size_t count = std::min<std::size_t>(texture.layers.size(), 8);
    if (count < texture.layers.size())
        notes.approximated(texture.layers[0].place, "of the layers of a texture the upper eight are shown");
    for (std::size_t i = texture.layers.size() - count; i < texture.layers.size(); ++i) {
        const auto shown = without_blend(texture.layers[i], notes);
        const LayerValues& values = *shown;
        Look look = pigments.look_of(values.pigment, way, use.mapped);
        if (look.pigment.pattern && std::holds_alternative<ImagePattern>(look.pigment.pattern->kind) &&
            look.filter + look.transmit > 0)
            notes.approximated(values.place, "a picture that lets light through is opaque");
        Material layer{.rgb = look.clear(), .reflection = 0, .specular = 0, .pow = 40};
        set_layer(layer, values.finish);
        if (values.finish.refraction.value_or(1) != 1)
            notes.approximated(values.finish.place, "'refraction' of a finish is 1");
        approximate_opacity(layer, values);
        if (values.finish.conserve_energy && layer.reflection > 0 && layer.rgb.clear()) layer.conserve = 1;
        if (values.normal.blend && values.normal.amount != 0 && texture.layers.size() > 1)
            notes.approximated(values.normal.blend.place, i + 1 < texture.layers.size()
                                                              ? "only the uppermost layer has bumps"
                                                              : "bumps of the uppermost layer bend all layers");
        if (lowest)
            whole = std::move(layer);
        else
            whole.coats.push_back(std::move(layer));
        lowest = false;
    }
    whole.bump = pigments.bump_of(texture.layers.back().normal, way, use.mapped);
    if (interior) whole.ior = std::clamp(decimal(static_cast<float>(interior->ior)), 1e-9, 1e9);
    if (interior && std::fabs(interior->ior - 1) < 1.5e-7) whole.ior = 1;
    if (interior && whole.transmits()) {
        if (interior->fades()) {
            whole.fade_distance = std::clamp(tidy(interior->fade_distance), 1e-9, 1e9);
            whole.fade_power = coefficient(decimal(static_cast<float>(interior->fade_power)));
            whole.fade_color = min(coefficients(interior->fade_color), Color(1));
            if (whole.fade_color != coefficients(interior->fade_color) || interior->fade_power < 0)
                notes.approximated(interior->place, "light does not grow inside bodies");
        }
        if (interior->dispersion) notes.left_out(interior->place, "dispersion");
        if (interior->caustics) notes.left_out(interior->place, "caustics");
    }
    if (interior && interior->media) notes.left_out(interior->place, "media");
    return whole;
}

/// Before version 3.7 POV-Ray weakens what a layer scatters by another share: 1 - (filter max(r, g, b) + transmit).
void MaterialMaker::approximate_opacity(Material& layer, const LayerValues& values) {
    const double version = notes.in.version_given() ? notes.in.version() : 3.62;
    if (version >= 3.7 || layer.rgb.filter == 0) return;
    if (layer.rgb.pattern || layer.metallic > 0 || layer.gilding > 0)
        return notes.approximated(values.place, "a surface that filters light scatters as in version 3.7");
    // Makes the colour brighter and lets less of it through: the light that comes through stays the same.
    const double most = max_of(layer.rgb.color);
    layer.rgb.color = layer.rgb.color / most, layer.rgb.filter *= most;
    layer.diffuse = coefficient(layer.diffuse * most), layer.ambient = coefficient(layer.ambient * most);
}

/// Returns the material by the article's terms alone, or by POV-Ray's if those do not say all.
Material MaterialMaker::material_of(const TextureThing& texture, const InteriorThing* interior, const MaterialUse& use,
                                    const Steps& way) {
    if (use.shadow_only)
        return interior && interior->fades() ? layered_material_of(texture, interior, use, way)
                                             : plain_material_of(texture, interior, use, way);
    bool differs = false;
    notes.only_asked = &differs;
    Material plain = plain_material_of(texture, interior, use, way);
    notes.only_asked = nullptr;
    if (differs) return layered_material_of(texture, interior, use, way);
    return plain;
}

Material MaterialMaker::plain_material_of(const TextureThing& texture, const InteriorThing* interior,
                                          const MaterialUse& use, const Steps& way) {
    struct Layer {
        std::shared_ptr<const LayerValues> values;
        Look look;
        Color lit{0}, glow{0};  // shares of the light that is scattered and of ambient light
        double opacity = 1;
    };
    std::vector<Layer> layers;
    for (const LayerValues& own : texture.layers) {
        Layer layer{.values = without_blend(own, notes), .look = {}};
        layer.look = pigments.look_of(layer.values->pigment, way, use.mapped);
        if (layer.look.varies)
            notes.approximated(layer.values->place, "transparency that varies in a pattern is its mean");
        if (notes.only_asked && *notes.only_asked) return {};
        layers.push_back(std::move(layer));
    }
    Color through(1);  // the light that all layers let through
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
        const Color color = layer->look.pigment.color;
        const double f = layer->look.filter, t = layer->look.transmit;
        layer->opacity = 1 - f - t;
        layer->lit = through * color * (layer->opacity * layer->values->finish.diffuse);
        layer->glow = through * color * layer->opacity *
                      (layer->values->finish.ambient + layer->values->finish.emission / max_of(contents.ambient_light));
        through = through * (color * f + Color(t));
    }
    // The layer that scatters most is shown.
    const auto strength = [](const Layer& layer) { return mean(layer.lit) + mean(layer.glow); };
    std::size_t best = layers.size() - 1;
    int count = 0;
    for (std::size_t i = layers.size(); i-- > 0;) {
        if (strength(layers[i]) > strength(layers[best])) best = i;
        count += strength(layers[i]) > 0;
    }
    const Layer& shown = layers[best];
    const FinishThing& finish = shown.values->finish;
    if (count > 1 && !use.shadow_only)
        notes.approximated(shown.values->place, "of the layers of a texture the one that scatters most light is shown");
    if (notes.only_asked && *notes.only_asked) return {};

    const Pigment pigment = shown.look.opaque();
    Material material{.rgb = pigment, .reflection = 0, .diffuse = 0, .ambient = 0, .specular = 0, .pow = 40};
    double above = 1;
    for (std::size_t i = best + 1; i < layers.size(); ++i)
        above *= mean(layers[i].look.pigment.color * layers[i].look.filter + Color(layers[i].look.transmit));
    const Color ambient = finish.ambient + finish.emission / max_of(contents.ambient_light);
    material.diffuse = coefficient(finish.diffuse * shown.opacity * above);
    material.ambient = coefficient(mean(ambient) * shown.opacity * above);
    if (!is_grey(ambient) && !use.shadow_only)
        notes.approximated(finish.place, "coloured ambient light of a body is grey");
    material.bump = pigments.bump_of(layers.back().values->normal, way, use.mapped);
    const double lost = finish.refraction.value_or(1);
    through = through * lost;
    material.refraction = share(mean(through));
    if (interior) {
        const double ior = std::fabs(interior->ior - 1) < 1.5e-7 ? 1 : interior->ior;
        material.ior = std::clamp(decimal(static_cast<float>(ior)), 1e-9, 1e9);
    }
    // The highlights of all layers are added; the strongest is shown.
    const auto shine = [](const Layer& layer) { return layer.values->finish.phong + layer.values->finish.specular; };
    std::size_t brightest = best;
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (shine(layers[i]) > shine(layers[brightest])) brightest = i;
    FinishThing highlights = layers[brightest].values->finish;
    for (const Layer& layer : layers)
        if (mean(layer.values->finish.reflection.most) > mean(highlights.reflection.most))
            highlights.reflection = layer.values->finish.reflection;
    set_finish(material, highlights, use);

    if (material.refraction > 0) {
        const bool unlit = material.diffuse == 0 && material.ambient == 0;
        if (unlit && !use.no_shadow) material.rgb = Pigment(coefficients(through / material.refraction));
        if (use.shadow_only) return material;
        const TextPlace place = shown.values->place;
        constexpr int deep = 20;  // enough for rays through nine clear bodies
        if ((!interior || interior->ior == 1) && contents.max_trace_level < deep)
            notes.approximated(place, "rays that pass a clear body count for max_trace_level");
        const Color shadow = material.rgb.color * material.refraction;
        bool coloured = false, shaded = false;
        for (int c = 0; c < 3; ++c) {
            coloured |= std::fabs(through[c] - material.refraction) > 1e-6;
            shaded |= std::fabs(shadow[c] - through[c]) > 1e-6;
        }
        if (coloured) notes.approximated(place, "light that is seen through a body keeps its colour");
        if (shaded && !use.no_shadow && lit())
            notes.approximated(place, "the shadow of a transparent body has the body's colour");
        if (material.ior != 1 && std::fabs(material.reflection + material.refraction - lost) > 1e-6)
            notes.approximated(place, "total reflection is weaker");
        if (interior && interior->fades()) notes.approximated(interior->place, "light does not fade inside bodies");
        if (interior && interior->dispersion) notes.left_out(interior->place, "dispersion");
        if (interior && interior->caustics) notes.left_out(interior->place, "caustics");
    }
    if (interior && interior->media && !use.shadow_only) notes.left_out(interior->place, "media");
    return material;
}

}  // namespace strahl::pov
