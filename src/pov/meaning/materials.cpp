#include "pov/meaning/materials.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "pov/things/blob_colors.h"
#include "pov/things/pattern_values.h"

namespace strahl::pov {
namespace {

constexpr std::size_t most_layers = 8;

/// Limits a value to a range that scene text allows.
double share(double v) { return std::isfinite(v) ? std::clamp(tidy(v), 0., 1.) : 0; }
double signed_number(double v) { return std::isfinite(v) ? std::clamp(tidy(v), -1e9, 1e9) : 0; }
double coefficient(double v) { return std::max(signed_number(v), 0.); }
Color signed_numbers(const Color& c) { return {signed_number(c.x), signed_number(c.y), signed_number(c.z)}; }
Color coefficients(const Color& c) { return max(signed_numbers(c), Color(0)); }

/// Returns the index of refraction; one that can't be told from 1 is 1.
double ior_of(const InteriorThing& interior, const NoteTaker& notes) {
    if (std::fabs(interior.ior - 1) < 1.5e-7) return 1;
    return std::clamp(kept(interior.ior, notes.in.options.as_text), 1e-9, 1e9);
}

bool same_finish(const LayerValues& a, const LayerValues& b) {
    const FinishValues &own = a.finish, &other = b.finish;
    return own == other && !a.normal.blend && !b.normal.blend;
}

/// Returns the pattern of a texture whose pattern shows textures, or null.
const Blend* blend_of(const TextureThing& texture) {
    const Blend& blend = texture.layers.back().blend;
    const auto is_texture = [](const MapEntry& entry) {
        return dynamic_cast<const TextureThing*>(entry.thing.get()) != nullptr;
    };
    const bool any = blend && blend.map && !blend.map->entries.empty();
    return any && std::ranges::all_of(blend.map->entries, is_texture) ? &blend : nullptr;
}

/// Are there more textures than this in a pattern of textures, and in those within it? Takes them from `left`.
bool holds_more(const Blend& blend, int& left) {
    if (!blend.map) return false;
    return std::ranges::any_of(blend.map->entries, [&](const MapEntry& entry) {
        const auto* const texture = dynamic_cast<const TextureThing*>(entry.thing.get());
        return left-- == 0 || (texture && holds_more(texture->layers.back().blend, left));
    });
}

/// Returns a texture for a pattern of textures: their pigments in the pattern, with the finish and the normal of the
/// one that it shows most. That is the same if they differ in their pigments only; approximated(place, text) is called
/// for what is not the same.
std::shared_ptr<const LayerValues> without_blend(const LayerValues& layer, const NoteTaker& notes,
                                                 const auto& approximated) {
    const std::shared_ptr<const LayerValues> itself(std::shared_ptr<void>(), &layer);
    if (layer.blend.ignored == word("material_map"))
        notes.left_out(layer.place, "all textures of a material_map but the first");
    if (const FilterColor& own = layer.pigment.color; !layer.pigment.blend && own.filter + own.transmit < 0)
        approximated(layer.place, "filter and transmit below 0: such a surface takes no light from behind it");
    if (int left = 4096; holds_more(layer.blend, left)) {
        approximated(layer.blend.place, "a pattern of thousands of textures is not shown");
        return itself;
    }
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
            approximated(layer.blend.place, "of layers in a pattern of textures the uppermost is shown");
        parts.push_back(without_blend(texture->layers.back(), notes, approximated));
        entry.thing = std::make_shared<PigmentThing>(parts.back()->pigment);
        const double before = i > 0 ? pigments->entries[i - 1].at : 0;
        const double own = (i + 1 < pigments->entries.size() ? pigments->entries[i + 1].at : 1) - before;
        if (own > width) width = own, most = i;
    }
    if (!std::ranges::all_of(parts, [&](const auto& part) { return same_finish(*part, *parts[most]); }))
        approximated(layer.blend.place, "the finish of a pattern of textures is that of one of them");
    auto own = std::make_shared<LayerValues>(*parts[most]);
    append(own->normal.blend.steps, layer.blend.steps);
    own->pigment.blend = layer.blend;
    own->pigment.blend.map = std::move(pigments);
    return own;
}

/// Returns the ambient light of a finish, with its emission as a share of the scene's ambient light.
Color ambient_of(const FinishThing& finish, const PovContents& contents) {
    return finish.ambient + finish.emission / max(ambient_light_of(contents), Color(1e-9));
}

/// Calls tell(is_negative, text) for each number of a finish that may be below 0, where POV-Ray takes away light or
/// lights more, and scene text cannot.
void each_negative(const FinishThing& finish, const PovContents& contents, const auto& tell) {
    const auto negative = [](const Color& c) { return std::min({c.x, c.y, c.z}) < 0; };
    tell(negative(ambient_of(finish, contents)), "ambient light or emission below 0 is 0");
    tell((finish.diffuse > 0 || finish.diffuse_behind > 0) && finish.brilliance < 0, "brilliance below 0 is 0");
    tell(negative(finish.reflection.least) || negative(finish.reflection.most), "reflection below 0 is 0");
    tell(finish.phong > 0 && finish.phong_size < 0, "phong_size below 0 is 0");
    tell(finish.specular > 0 && finish.roughness < 0, "roughness below 0 is 1e-9");
}

/// A texture that patterns of textures show.
struct ShownTexture {
    std::vector<LayerValues> layers;  // the lowest first, in the space of the outermost pattern
    std::vector<const void*> path;    // the patterns around it, and itself: it may stand in their maps several times
};

/// Moves a pigment or a normal from the space of a pattern that shows it into the space around this.
template <class T>
void move_out(T& own, const Blend& around) {
    const bool moves = !around.warps.empty() || around.turbulence != DVec3(0);
    if (!own.blend || !moves) return append(own.blend.steps, around.steps);
    // A mean of one is in the space that warps and turbulence lead to.
    T whole;
    whole.blend = around;
    if (around.word == word("marble") || around.word == word("wood")) whole.blend.turbulence = DVec3(0);
    whole.blend.word = word("average"), whole.blend.values = nullptr, whole.blend.image = nullptr;
    whole.blend.function = nullptr, whole.blend.pigment = nullptr, whole.blend.slopes = nullptr;
    if constexpr (std::is_same_v<T, NormalThing>) own.blend.uv = false;  // the mean finds the place by uv
    auto map = std::make_shared<MapThing>();
    map->entries.push_back({.at = 1, .thing = std::make_shared<T>(std::move(own))});
    whole.blend.map = std::move(map);
    own = std::move(whole);
}
void move_out(LayerValues& layer, const Blend& around) {
    if (around.uv) set_by_uv(layer, around.moved_by_uv);
    move_out(layer.pigment, around), move_out(layer.normal, around);
}

/// Collects the textures that patterns of textures show, those within each other in the order of their maps. Returns
/// false if there are too many.
bool collect(const TextureThing& texture, std::vector<const Blend*>& around, std::vector<ShownTexture>& all) {
    constexpr std::size_t most = 64, deepest = 4;
    const Blend* const blend = blend_of(texture);
    if (all.size() == most || around.size() > deepest) return false;
    if (!blend) {
        all.push_back({texture.layers, {around.begin(), around.end()}});
        all.back().path.push_back(&texture);
        for (LayerValues& layer : all.back().layers)
            for (std::size_t i = around.size(); i-- > 0;) move_out(layer, *around[i]);
        return true;
    }
    around.push_back(blend);
    const bool fits = std::ranges::all_of(blend->map->entries, [&](const MapEntry& entry) {
        return collect(*static_cast<const TextureThing*>(entry.thing.get()), around, all);
    });
    around.pop_back();
    return fits;
}

/// Returns the share of textures that are shown: a pigment that is white where they are, and black elsewhere. `next`
/// is the number of the first texture of `texture` among all that were collected.
PigmentThing share_of(const TextureThing& texture, const std::vector<std::size_t>& stacks, std::size_t stack,
                      std::size_t& next) {
    const Blend* const blend = blend_of(texture);
    const float white = !blend && stacks[next++] == stack ? 1.f : 0.f;
    PigmentThing own;
    own.color = {white, white, white};
    if (!blend) return own;
    own.blend = *blend;
    auto map = std::make_shared<MapThing>(*blend->map);
    for (MapEntry& entry : map->entries) {
        const PigmentThing part = share_of(*static_cast<const TextureThing*>(entry.thing.get()), stacks, stack, next);
        entry.color = part.color;
        entry.thing = part.blend ? std::make_shared<PigmentThing>(part) : nullptr;
    }
    const auto same = [&](const MapEntry& entry) { return !entry.thing && entry.color == map->entries[0].color; };
    if (std::ranges::all_of(map->entries, same))
        own.color = map->entries[0].color, own.blend = {};
    else
        own.blend.map = std::move(map);
    return own;
}

/// Returns the share of some of the textures at a triangle's corners: 1 at their corners, 0 at others. As in POV-Ray
/// a texture of less than `least` does not count.
Pigment share_of_corners(const std::vector<std::size_t>& stacks, std::size_t stack, double least) {
    const auto own = [&](std::size_t corner) { return double(stacks[corner] == stack); };
    const bool falls = own(0) > 0;
    const double x = falls ? 1 - own(1) : own(1), y = falls ? 1 - own(2) : own(2);
    // A ramp from 0 to 1/2 across the triangle.
    Pattern ramp{.kind = Gradient{{x, y, 0}}, .colors = {}, .transformations = {Scale{DVec3(2 / std::hypot(x, y))}}};
    ramp.by_uv = true;
    for (const auto& [at, share] : {std::pair(0., 0.), {least, 0.}, {least, least}, {1., 1.}})
        ramp.colors.push_back({falls ? .5 - at / 2 : at / 2, Color(share)});
    if (falls) std::ranges::reverse(ramp.colors);
    return Pigment(std::move(ramp));
}

/// Returns how many layers of a texture are below one that lets no light through.
std::ptrdiff_t hidden_layers_of(const TextureThing& texture) {
    const auto hides = [](const LayerValues& layer) { return !layer.blend && !PigmentMaker::is_clear(layer.pigment); };
    const auto top = std::find_if(texture.layers.rbegin(), texture.layers.rend() - 1, hides);
    return texture.layers.rend() - 1 - top;
}

TextureThing without_hidden_layers(TextureThing texture) {
    texture.layers.erase(texture.layers.begin(), texture.layers.begin() + hidden_layers_of(texture));
    return texture;
}

/// Leaves the bumps of coats out that are those of the material, and makes those flat that have none.
void share_bumps(Material& material) {
    for (Material& coat : material.coats)
        if (coat.bump == material.bump)
            coat.bump = {};
        else if (!coat.bump.pattern)
            coat.bump.pattern = material.bump.pattern;
}

/// Gives coats of an opaque material that reflect as other layers do normals of their own, which are the same: a ray
/// goes on from each, as in POV-Ray, where its own strength decides when it ends.
void part_reflections(Material& material) {
    if (material.transmits() || material.shares()) return;
    bool reflects = material.reflection > 0;
    for (Material& coat : material.coats) {
        if (coat.shares()) return;
        if (coat.reflection == 0 || !std::exchange(reflects, true) || material.bends_apart(coat)) continue;
        coat.bump = material.bump;
        Pattern same = material.bump.pattern ? *material.bump.pattern : Pattern();
        same.transformations.push_back(Scale{DVec3(1)});
        coat.bump.pattern = std::make_shared<const Pattern>(std::move(same));
    }
}

/// Is the object a light, or does it hold one?
bool shines(const ObjectThing& object) {
    return object.light || std::ranges::any_of(object.parts, [](const auto& part) { return shines(*part); });
}

}  // namespace

