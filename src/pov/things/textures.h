// Textures as a POV-Ray scene declares them: pigments, normals, finishes and interiors.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pov/language/interpreter.h"
#include "pov/language/user_function.h"
#include "pov/things/warps.h"
#include "scene/solid/fractal.h"
#include "scene/solid/solid.h"
#include "text/reading/scene_files.h"

namespace strahl::pov {

/// An entry of a map, or of a list of colours: what a pattern shows at a value.
struct MapEntry {
    double at = 0;
    FilterColor color{};
    std::shared_ptr<const Thing> thing;  // a pigment, a normal or a texture in place of a colour
    double height = 0, slope = 0;        // of a slope_map
};
/// A colour map, a pigment map and so on.
struct MapThing : Thing {
    std::vector<MapEntry> entries;
};

enum class Wave { ramp, triangle, sine, scallop, cubic, poly };

/// Keeps what has been computed of a picture, for all patterns that show it.
struct PictureFacts {
    std::optional<Color> mean;  // mean of the picture's values
    double clear = 0;           // the mean of how little opaque its pixels are, once there is the other one
    std::map<std::pair<double, double>, std::shared_ptr<const std::vector<float>>> decoded;  // by both gammas
    std::map<std::pair<double, double>, std::shared_ptr<const Pixels>> shown;                // as a scene takes them
};

/// A picture that a pattern shows.
struct ImageThing {
    std::string path;                          // of its file; empty if a function makes it
    std::uint16_t file_kind = end_code;        // the word of its kind, such as "png", if it was given
    std::shared_ptr<const FilePixels> pixels;  // null if it could not be read
    std::string fault;                         // why
    std::shared_ptr<PictureFacts> facts = std::make_shared<PictureFacts>();
    int map_type = 0, interpolate = 0;
    bool once = false, use_alpha = false, single_colors = false;  // single_colors: some are transparent
    std::array<double, 2> repeat{1, 1}, offset{0, 0};
    std::optional<double> filter_all, transmit_all, bump_size;
    /// The gamma by which its values are encoded, and that of the scene's values, or 0 for sRGB. Without the first they
    /// stay as they are.
    std::optional<double> encoding;
    double working = 1;
    mutable std::shared_ptr<const FunctionThing> colors;  // once it has been made
};

/// The sum of the distances to the three nearest points, multiplied by `form`. With `solid` all points around the
/// nearest one have the same value.
struct CrackleForm {
    DVec3 form{-1, 1, 0};
    double metric = 2, offset = 0;
    bool solid = false;
    bool operator==(const CrackleForm&) const = default;
};

/// The flat pieces of `facets`: cells of the normals' directions or, with `coords`, of the points, whose normals differ
/// by so much.
struct FacetForm {
    double size = .1, coords = 0;
};

/// A warp, and the transformations that stand between it and the warp before it.
struct WarpEntry {
    Steps before;
    Warp warp;
};

struct PigmentThing;

/// How a body finds places by uv: a mesh has them at its corners, others move points there.
struct UvMapping {
    struct Places {
        Moves moves;                       // from the body's space
        Steps to_scene;                    // from the body's space
        std::optional<DVec3> ball_centre;  // if it is a ball
    };
    bool mesh = false;
    std::shared_ptr<const Places> found;
    auto operator<=>(const UvMapping&) const = default;
};

/// The pattern of a pigment, a normal or a texture, with its map.
struct Blend {
    std::uint16_t word = end_code;  // the pattern's, such as "bozo"; end_code if there is none
    TextPlace place;                // of that word
    DVec3 turbulence{0};
    double octaves = 6, omega = .5, lambda = 2, frequency = 1, phase = 0;
    std::optional<Wave> wave;  // if it is not the pattern's own
    double exponent = 1;       // of poly_wave
    DVec3 axis{1, 0, 0};       // of gradient
    DVec3 brick_size{8, 3, 4.5};
    double mortar = .5;
    double arms = 0;                       // of a spiral
    std::array<double, 2> controls{1, 1};  // of quilted
    double agate_turbulence = 1;
    bool uv = false;
    /// If a texture is by uv as a whole, what has moved it since: directions of its normal move with it. Those of other
    /// normals by uv are the scene's.
    std::optional<Steps> moved_by_uv;
    std::optional<int> noise_generator;  // if it is not the scene's
    std::uint16_t ignored = end_code;    // a word that changes the pattern in a way that is not shown
    std::shared_ptr<const ImageThing> image;
    std::shared_ptr<const MapThing> map, slopes;
    std::shared_ptr<const FunctionThing> function;
    std::shared_ptr<const PigmentThing> pigment;  // of pigment_pattern
    FractalForm fractal;
    CrackleForm crackle;
    FacetForm facets;
    std::vector<WarpEntry> warps;
    Steps steps;  // applied after all warps
    // The values of patterns that scene text has no words for: made once, so that all uses share them.
    std::shared_ptr<const SolidFunction> values;

