#include "pov/meaning/materials.h"

#include <algorithm>
#include <cmath>

namespace strahl::pov {
namespace {

/// Limits a value to a range that scene text allows.
double share(double v) { return std::isfinite(v) ? std::clamp(tidy(v), 0., 1.) : 0; }
double coefficient(double v) { return std::isfinite(v) ? std::clamp(tidy(v), 0., 1e9) : 0; }
Color coefficients(const Color& c) { return {coefficient(c.x), coefficient(c.y), coefficient(c.z)}; }

/// Returns the texture with a pattern of textures replaced by the one that it shows most.
LayerValues without_blend(const LayerValues& layer, const NoteTaker& notes) {
    if (!layer.blend || !layer.blend.map || layer.blend.map->entries.empty()) return layer;
    const auto& entries = layer.blend.map->entries;
    std::size_t most = 0;
    double width = -1;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double own = (i + 1 < entries.size() ? entries[i + 1].at : 1) - (i > 0 ? entries[i - 1].at : 0);
        if (own > width && dynamic_cast<const TextureThing*>(entries[i].thing.get())) width = own, most = i;
    }
    const auto* const texture = dynamic_cast<const TextureThing*>(entries[most].thing.get());
    notes.approximated(layer.blend.place, "a pattern of textures is one of them");
    if (!texture) return layer;
    LayerValues own = texture->layers.back();
    transform(own, layer.blend.steps);
    return without_blend(own, notes);
}

}  // namespace

bool MaterialMaker::has_pattern(const TextureThing& texture) {
    return std::ranges::any_of(texture.layers, [](const LayerValues& layer) {
        return layer.blend || layer.pigment.blend || layer.normal.blend;
    });
}

int MaterialMaker::without_patterns(int number) {
    Material own = (*this)[number];
    own.rgb = Pigment(own.rgb.color);
    own.bump = {};
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

Material MaterialMaker::material_of(const TextureThing& texture, const InteriorThing* interior, const MaterialUse& use,
                                    const Steps& way) {
    struct Layer {
        LayerValues values;
        Look look;
        Color lit{0}, glow{0};  // shares of the light that is scattered and of ambient light
        double opacity = 1;
    };
    std::vector<Layer> layers;
    for (const LayerValues& own : texture.layers) {
        Layer layer{.values = without_blend(own, notes), .look = {}};
        layer.look = pigments.look_of(layer.values.pigment, way, use.mapped);
        layers.push_back(std::move(layer));
    }
    Color through(1);  // the light that all layers let through
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
        const Color color = layer->look.pigment.color;
        const double f = layer->look.filter, t = layer->look.transmit;
        layer->opacity = 1 - f - t;
        layer->lit = through * color * (layer->opacity * layer->values.finish.diffuse);
        layer->glow = through * color * layer->opacity *
                      (layer->values.finish.ambient + layer->values.finish.emission / max_of(contents.ambient_light));
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
    const FinishThing& finish = shown.values.finish;
    if (count > 1 && !use.shadow_only)
        notes.approximated(shown.values.place, "of the layers of a texture the one that scatters most light is shown");

    Material material{.rgb = shown.look.pigment, .reflection = 0, .diffuse = 0, .ambient = 0, .specular = 0, .pow = 40};
    double above = 1;
    for (std::size_t i = best + 1; i < layers.size(); ++i)
        above *= mean(layers[i].look.pigment.color * layers[i].look.filter + Color(layers[i].look.transmit));
    const Color ambient = finish.ambient + finish.emission / max_of(contents.ambient_light);
    material.diffuse = coefficient(finish.diffuse * shown.opacity * above);
    material.ambient = coefficient(mean(ambient) * shown.opacity * above);
    if (!is_grey(ambient) && !use.shadow_only)
        notes.approximated(finish.place, "coloured ambient light of a body is grey");
    material.bump = pigments.bump_of(layers.back().values.normal, way, use.mapped);
    const double lost = finish.refraction.value_or(1);
    through = through * lost;
    material.refraction = share(mean(through));
    if (interior) {
        const double ior = std::fabs(interior->ior - 1) < 1.5e-7 ? 1 : interior->ior;
        material.ior = std::clamp(decimal(static_cast<float>(ior)), 1e-9, 1e9);
    }
    // The highlights of all layers are added; the strongest is shown.
    const auto shine = [](const Layer& layer) { return layer.values.finish.phong + layer.values.finish.specular; };
    std::size_t brightest = best;
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (shine(layers[i]) > shine(layers[brightest])) brightest = i;
    FinishThing highlights = layers[brightest].values.finish;
    for (const Layer& layer : layers)
        if (mean(layer.values.finish.reflection.most) > mean(highlights.reflection.most))
            highlights.reflection = layer.values.finish.reflection;
    set_finish(material, highlights, use);

    if (material.refraction > 0) {
        const bool unlit = material.diffuse == 0 && material.ambient == 0;
        if (unlit && !use.no_shadow) material.rgb = Pigment(coefficients(through / material.refraction));
        if (use.shadow_only) return material;
        unbent |= !interior || interior->ior == 1;
        const TextPlace place = shown.values.place;
        const Color shadow = material.rgb.color * material.refraction;
        bool coloured = false, shaded = false;
        for (int c = 0; c < 3; ++c) {
            coloured |= std::fabs(through[c] - material.refraction) > 1e-6;
            shaded |= std::fabs(shadow[c] - through[c]) > 1e-6;
        }
        if (coloured) notes.approximated(place, "light that is seen through a body keeps its colour");
        if (shaded && !use.no_shadow)
            notes.approximated(place, "the shadow of a transparent body has the body's colour");
        if (material.ior != 1 && std::fabs(material.reflection + material.refraction - lost) > 1e-6)
            notes.approximated(place, "total reflection is weaker");
        if (interior && interior->fades) notes.approximated(interior->place, "light does not fade inside bodies");
        if (interior && interior->dispersion) notes.left_out(interior->place, "dispersion");
        if (interior && interior->caustics) notes.left_out(interior->place, "caustics");
    }
    if (interior && interior->media && !use.shadow_only) notes.left_out(interior->place, "media");
    return material;
}

}  // namespace strahl::pov