Color ambient_light_of(const PovContents& contents) {
    return max(contents.ambient_light, Color(contents.emits ? 1e-7 : 0));
}

bool MaterialMaker::lit() {
    if (!any_light)
        any_light = std::ranges::any_of(contents.objects, [](const PlacedObject& own) { return shines(*own.object); });
    return *any_light;
}

bool MaterialMaker::has_pattern(const TextureThing& texture) {
    if (texture.inside && has_pattern(*texture.inside)) return true;
    for (const auto& corner : texture.corners)
        if (has_pattern(*corner)) return true;
    return std::ranges::any_of(texture.layers, [](const LayerValues& layer) {
        return layer.blend || layer.pigment.blend || layer.pigment.colors || layer.normal.blend;
    });
}

bool MaterialMaker::by_uv(const std::shared_ptr<const TextureThing>& texture) {
    bool holds = false, any = texture->inside && by_uv(texture->inside);
    for (const LayerValues& layer : texture->layers) {
        any |= layer.pigment.blend.uv || layer.normal.blend.uv || layer.blend.uv;
        holds |= layer.blend.map != nullptr;
    }
    if (any || !holds) return any;
    const auto [known, is_new] = known_by_uv.try_emplace(texture, false);
    if (!is_new) return known->second;
    for (const LayerValues& layer : texture->layers)
        for (const MapEntry& entry : layer.blend.map ? layer.blend.map->entries : std::vector<MapEntry>())
            if (const auto inner = std::dynamic_pointer_cast<const TextureThing>(entry.thing)) any |= by_uv(inner);
    return known_by_uv[texture] = any;
}

