// A scene as a plain value: the contents of an .rt file, in double.
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "scene/camera.h"
#include "scene/kinds/kinds.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/motion/transformation.h"

namespace strahl {

struct Primitive {
    Shape shape;
    int material = 0;  // index into Scene::materials
    std::vector<Transformation> transformations;
    bool operator==(const Primitive&) const = default;
};

struct Settings {
    Color ambient_light{1};    // Ia
    int max_trace_level = 20;  // generations of rays, camera rays being the first; 1 to 256
    bool linear = false;  // `assumed_gamma 1`: values are linear light, shown sRGB-encoded; otherwise shown as they are
    double adc_bailout = 0;  // in scenes with POV-Ray's finishes rays of less weight than this are black
    bool operator==(const Settings&) const = default;
};

/// Fog between bodies (POV-Ray's fog_type 1): after a distance t through it the share exp(-t / distance) of the light
/// is left, and the rest is the fog's colour. There is no fog inside transparent bodies, and the light of lights on its
/// way to a surface does not fade.
struct Fog {
    double distance = 1;
    Color color{0};
    std::vector<Follow> follows{};  // numbers of it that follow tracks
    bool operator==(const Fog&) const = default;
};

struct Scene {
    Camera camera;
    Settings settings;
    Pigment background{Color(0)};  // of rays that hit nothing; a pattern is evaluated at the unit direction of the ray
    std::optional<Fog> fog;
    std::vector<Light> lights;
    /// Without duplicates, in the order of first use by a primitive; a composite uses its own before those of its
    /// parts.
    std::vector<Material> materials;
    std::vector<Primitive> primitives;  // in the order declared: of coincident surfaces the first wins
    std::optional<Flythrough> flythrough;
    Music music;
    std::vector<Track> tracks;  // saved beside the scene; read only if some number follows one
    std::vector<Follow> camera_follows, background_follows;  // numbers of the camera and the background's colour
    bool operator==(const Scene&) const = default;
    /// Has it anything that the article's equation lacks?
    bool finished() const {
        const auto special = [](const Light& light) { return light.shadowless || light.fades(); };
        return settings.adc_bailout > 0 || !std::ranges::all_of(materials, &Material::plain) ||
               std::ranges::any_of(lights, special);
    }
};

}  // namespace strahl
