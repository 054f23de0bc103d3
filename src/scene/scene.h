// A scene as a plain value: the content of an .rt file, in double.
#pragma once
#include <optional>
#include <vector>

#include "scene/camera.h"
#include "scene/kinds.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/transformation.h"

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
    bool operator==(const Settings&) const = default;
};

struct Scene {
    Camera camera;
    Settings settings;
    Pigment background{Color(0)};  // of rays that hit nothing; a pattern is asked for the unit direction of the ray
    std::vector<Light> lights;
    /// No duplicates, in the order of first use by a primitive: of a composite its own, then those of its parts.
    std::vector<Material> materials;
    std::vector<Primitive> primitives;  // in the order declared: of coincident surfaces the first wins
    std::optional<Flythrough> flythrough;
    bool operator==(const Scene&) const = default;
};

}  // namespace strahl