std::shared_ptr<const TextureThing> MaterialMaker::blended(
    const Blob& blob, const std::vector<std::shared_ptr<const TextureThing>>& textures, const TextureThing& whole,
    const Steps& way) {
    const auto moved_whole = moved(whole, way);
    // Textures of one finish are one whose pigments blend. All lumps without a texture have the number of the first.
    struct FinishGroup {
        const LayerValues* first;
        std::vector<std::size_t> lumps;
    };
    std::vector<FinishGroup> groups;
    std::vector<std::size_t> numbers(textures.size());
    const auto layer_at = [&](std::size_t i) -> const LayerValues& {
        return (textures[i] ? *textures[i] : *moved_whole).layers[0];
    };
    const auto one = [&](const LayerValues& a, const LayerValues& b) {
        if (&a == &b) return true;
        const bool clear = PigmentMaker::is_clear(a.pigment) || PigmentMaker::is_clear(b.pigment);
        if (!clear && same_finish(a, b)) return true;
        return layers_of({&a, 1}, {}, {}) == layers_of({&b, 1}, {}, {});
    };
    for (std::size_t i = 0; i < textures.size(); ++i) {
        const LayerValues& layer = layer_at(i);
        if ((textures[i] ? *textures[i] : whole).layers.size() > 1 || layer.blend) return nullptr;
        numbers[i] =
            textures[i] ? i : static_cast<std::size_t>(std::ranges::find(textures, nullptr) - textures.begin());
        const auto known = std::ranges::find_if(groups, [&](const FinishGroup& own) { return one(*own.first, layer); });
        if (known == groups.end() && groups.size() == most_layers) return nullptr;
        if (known == groups.end())
            groups.push_back({&layer, {i}});
        else
            known->lumps.push_back(i);
    }
    const BlobBlend blend(blob.data->lumps, numbers, contents.adc_bailout);
    auto all = std::make_shared<TextureThing>();
    for (const FinishGroup& group : groups) {
        auto own = std::make_shared<TextureThing>();
        own->layers[0] = *group.first;
        PigmentThing& mixed = own->layers[0].pigment;
        const auto same = [&](std::size_t i) { return numbers[i] == numbers[group.lumps[0]]; };
        if (!std::ranges::all_of(group.lumps, same) && !PigmentMaker::is_clear(mixed)) {
            mixed = {};
            std::vector<std::shared_ptr<const FunctionThing>> colors(textures.size());
            for (const std::size_t i : group.lumps) {
                const PigmentThing& pigment = layer_at(i).pigment;
                auto& color = colors[numbers[i]];
                if (!color) color = colors_of(pigment, notes.in.noise_generator);
                if (!color) return nullptr;
                mixed.most = std::max(mixed.most, PigmentMaker::largest_of(pigment));
                const float share = 1 / static_cast<float>(group.lumps.size());
                mixed.color.red += share * pigment.color.red, mixed.color.green += share * pigment.color.green;
                mixed.color.blue += share * pigment.color.blue;
            }
            mixed.colors = blend.colors(std::move(colors));
        }
        std::vector<char> counted(textures.size());
        for (const std::size_t i : group.lumps) counted[numbers[i]] = 1;
        all->shares.push_back(blend.share(std::move(counted)));
        all->corners.push_back(std::move(own));
    }
    if (groups.size() == 1) return all->corners[0];
    all->layers = all->corners[0]->layers;
    return all;
}

