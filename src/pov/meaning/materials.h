// Makes a scene's materials of POV-Ray's textures and interiors.
#pragma once
#include <compare>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "pov/meaning/pigments.h"
#include "pov/things/objects.h"
#include "text/blocks/materials.h"

namespace strahl::pov {

/// How a body with a material is seen.
struct MaterialUse {
    UvMapping uv{};            // the places of its texture, if that is by uv
    bool shadow_only = false;  // no_image and no_reflection
    bool no_shadow = false;
    bool both_sides = false;  // double_illuminate
    int group = 0;            // of lights, see Material
    bool common = true;       // lights of no group shine on it
    auto operator<=>(const MaterialUse&) const = default;
};

/// Returns the scene's ambient light, of which emission is a share: of no light, 1e-7, which is not seen, if something
/// emits.
Color ambient_light_of(const PovContents& contents);

class MaterialMaker {
  public:
    MaterialMaker(NoteTaker notes, const PovContents& contents, bool mirrored)
        : notes(notes), pigments(notes, mirrored), contents(contents) {}

    /// Returns the number of a material. `way()` leads from the texture's space into that of the body.
    template <class Way>
    int number(const std::shared_ptr<const TextureThing>& texture, const std::shared_ptr<const InteriorThing>& interior,
               const MaterialUse& use, const Way& way) {
        const auto key = std::make_tuple(texture, interior, use);
        if (const auto known = plain.find(key); known != plain.end()) return known->second;
        const bool moves = has_pattern(*texture);
        Material made = material_of(*texture, interior.get(), use, moves ? way() : Steps());
        made.group = use.group, made.common = use.common ? 1 : 0;
        const int own = materials.number(made);
        if (!moves) plain[key] = own;
        return own;
    }
    /// Is a pattern of a texture by uv?
    bool by_uv(const std::shared_ptr<const TextureThing>& texture);
    /// Returns the texture that a blob's lumps blend to, in the blob's space: `whole` is that of lumps without one, and
    /// `way` leads from its space into the blob's. Null if they differ in more than their pigments.
    std::shared_ptr<const TextureThing> blended(const Blob& blob,
                                                const std::vector<std::shared_ptr<const TextureThing>>& textures,
                                                const TextureThing& whole, const Steps& way);
    /// Returns the number of the material of what is not there: light goes through it as through nothing, and there is
    /// fog on both sides of it.
    int nothing() {
        Material clear{.rgb = Color(1), .reflection = 0, .diffuse = 0, .specular = 0};
        clear.rgb.transmit = 1, clear.hollow = !contents.fogs.empty();
        return materials.number(clear);
    }
    /// Returns the number of the same material without its patterns.
    int without_patterns(int number);
    /// Returns the number of the same material without its shadow, or of bodies that are not seen or not mirrored.
    int without(double Material::*part, int number);
    /// Returns the number of a material whose sides are turned.
    int turned(int number);
    /// Returns the number of the same material for surfaces of an interior, which counts if light goes through them.
    int within(int number, int interior, bool hollow);
    /// Returns the number of a material that is clear by its colour instead of its refraction, if that looks the same:
    /// rays that go straight through it do not count for max_trace_level.
    int clear_by_color(int number);
    /// Returns the number of an equal material whose patterns have a space of their own.
    int apart(int number);
    const Material& operator[](int number) const { return materials.list[static_cast<std::size_t>(number)]; }

    Materials materials;
    PigmentMaker& pigment_maker() { return pigments; }

  private:
    void set_layer(Material& layer, const FinishThing& finish);
    Material layer_of(const LayerValues& values, const Steps& way, const UvMapping& uv);
    Material layers_of(std::span<const LayerValues> layers, const Steps& way, const UvMapping& uv);
    std::optional<Material> mixed_layers_of(const TextureThing& texture, const Steps& way, const UvMapping& uv);
    std::optional<Material> plain_material_of(const TextureThing& texture, const InteriorThing* interior,
                                              const MaterialUse& use, const Steps& way);
    Material two_sided_material_of(const TextureThing& texture, const InteriorThing* interior, const MaterialUse& use,
                                   const Steps& way);
    Material layered_material_of(const TextureThing& texture, const InteriorThing* interior, const MaterialUse& use,
                                 const Steps& way);
    static bool has_pattern(const TextureThing& texture);
    /// Does the scene have a light?
    bool lit();
    Material material_of(const TextureThing& texture, const InteriorThing* interior, const MaterialUse& use,
                         const Steps& way);
    bool set_finish(Material& material, const FinishThing& finish, bool shadow_only) const;

    NoteTaker notes;
    PigmentMaker pigments;
    const PovContents& contents;
    std::optional<bool> any_light;
    std::map<std::shared_ptr<const TextureThing>, bool> known_by_uv;  // patterns of textures
    std::map<std::tuple<std::shared_ptr<const TextureThing>, std::shared_ptr<const InteriorThing>, MaterialUse>, int>
        plain;  // materials without patterns
};

}  // namespace strahl::pov
