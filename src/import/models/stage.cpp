#include "import/models/stage.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "text/blocks/materials.h"

namespace strahl {
namespace {

constexpr double fov = 17, margin = .8;  // half of the angle of view; the share of the picture that the model fills
constexpr double azimuth = 30, elevation = 18;  // of the camera, from the front
constexpr int stops = 16;                       // keys of the flight around the model
constexpr double seconds = 16;
constexpr double page = .8;  // light of the floor and of the background

/// A light of the stage: its angles from the camera's place, and its strength.
struct StageLight {
    double azimuth, elevation, strength;
};
constexpr StageLight stage_lights[]{{-50, 50, .8}, {55, 25, .25}, {160, 50, .3}};

double sine(double degrees) { return std::sin(degrees * std::numbers::pi / 180); }
double cosine(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

/// Views of a model from all sides.
class ModelStage {
  public:
    ModelStage(const Model& model, double aspect)
        : up(normalize(model.up)), front(normalize(model.front)), right(cross_product(up, front)), aspect(aspect) {
        std::size_t all = 0;
        for (const ModelPart& part : model.parts) all += part.at_first()->triangles.size();
        const std::size_t step = 1 + all / 50'000;  // so many triangles give the same view as all
        for (const ModelPart& part : model.parts) {
            const glm::dmat4 place = matrix(part.transformations);
            box.add(Mesh{part.at_first(), ""}.bounds(place));
            for (std::size_t i = 0; i < part.at_first()->triangles.size(); i += step)
                for (const std::int32_t corner : part.at_first()->triangles[i])
                    points.push_back(transform_point(place, part.at_first()->points[std::size_t(corner)]));
        }
        middle = box.centre();
        size = std::max(length(box.size()), 1e-6);
    }

    DVec3 direction(double turned, double raised) const {
        return cosine(raised) * (cosine(turned) * front + sine(turned) * right) + sine(raised) * up;
    }
    /// Returns the nearest camera in this direction that sees all points within the margin.
    Camera camera(double turned) const {
        const DVec3 back = direction(turned, elevation), across = normalize(cross_product(up, back));
        const DVec3 above = cross_product(back, across);
        // A point (x, y, z), z towards the camera, is seen if |x - shift| <= tan (distance - z), and so for y.
        const double slope = margin * std::tan(fov * std::numbers::pi / 180);
        double distance = 0;
        for (const DVec3& point : points) distance = std::max(distance, dot_product(point - middle, back) + .1 * size);
        DVec3 target = middle;
        for (const auto& [axis, tan] : {std::pair(across, slope), {above, slope / aspect}}) {
            double most = -1e300, least = -1e300;
            for (const DVec3& point : points) {
                const DVec3 p = point - middle;
                const double z = tan * dot_product(p, back), x = dot_product(p, axis);
                most = std::max(most, x + z), least = std::max(least, z - x);
            }
            target += .5 * (most - least) * axis;
            distance = std::max(distance, .5 * (most + least) / tan);
        }
        Camera camera;
        camera.position = target + distance * back, camera.look_at = target, camera.up = -up, camera.fov = fov;
        return camera;
    }
    /// Returns the height of the lowest point.
    double lowest() const {
        double low = 1e300;
        for (int i = 0; i < 8; ++i)
            low = std::min(low, dot_product(up, DVec3(i & 1 ? box.low.x : box.high.x, i & 2 ? box.low.y : box.high.y,
                                                      i & 4 ? box.low.z : box.high.z)));
        return low;
    }

    const DVec3 up, front, right;
    Box box;
    DVec3 middle;
    double size;

  private:
    const double aspect;
    std::vector<DVec3> points;
};

Flythrough flight_around(const ModelStage& stage) {
    Flythrough flight{.duration = seconds, .loop = true, .keys = {}};
    for (int i = 0; i < stops; ++i) {
        const Camera camera = stage.camera(azimuth + 360. * i / stops);
        flight.keys.push_back(
            {.time = seconds * i / stops, .position = camera.position, .look_at = camera.look_at, .fov = {}, .up = {}});
    }
    return flight;
}

/// A flight of a camera that stays where it is, for models that move.
Flythrough still_flight(const Camera& camera, double duration) {
    return {.duration = duration,
            .loop = true,
            .keys = {{.time = 0, .position = camera.position, .look_at = camera.look_at, .fov = {}, .up = {}}}};
}

/// Adds a floor just below the model that is as bright as the background.
void add_floor(const ModelStage& stage, Scene& scene, Materials& materials) {
    double lit = 0;
    for (const StageLight& light : stage_lights) lit += light.strength * sine(light.elevation);
    Material floor;
    floor.rgb = Color(1), floor.reflection = floor.specular = 0, floor.ambient = .1;
    floor.diffuse = (page - floor.ambient) / lit;
    const DVec3 point =
        stage.middle + (stage.lowest() - 1e-4 * stage.size - dot_product(stage.up, stage.middle)) * stage.up;
    const double step = std::max(stage.size, 1e-6 * length(point));
    scene.primitives.push_back({.shape = Plane{point, point + step * stage.front, point + step * stage.right},
                                .material = materials.number(floor),
                                .transformations = {}});
}

}  // namespace

Scene staged(const Model& model, double aspect) {
    Scene scene;
    const ModelStage stage(model, aspect);
    scene.settings.assumed_gamma = 1;
    scene.background = Pigment(Color(page));
    Materials materials;
    for (const ModelPart& part : model.parts)
        scene.primitives.push_back(
            {.shape = Mesh{part.mesh, model.whole ? std::filesystem::path(model.files[0]).filename().string() : ""},
             .material = materials.number(model.materials[std::size_t(part.material)]),
             .transformations = part.transformations});
    scene.camera = model.camera ? *model.camera : stage.camera(azimuth);
    scene.lights = model.lights;
    if (model.lights.empty())
        for (const StageLight& light : stage_lights)
            scene.lights.push_back({.color = Color(light.strength),
                                    .direction = -stage.direction(azimuth + light.azimuth, light.elevation)});
    if (!model.camera && model.lights.empty()) add_floor(stage, scene, materials);
    if (model.seconds > 0)
        scene.flythrough = still_flight(scene.camera, model.seconds);
    else if (!model.camera)
        scene.flythrough = flight_around(stage);
    scene.materials = std::move(materials.list);
    return scene;
}

}  // namespace strahl