int MaterialMaker::without_patterns(int number) {
    Material own = (*this)[number];
    own.rgb = Pigment(own.rgb.color), own.share = Pigment(Color(1));
    own.bump = {};
    own.coats.clear();
    return materials.number(own);
}

int MaterialMaker::without(double Material::*part, int number) {
    Material own = (*this)[number];
    own.*part = 0;
    return materials.number(own);
}

int MaterialMaker::turned(int number) {
    Material own = (*this)[number];
    if (!own.has_sides()) return number;
    std::swap(own.outside, own.inside);
    for (Material& coat : own.coats) std::swap(coat.outside, coat.inside);
    return materials.number(own);
}

int MaterialMaker::within(int number, int interior, bool hollow) {
    const Material& before = (*this)[number];
    if (!before.transmits()) interior = 0;
    if (before.interior == interior && before.hollow == hollow) return number;
    Material own = before;
    own.interior = interior, own.hollow = hollow;
    return materials.number(own);
}

int MaterialMaker::clear_by_color(int number) {
    Material own = (*this)[number];
    const bool unlit = own.diffuse == 0 && own.ambient == 0 && own.specular == 0;
    if (!own.transmits() || own.rgb.clear() || own.rgb.pattern || !unlit) return number;
    own.rgb.filter = own.refraction, own.refraction = 0;
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
    if (own.share.pattern) own.share = Pigment(mark(own.share.pattern));
    if (own.bump.pattern) own.bump.pattern = std::make_shared<const Pattern>(mark(own.bump.pattern));
    return materials.number(own);
}

