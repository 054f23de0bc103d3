// Bodies, lights and cameras as a POV-Ray scene declares them.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pov/things/bicubic.h"
#include "pov/things/implicit.h"
#include "pov/things/textures.h"
#include "scene/light.h"
#include "scene/scene.h"

namespace strahl::pov {

enum class ObjectKind {
    shape,    // one simple body
    nothing,  // a body that is left out
    light,
    unite,  // a union keeps the surfaces inside it
    merge,
    intersect,
    subtract,
};

struct LightThing {
    DVec3 location{0}, color{1};
    DVec3 point_at{0, 0, 1};
    enum class Sort { point, spot, cylinder } sort = Sort::point;
    bool parallel = false, shadowless = false, circular = false, orient = false, jitter = false;
    bool area_illumination = false;
    bool dimmed = false;  // by fog
    std::optional<double> radius, falloff, tightness;
    double fade_distance = 0, fade_power = 0;
    std::optional<Area> area;
    int adaptive = 100;
};

/// A texture, and what moved the body after it was given the texture.
struct PlacedTexture {
    std::shared_ptr<const TextureThing> texture;
    Steps steps;
};

/// A body of an object that a scene asks about.
struct AskedBody {
    Primitive own, filled;  // `filled` is what is inside of it
    Box box, filled_box;    // around these
    bool negated;           // all that is outside of `filled` is inside of it
};

/// The bodies of an object, once a scene has asked for them; a copy, which may be changed, has
/// none.
struct MadeBodies {
    MadeBodies() = default;
    MadeBodies(const MadeBodies&) {}
    MadeBodies& operator=(const MadeBodies&) { return bodies.reset(), *this; }
    mutable std::shared_ptr<const std::vector<AskedBody>> bodies;
};

/// Counts the bytes of memory that a triangle takes in a mesh whose corners are not shared.
inline constexpr std::size_t bytes_of_triangle = sizeof(MeshData::Corners) + 9 * sizeof(DVec3);

struct ObjectThing : Thing {
    ObjectKind kind = ObjectKind::nothing;
    int levels = 1;  // of bodies in bodies, with this one
    TextPlace place;
    std::optional<Shape> shape;
    std::shared_ptr<const LevelSurface> surface;  // if any, the shape is its mesh
    std::shared_ptr<const BicubicPatch> patch;    // if any, the shape is its mesh where it is not moved
    std::shared_ptr<const LightThing> light;
    /// The textures of a blob's lumps, in its space, null for those that have the blob's; null if all have.
    std::shared_ptr<const std::vector<std::shared_ptr<const TextureThing>>> lump_textures;
    std::vector<std::shared_ptr<const ObjectThing>> parts;
    std::vector<std::shared_ptr<const ObjectThing>> clips;   // cut off what is outside of them
    std::vector<std::shared_ptr<const ObjectThing>> bounds;  // used only where clips refer to them
    Steps steps;
    std::optional<PlacedTexture> texture;
    std::optional<PlacedTexture> inner;  // its interior_texture, until all that is said about it has been read
    std::shared_ptr<const InteriorThing> interior;
    std::optional<bool> no_shadow, no_image, no_reflection, both_sides;
    std::optional<bool> global_lights;  // of a light_group
    bool inverse = false, hollow = false;
    bool thin = false;                                        // it has no extent: no ray meets it
    bool negative = false;                                    // it is a sphere of a negative radius
    bool photon_target = false;                               // photons are aimed at it, if there are any
    std::optional<DVec3> inside_vector;                       // of a mesh, in the scene
    bool turned_surface = false;                              // its flat triangles face where those of a mesh do not
    bool uv = false;                                          // textures that come after are by uv
    std::uint16_t word = end_code;                            // of its shape, such as "sphere"
    std::shared_ptr<const PlaceMoves> places;                 // to places by uv from its own space, of a turned body
    std::vector<std::pair<Remark::Kind, std::string>> notes;  // to be told where the object is shown
    MadeBodies made;

    void left_out(const std::string& text) { notes.emplace_back(Remark::Kind::left_out, text); }
    void warn(const std::string& text) { notes.emplace_back(Remark::Kind::warning, text); }
    void approximated(const std::string& text) { notes.emplace_back(Remark::Kind::approximated, text); }
};

struct CameraThing : Thing {
    TextPlace place;
    std::uint16_t projection = word("perspective");
    DVec3 location{0}, direction{0, 0, 1}, right{1.33, 0, 0}, up{0, 1, 0}, sky{0, 1, 0}, look_at{0, 0, 1};
    bool has_look_at = false, has_axes = false, has_direction = false, bent = false, bokeh = false;
    double aperture = 0, blur_samples = 0;
    std::optional<DVec3> focal_point;
    std::optional<double> angle, vertical_angle;
    int cylinder = 1;  // POV-Ray's number of its type
    Steps steps;
};

struct FogThing : Thing {
    TextPlace place;
    double distance = 0;
    int type = 1;
    FilterColor color{};
    DVec3 up{0, 1, 0};
    double offset = 0, altitude = 0;
    DVec3 turbulence{0};
    double octaves = 6, omega = .5, lambda = 2, depth = .5;
};

struct SkyThing : Thing {
    TextPlace place;
    std::vector<PigmentThing> pigments;  // the last one is on top
    DVec3 emission{1};                   // by which their light is multiplied
};

/// A body as the scene shows it, with the texture that holds where it has none.
struct PlacedObject {
    std::shared_ptr<const ObjectThing> object;
    std::shared_ptr<const TextureThing> fallback;
};

/// Everything that a file declares, before its version and its gamma are known.
struct PovContents {
    std::optional<CameraThing> camera;
    std::vector<PlacedObject> objects;
    std::vector<FogThing> fogs;
    std::optional<SkyThing> sky;
    DVec3 background{0};
    double background_opacity = 0;  // in a picture with alpha
    DVec3 ambient_light{1};
    bool emits = false;  // does some finish have emission?
    int max_trace_level = 5;
    double adc_bailout = 1. / 255;
    bool assumes_srgb = false;
    TextPlace gamma_place;
    std::optional<TextPlace> radiosity, photons;
};

}  // namespace strahl::pov