    explicit operator bool() const { return word != end_code; }
};

struct PigmentThing : Thing {
    FilterColor color{};  // unless there is a pattern
    Blend blend;
    /// If not null, a function with five results that has the colours in place of both; `color` is their mean, and no
    /// value is larger than `most`.
    std::shared_ptr<const FunctionThing> colors;
    double most = 1;
};

struct NormalThing : Thing {
    Blend blend;
    double amount = .5;
};

struct ReflectionValues {
    DVec3 least{0}, most{0};
    double falloff = 1, exponent = 1, metallic = 0;
    bool fresnel = false;
    bool operator==(const ReflectionValues&) const = default;
};

struct FinishValues {
    DVec3 ambient{.1}, emission{0};
    double diffuse = .6, brilliance = 1, phong = 0, phong_size = 40, specular = 0, roughness = .05, metallic = 0;
    double diffuse_behind = 0, crand = 0;
    double irid = 0, film = 0;
    bool conserve_energy = false, subsurface = false, swirls = false;  // swirls: the film of irid does
    ReflectionValues reflection;
    std::optional<double> ior, refraction;  // old words, which belong to the interior
    bool operator==(const FinishValues&) const = default;
};
struct FinishThing : Thing, FinishValues {
    TextPlace place;
};

struct InteriorThing : Thing {
    TextPlace place;
    double ior = 1, fade_distance = 0, fade_power = 0;
    DVec3 fade_color{0};
    bool media = false, dispersion = false, caustics = false;
    bool fades() const { return fade_distance > 1e-10; }
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
    /// If not empty, the textures of a triangle's corners, which blend across it. Its layers are those of the first,
    /// and the corners are at (0, 0), (1, 0) and (0, 1) by uv.
    std::vector<std::shared_ptr<const TextureThing>> corners;
    /// If not empty, `corners` are the textures of a blob's lumps, and these functions of a point with five results
    /// have the share of each as a grey.
    std::vector<std::shared_ptr<const FunctionThing>> shares;
    std::shared_ptr<const TextureThing> inside;  // what is shown to rays from inside, in the same space; or null
};

struct MaterialThing : Thing {
    std::shared_ptr<const TextureThing> texture, interior_texture;
    std::shared_ptr<const InteriorThing> interior;
};

struct TransformThing : Thing {
    Steps steps;
};

/// Makes the patterns of a layer patterns by uv, see Blend::moved_by_uv.
inline void set_by_uv(LayerValues& layer, const std::optional<Steps>& moved = {}) {
    layer.pigment.blend.uv = layer.normal.blend.uv = layer.blend.uv = true;
    layer.normal.blend.moved_by_uv = layer.blend.moved_by_uv = moved;
}
inline std::shared_ptr<const TextureThing> by_uv(const TextureThing& given, const std::optional<Steps>& moved = {}) {
    auto texture = std::make_shared<TextureThing>(given);
    for (LayerValues& layer : texture->layers) set_by_uv(layer, moved);
    if (given.inside) texture->inside = by_uv(*given.inside, moved);
    return texture;
}

/// Transforms everything that has a place in a texture; what is by uv has none.
inline void transform(LayerValues& layer, std::span<const Step> steps) {
    for (Blend* const own : {&layer.pigment.blend, &layer.normal.blend, &layer.blend})
        // As in POV-Ray a colour moves, and a pattern in its place later, but there is no normal before it is given.
        if (own->uv && own->moved_by_uv)
            append(*own->moved_by_uv, steps);
        else if (!own->uv && (own != &layer.normal.blend || *own))
            append(own->steps, steps);
}

/// Returns a copy of a texture that is moved.
inline std::shared_ptr<TextureThing> moved(const TextureThing& given, std::span<const Step> steps) {
    auto texture = std::make_shared<TextureThing>(given);
    for (LayerValues& layer : texture->layers) transform(layer, steps);
    if (given.inside) texture->inside = moved(*given.inside, steps);
    return texture;
}

/// Returns a texture with the layers of another on top.
inline std::shared_ptr<const TextureThing> layered(const TextureThing& below, const TextureThing& above) {
    auto all = std::make_shared<TextureThing>(below);
    all->layers.insert(all->layers.end(), above.layers.begin(), above.layers.end());
    if (above.inside) all->inside = below.inside ? layered(*below.inside, *above.inside) : above.inside;
    return all;
}

}  // namespace strahl::pov