/// Sets what a finish says apart from ambient and diffuse light. Returns whether the article's terms say all of it.
bool MaterialMaker::set_finish(Material& material, const FinishThing& finish, bool shadow_only) const {
    if (finish.phong > 0) {
        material.specular = coefficient(finish.phong), material.pow = coefficient(finish.phong_size);
    } else if (finish.specular > 0) {
        // (n . h)^e and (r . l)^(e/4) are the same near the middle of a highlight.
        material.specular = coefficient(finish.specular), material.pow = coefficient(.25 / finish.roughness);
    }
    const bool shines = material.specular > 0;
    const ReflectionValues& reflection = finish.reflection;
    const bool fresnel = reflection.fresnel || reflection.least != reflection.most;
    // At a right angle to the surface there is the least reflection; its mean over all directions is nearer to that.
    const Color reflected = fresnel ? reflection.least + (reflection.most - reflection.least) * .2 : reflection.most;
    material.reflection = share(mean(reflected));
    if (shadow_only) return true;
    if (finish.crand != 0) notes.left_out(finish.place, "'crand'");
    if (finish.subsurface) notes.left_out(finish.place, "'subsurface'");
    bool differs =
        finish.specular > 0 || mean(reflected) > 1 || fresnel || finish.irid > 0 || finish.diffuse_behind > 0 ||
        (finish.metallic != 0 && shines) || (finish.brilliance != 1 && finish.diffuse > 0) ||
        (finish.conserve_energy && material.refraction > 0) ||
        (material.reflection > 0 && (!is_grey(reflected) || reflection.exponent != 1 || reflection.metallic != 0));
    each_negative(finish, contents, [&](bool is_negative, const char*) { differs |= is_negative; });
    return !differs;
}

/// Sets the terms of a layer's finish.
void MaterialMaker::set_layer(Material& layer, const FinishThing& finish) {
    const bool as_text = notes.in.options.as_text;
    const auto exponent = [&](double v) { return as_text ? coefficient(v) : signed_number(v); };
    const Color ambient = ambient_of(finish, contents);
    const double strength = as_text ? max_of(ambient) : max_of(max(ambient, -1. * ambient));
    layer.ambient = coefficient(strength);
    if (!is_grey(ambient) || ambient.x < 0) layer.glow = (as_text ? coefficients : signed_numbers)(ambient / strength);
    layer.diffuse = coefficient(finish.diffuse), layer.brilliance = exponent(finish.brilliance);
    layer.specular = coefficient(finish.phong), layer.pow = exponent(finish.phong_size);
    layer.blinn = coefficient(finish.specular);
    if (layer.blinn > 0) {
        const double size = std::clamp(std::fabs(tidy(finish.roughness)), 1e-9, 1e9);
        layer.roughness = finish.roughness < 0 ? as_text ? 1e-9 : -size : size;
    }
    if (layer.specular > 0 || layer.blinn > 0) layer.metallic = coefficient(finish.metallic);
    const ReflectionValues& reflection = finish.reflection;
    const double most = max_of(reflection.most);
    const auto approximated = [&](bool applies, const char* text) {
        if (applies) notes.approximated(finish.place, text);
    };
    const bool reflects = most > 1e-9;  // where all is below 0 POV-Ray reflects nothing
    approximated(!reflects && max_of(reflection.least) > 1e-9, "reflection below 0 is 0");
    if (reflects) {
        layer.reflection = share(most);
        if (!is_grey(reflection.most) || most > 1)
            layer.mirror = (as_text ? coefficients : signed_numbers)(reflection.most / std::min(most, 1.));
        layer.fresnel = reflection.fresnel ? 1 : 0;
        if (reflection.least != reflection.most || reflection.fresnel) {
            layer.facing = share(mean(reflection.least) / mean(reflection.most));
            layer.falloff = coefficient(reflection.falloff);
        }
        layer.gilding = coefficient(reflection.metallic);
        approximated(length(reflection.least - layer.facing * reflection.most) > 1e-6,
                     "the two colours of a reflection are of one colour");
        approximated(reflection.exponent != 1, "'exponent' of a reflection is ignored");
    }
    layer.behind = coefficient(finish.diffuse_behind);
    if (as_text) each_negative(finish, contents, approximated);
    if (finish.crand != 0) notes.left_out(finish.place, "'crand'");
    layer.irid = coefficient(finish.irid), layer.film = coefficient(finish.film);
    if (finish.irid > 0) approximated(finish.swirls, "the film of 'irid' is even");
    if (finish.subsurface) notes.left_out(finish.place, "'subsurface'");
}

