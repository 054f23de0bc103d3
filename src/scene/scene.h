// A scene as a plain value: the contents of an .rt file, in double.
#pragma once
#include <optional>
#include <tuple>
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
    double assumed_gamma = 0;  // values v are v^assumed_gamma of light, shown sRGB-encoded; 0: shown as they are
    double adc_bailout = 0;    // in scenes with POV-Ray's finishes rays of less weight than this are black
    /// Hides from rays what is nearer than this to their starts, and for shadows 10 times as far: 1e-4 in scenes of
    /// POV-Ray, as there. Scene text has no word for it.
    double passed_over = 0;
    double farthest = 0;  // rays see nothing that is as far away; 0: they see everything. It has no word either
    bool operator==(const Settings&) const = default;
};

/// Fog between bodies, as POV-Ray has it: after a distance t through it the share exp(-t / distance) of the light is
/// left, but not less than `transmit`, and the rest is the fog's colour. There is no fog inside transparent bodies, and
/// the light of lights on its way to a surface does not fade.
///
/// With an altitude it is ground fog: of points p at the height h = (up . p - offset) / altitude above 0, with `up` of
/// length 1, its density is 1 / (1 + h^2) of what it is below. What is seen through fog is multiplied by
/// 1 - filter + filter * color. With `turbulence`, of noise in `octaves`, each `lambda` times finer than the one before
/// and `omega` times as strong, the way through fog is shorter by up to `depth`, the less the longer it is.
struct Fog {
    double distance = 1;
    Color color{0};
    double altitude = 0, offset = 0;
    DVec3 up{0, 0, 1};
    double filter = 0, transmit = 0;
    DVec3 turbulence{0};
    double octaves = 6, omega = .5, lambda = 2, depth = .5, generator = 2;  // generator: POV-Ray's noise_generator
    std::vector<Follow> follows{};                                          // numbers of it that follow tracks
    bool operator==(const Fog&) const = default;

    /// Its parameters besides `distance` and `color`.
    static constexpr auto fields = std::make_tuple(
        Field{"altitude", &Fog::altitude, "ground fog: height at which it is half as dense; 0: it is even",
              Range::zero_or_more},
        Field{"offset", &Fog::offset, "where along `up` ground fog begins to become thinner", Range::coordinate},
        Field{"up", &Fog::up, "the direction in which ground fog becomes thinner, of any length", Range::direction},
        Field{"filter", &Fog::filter, "how much what is seen through it has the colour of the fog", Range::zero_to_one},
        Field{"transmit", &Fog::transmit, "the least share of light that comes through", Range::zero_to_one},
        Field{"turbulence", &Fog::turbulence, "how fine noise is that makes it patchy, along each axis"},
        Field{"octaves", &Fog::octaves, "how many sizes of detail that noise has", Range::octaves},
        Field{"omega", &Fog::omega, "strength of each octave relative to the one before"},
        Field{"lambda", &Fog::lambda, "how many times finer each octave is than the one before"},
        Field{"depth", &Fog::depth, "how strong that noise is"},
        Field{"generator", &Fog::generator, "POV-Ray's noise_generator: 1, 2 or 3", Range::positive});
};

struct Scene {
    Camera camera;
    Settings settings;
    Pigment background{Color(0)};  // of rays that hit nothing; a pattern is evaluated at the unit direction of the ray
    std::vector<Pigment> background_coats;  // before it, the lowest first, where their colours let no light through
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
    /// Does it have anything that the article's equation lacks?
    bool finished() const {
        bool any = settings.adc_bailout > 0 || (fog && fog->filter > 0);
        for (const Material& own : materials) any = any || !own.plain();
        for (const Light& own : lights)
            any = any || own.shadowless || own.soft || own.fades() || own.from || own.group != 0 || own.darkens();
        return any;
    }
};

}  // namespace strahl
