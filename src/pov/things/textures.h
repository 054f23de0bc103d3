// Textures as a POV-Ray scene declares them: pigments, normals, finishes and interiors.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pov/language/interpreter.h"
#include "pov/things/steps.h"

namespace strahl::pov {

/// An entry of a map, or of a list of colours: what a pattern shows at a value.
struct MapEntry {
    double at = 0;
    FilterColor color{};
    std::shared_ptr<const Thing> thing;  // a pigment, a normal or a texture in place of a colour
};
/// A colour map, a pigment map and so on.
struct MapThing : Thing {
    std::vector<MapEntry> entries;
};

enum class Wave { ramp, triangle, sine, scallop, cubic, poly };

/// A picture file that a pattern shows.
struct ImageThing {
    std::string path;
    int map_type = 0, interpolate = 0;
    bool once = false, single_colors = false;  // single_colors: some are transparent
    std::optional<double> filter_all, transmit_all;
    std::optional<double> gamma;  // by which it is encoded; 0 is srgb
};

/// The pattern of a pigment, a normal or a texture, with its map.
struct Blend {
    std::uint16_t word = end_code;  // the pattern's, such as "bozo"; end_code if there is none
    TextPlace place;                // of that word
    DVec3 turbulence{0};
    double octaves = 6, omega = .5, lambda = 2, frequency = 1, phase = 0;
    std::optional<Wave> wave;  // if it is not the pattern's own
    DVec3 axis{1, 0, 0};       // of gradient
    DVec3 brick_size{8, 3, 4.5};
    double mortar = .5;
    bool uv = false, warped = false;
    std::optional<int> noise_generator;  // if it is not the scene's
    std::uint16_t ignored = end_code;    // a word that changes the pattern in a way that is not shown
    std::shared_ptr<const ImageThing> image;
    std::shared_ptr<const MapThing> map;
    Steps steps;

    explicit operator bool() const { return word != end_code; }
};

struct PigmentThing : Thing {
    FilterColor color{};  // unless there is a pattern
    Blend blend;
};

struct NormalThing : Thing {
    Blend blend;
    double amount = .5;
};

struct ReflectionValues {
    DVec3 least{0}, most{0};
    double falloff = 1, exponent = 1, metallic = 0;
    bool fresnel = false;
};

struct FinishThing : Thing {
    TextPlace place;
    DVec3 ambient{.1}, emission{0};
    double diffuse = .6, brilliance = 1, phong = 0, phong_size = 40, specular = 0, roughness = .05, metallic = 0;
    double diffuse_behind = 0, crand = 0;
    bool irid = false, conserve_energy = false, subsurface = false;
    ReflectionValues reflection;
    std::optional<double> ior, refraction;  // old words, which belong to the interior
};

struct InteriorThing : Thing {
    TextPlace place;
    double ior = 1;
    bool fades = false, media = false, dispersion = false, caustics = false;
};

/// A layer: a pigment, a normal and a finish; or a pattern of textures.
struct LayerValues {
    TextPlace place;
    PigmentThing pigment;
    NormalThing normal;
    FinishThing finish;
    Blend blend;  // its map holds textures
};
struct TextureThing : Thing {
    std::vector<LayerValues> layers = std::vector<LayerValues>(1);  // the last one is on top
};

struct MaterialThing : Thing {
    std::shared_ptr<const TextureThing> texture, interior_texture;
    std::shared_ptr<const InteriorThing> interior;
};

struct TransformThing : Thing {
    Steps steps;
};

/// Transforms everything that has a place in a texture.
inline void transform(LayerValues& layer, std::span<const Step> steps) {
    for (Steps* const own : {&layer.pigment.blend.steps, &layer.normal.blend.steps, &layer.blend.steps})
        append(*own, steps);
}

/// Returns a texture with the layers of another on top.
inline std::shared_ptr<const TextureThing> layered(const TextureThing& below, const TextureThing& above) {
    auto all = std::make_shared<TextureThing>(below);
    all->layers.insert(all->layers.end(), above.layers.begin(), above.layers.end());
    return all;
}

}  // namespace strahl::pov