/// Returns a layer of a surface by its pigment and its finish.
Material MaterialMaker::layer_of(const LayerValues& values, const Steps& way, const UvMapping& uv) {
    Look look = pigments.look_of(values.pigment, way, uv);
    if (look.pigment.pattern && std::holds_alternative<ImagePattern>(look.pigment.pattern->kind) &&
        look.filter + look.transmit > 0)
        notes.approximated(values.place, "a picture that lets light through is opaque");
    Material layer{.rgb = look.clear(), .reflection = 0, .specular = 0, .pow = 40};
    set_layer(layer, values.finish);
    const double version = notes.in.version_given() ? notes.in.version() : 3.62;
    const bool scatters = layer.diffuse > 0 || layer.behind > 0 || layer.ambient > 0;
    layer.old_opacity = version < 3.7 && look.filter > 0 && scatters ? 1 : 0;
    if (values.finish.conserve_energy && layer.reflection > 0 && layer.rgb.clear()) layer.conserve = 1;
    return layer;
}

/// Returns the layers of a texture, the lowest with the others as its coats, each with its own bumps or with none.
Material MaterialMaker::layers_of(std::span<const LayerValues> layers, const Steps& way, const UvMapping& uv) {
    Material whole;
    for (const LayerValues& each : layers) {
        const auto approximated = [&](TextPlace place, const char* text) { notes.approximated(place, text); };
        const auto shown = without_blend(each, notes, approximated);
        Material layer = layer_of(*shown, way, uv);
        layer.bump = pigments.bump_of(shown->normal, way, uv);
        if (&each == &layers.front())
            whole = std::move(layer);
        else
            whole.coats.push_back(std::move(layer));
    }
    return whole;
}

/// Returns the layers of all textures that a pattern of textures shows, each with its share, unless there is no such
/// pattern, or there are more than the scene can have. If all have one finish and are opaque, a pattern of their
/// pigments is the same.
std::optional<Material> MaterialMaker::mixed_layers_of(const TextureThing& texture, const Steps& way,
                                                       const UvMapping& uv) {
    const Blend* const blend = blend_of(texture);
    std::vector<const Blend*> around;
    std::vector<ShownTexture> textures;
    for (const auto& corner : texture.corners) textures.push_back({corner->layers, {corner.get()}});
    if (textures.empty() && (!blend || texture.layers.size() > 1 || !collect(texture, around, textures)))
        return std::nullopt;
    const bool simple = texture.corners.empty() && std::ranges::all_of(textures, [&](const ShownTexture& own) {
                            return own.layers.size() == 1 && same_finish(own.layers[0], textures[0].layers[0]) &&
                                   !pigments.look_of(own.layers[0].pigment, way, uv).clear().clear();
                        });
    if (simple) return std::nullopt;
    std::vector<Material> stacks;
    std::vector<std::size_t> numbers;
    std::size_t layers = 0;
    for (const ShownTexture& each : textures) {
        const auto before = std::ranges::find(textures, each.path, &ShownTexture::path);
        if (&*before != &each) {
            numbers.push_back(numbers[std::size_t(before - textures.begin())]);
            continue;
        }
        Material own = layers_of(each.layers, way, uv);
        const auto known = texture.shares.empty() ? std::ranges::find(stacks, own) : stacks.end();
        numbers.push_back(std::size_t(known - stacks.begin()));
        if (known != stacks.end()) continue;
        layers += 1 + own.coats.size();
        stacks.push_back(std::move(own));
    }
    if (layers > most_layers) return std::nullopt;
    Material whole;
    for (std::size_t i = 0; i < stacks.size(); ++i) {
        std::size_t next = 0;
        Material& own = stacks[i];
        if (!texture.shares.empty()) {
            PigmentThing share;
            share.color = {.5f, .5f, .5f}, share.colors = texture.shares[i];
            own.share = pigments.look_of(share, way, uv).pigment;
        } else if (stacks.size() > 1) {
            own.share = texture.corners.empty() ? pigments.look_of(share_of(texture, numbers, i, next), way, uv).pigment
                                                : share_of_corners(numbers, i, contents.adc_bailout);
        }
        const std::vector<Material> coats = std::exchange(own.coats, {});
        if (i == 0)
            whole = own;
        else
            whole.coats.push_back(own);
        whole.coats.insert(whole.coats.end(), coats.begin(), coats.end());
    }
    return whole;
}

Material MaterialMaker::layered_material_of(const TextureThing& texture, const InteriorThing* interior,
                                            const MaterialUse& use, const Steps& way) {
    std::optional<Material> mixed = mixed_layers_of(texture, way, use.uv);
    Material whole;
    if (mixed) {
        whole = std::move(*mixed);
    } else {
        std::span<const LayerValues> layers = texture.layers;
        if (layers.size() > most_layers) {
            notes.approximated(layers[0].place, "of the layers of a texture the upper eight are shown");
            layers = layers.last(most_layers);
        }
        whole = layers_of(layers, way, use.uv);
    }
    if (interior) whole.ior = ior_of(*interior, notes);
    if (interior && whole.transmits()) {
        if (interior->fades()) {
            whole.fade_distance = std::clamp(tidy(interior->fade_distance), 1e-9, 1e9);
            whole.fade_power = coefficient(decimal(static_cast<float>(interior->fade_power)));
            whole.fade_color = min(coefficients(interior->fade_color), Color(1));
            if (whole.fade_color != coefficients(interior->fade_color) || interior->fade_power < 0)
                notes.approximated(interior->place, "light does not become brighter inside a body");
        }
        if (interior->dispersion) notes.left_out(interior->place, "dispersion");
        if (interior->caustics) notes.left_out(interior->place, "caustics");
    }
    return whole;
}

/// Returns a material with the layers of a texture for rays from outside, and of its interior_texture for those from
/// inside.
Material MaterialMaker::two_sided_material_of(const TextureThing& texture, const InteriorThing* interior,
                                              const MaterialUse& use, const Steps& way) {
    const auto of = [&](const TextureThing& side, const InteriorThing* within, double Material::*hidden) {
        Material own = layered_material_of(without_hidden_layers(side), within, use, way);
        own.*hidden = 0;
        for (Material& coat : own.coats)
            if (coat.shares()) coat.*hidden = 0;
        return own;
    };
    Material whole = of(texture, interior, &Material::inside), inner = of(*texture.inside, nullptr, &Material::outside);
    const TextPlace place = texture.inside->layers[0].place;
    whole.both_sides = use.both_sides ? 1 : 0;
    whole.clarity = coefficient(texture.layers.back().finish.refraction.value_or(1));
    if (2 + whole.coats.size() + inner.coats.size() > most_layers) {
        notes.approximated(place, "both sides of a surface with more than eight layers look alike");
        whole.inside = 1;
        for (Material& coat : whole.coats) coat.inside = 1;
        share_bumps(whole);
        return whole;
    }
    const std::vector<Material> coats = std::exchange(inner.coats, {});
    whole.coats.push_back(std::move(inner));
    whole.coats.insert(whole.coats.end(), coats.begin(), coats.end());
    share_bumps(whole);
    return whole;
}

/// Returns the material by the article's terms alone, or by POV-Ray's if those do not say all.
Material MaterialMaker::material_of(const TextureThing& texture, const InteriorThing* interior, const MaterialUse& use,
                                    const Steps& way) {
    if (hidden_layers_of(texture) > 0) return material_of(without_hidden_layers(texture), interior, use, way);
    // Old words of a finish belong to the interior.
    const LayerValues& top = texture.layers.back();
    std::optional<InteriorThing> old;
    if (top.finish.ior && !top.blend) {
        old = interior ? *interior : InteriorThing();
        old->ior = *top.finish.ior, interior = &*old;
    }
    if (texture.inside) return two_sided_material_of(texture, interior, use, way);
    if (use.shadow_only)
        return interior && interior->fades() ? layered_material_of(texture, interior, use, way)
                                             : *plain_material_of(texture, interior, use, way);
    const std::optional<Material> plain = plain_material_of(texture, interior, use, way);
    if (plain && !use.both_sides && texture.corners.empty()) return *plain;
    Material layered = layered_material_of(texture, interior, use, way);
    share_bumps(layered);
    if (contents.adc_bailout > 0 && !notes.in.options.as_text) part_reflections(layered);
    layered.both_sides = use.both_sides ? 1 : 0;
    if (!top.blend) layered.clarity = coefficient(top.finish.refraction.value_or(1));
    return layered;
}

/// Returns the material by the article's terms alone, or nothing if they do not say all. For a body that only casts a
/// shadow they always do, well enough.
std::optional<Material> MaterialMaker::plain_material_of(const TextureThing& texture, const InteriorThing* interior,
                                                         const MaterialUse& use, const Steps& way) {
    bool differs = false;
    const auto approximated = [&](TextPlace place, const char* text) {
        if (use.shadow_only)
            notes.approximated(place, text);
        else
            differs = true;
    };
    struct Layer {
        std::shared_ptr<const LayerValues> values;
        Look look;
        Color lit{0}, glow{0};  // shares of the light that is scattered and of ambient light
        double opacity = 1;
    };
    std::vector<Layer> layers;
    for (const LayerValues& own : texture.layers) {
        Layer layer{.values = without_blend(own, notes, approximated), .look = {}};
        layer.look = pigments.look_of(layer.values->pigment, way, use.uv);
        if (layer.look.varies) approximated(layer.values->place, "transparency that varies in a pattern is its mean");
        if (differs) return {};
        layers.push_back(std::move(layer));
    }
    Color through(1);  // the light that all layers let through
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer) {
        const Color color = layer->look.pigment.color;
        const double f = layer->look.filter, t = layer->look.transmit;
        layer->opacity = 1 - f - t;
        layer->lit = through * color * (layer->opacity * layer->values->finish.diffuse);
        layer->glow = through * color * layer->opacity * ambient_of(layer->values->finish, contents);
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
    const auto bends = [](const Layer& layer) {
        return layer.values->normal.blend && layer.values->normal.amount != 0;
    };
    if (!use.shadow_only && (count > 1 || (layers.size() > 1 && std::ranges::any_of(layers, bends)))) return {};

    const Pigment pigment = shown.look.opaque();
    Material material{.rgb = pigment, .reflection = 0, .diffuse = 0, .ambient = 0, .specular = 0, .pow = 40};
    double above = 1;
    for (std::size_t i = best + 1; i < layers.size(); ++i)
        above *= mean(layers[i].look.pigment.color * layers[i].look.filter + Color(layers[i].look.transmit));
    const Color ambient = ambient_of(finish, contents);
    material.diffuse = coefficient(finish.diffuse * shown.opacity * above);
    material.ambient = coefficient(mean(ambient) * shown.opacity * above);
    differs = !is_grey(ambient);
    material.bump = pigments.bump_of(layers.back().values->normal, way, use.uv);
    const double lost = finish.refraction.value_or(1);
    through = through * lost;
    material.refraction = share(mean(through));
    if (interior) material.ior = ior_of(*interior, notes);
    // The highlights of all layers are added; the strongest is shown.
    const auto shine = [](const Layer& layer) { return layer.values->finish.phong + layer.values->finish.specular; };
    std::size_t brightest = best;
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (shine(layers[i]) > shine(layers[brightest])) brightest = i;
    FinishThing highlights = layers[brightest].values->finish;
    for (const Layer& layer : layers)
        if (mean(layer.values->finish.reflection.most) > mean(highlights.reflection.most))
            highlights.reflection = layer.values->finish.reflection;
    differs |= !set_finish(material, highlights, use.shadow_only);

    if (material.refraction > 0) {
        const bool unlit = material.diffuse == 0 && material.ambient == 0;
        if (unlit && !use.no_shadow) material.rgb = Pigment(coefficients(through / material.refraction));
        if (use.shadow_only) return material;
        constexpr int deep = 20;  // enough for rays through nine clear bodies, which count for max_trace_level
        differs |= (!interior || interior->ior == 1) && contents.max_trace_level < deep;
        const Color shadow = material.rgb.color * material.refraction;
        bool coloured = false, shaded = false;
        for (int c = 0; c < 3; ++c) {
            coloured |= std::fabs(through[c] - material.refraction) > 1e-6;
            shaded |= std::fabs(shadow[c] - through[c]) > 1e-6;
        }
        differs |= coloured || (shaded && !use.no_shadow && lit());
        differs |= material.ior != 1 && std::fabs(material.reflection + material.refraction - lost) > 1e-6;
        differs |= interior && interior->fades();
        if (interior && interior->dispersion) notes.left_out(interior->place, "dispersion");
        if (interior && interior->caustics) notes.left_out(interior->place, "caustics");
    }
    if (differs && !use.shadow_only) return {};
    return material;
}

}  // namespace strahl::pov
