#include "pov/meaning/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "num/box_tree.h"
#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "scene/ray_hits.h"

namespace strahl::pov {
namespace {

/// Does a body mirror?
bool mirrors(const Scene& scene, const Primitive& body) {
    bool any = false;
    for_each_leaf(body, [&](const Primitive& leaf, const glm::dmat4&) {
        const Material& own = scene.materials[static_cast<std::size_t>(leaf.material)];
        const auto reflects = [](const Material& layer) { return layer.reflection > 0; };
        any |= reflects(own) || std::ranges::any_of(own.coats, reflects);
    });
    return any;
}

/// Returns the material of the simple body, alone or in a composite, whose surface was met.
int material_at(const Scene& scene, const BodyHit& at) {
    int material = 0, leaf = 0;
    for_each_leaf(scene.primitives[static_cast<std::size_t>(at.body)], [&](const Primitive& own, const glm::dmat4&) {
        if (leaf++ == at.hit.leaf) material = own.material;
    });
    return material;
}

const Material& surface_at(const Scene& scene, const BodyHit& at) {
    return scene.materials[static_cast<std::size_t>(material_at(scene, at))];
}

/// Is a surface in the way of all light?
bool blocks_light(const Material& own) { return own.shadow == 1 && !own.transmits(); }

/// Finds all surfaces along rays.
class Surfaces {
  public:
    explicit Surfaces(const Scene& scene) : scene(scene) {
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
            open.push_back(false);
            for_each_leaf(scene.primitives[i], [&](const Primitive& leaf, const glm::dmat4&) {
                if (shows_nothing(scene.materials[static_cast<std::size_t>(leaf.material)])) open.back() = true;
            });
            const Box box = world_bounds(scene.primitives[i]);
            if (box.finite())
                boxes.push_back(box), bounded.push_back(i);
            else
                unbounded.push_back(i);
        }
        tree.emplace(std::move(boxes));
    }
    std::vector<BodyHit> along(const Ray<double>& ray) {
        std::vector<BodyHit> found;
        const auto add = [&](std::size_t body) {
            for (const RayHit& hit :
                 ray_hits(scene.primitives[body], ray, 1e-6, std::numeric_limits<double>::infinity(), &meshes)) {
                const BodyHit at{static_cast<int>(body), hit};
                if (!open[body] || !shows_nothing(surface_at(scene, at))) found.push_back(at);
            }
        };
        std::ranges::for_each(unbounded, add);
        tree->visit([&](const Box& box) { return meets(box, ray); }, [&](std::size_t i) { add(bounded[i]); });
        std::ranges::sort(found, {}, [](const BodyHit& at) { return std::pair(at.hit.t, at.body); });
        return found;
    }

  private:
    const Scene& scene;
    std::vector<std::size_t> bounded, unbounded;
    std::vector<char> open;  // bodies some surfaces of which are not there
    std::optional<BoxTree> tree;
    MeshTrees meshes;
};

}  // namespace

bool shows_nothing(const Material& own) {
    return own.rgb.transmit == 1 && own.diffuse == 0 && own.specular == 0 && own.reflection == 0;
}

const std::vector<SeenPlaces::Place>& SeenPlaces::places() {
    if (!all) all.emplace(), follow_rays();
    return *all;
}

std::size_t SeenPlaces::reached_by(const DVec3& light, double close) {
    Surfaces surfaces(scene);
    return static_cast<std::size_t>(std::ranges::count_if(places(), [&](const Place& place) {
        const double away = length(light - place.p);
        if (!(away > 2 * close)) return true;
        const std::vector<BodyHit> met = surfaces.along({place.p, (1 / away) * (light - place.p), -1});
        return std::ranges::none_of(
            met, [&](const BodyHit& at) { return at.hit.t < away - 2 * close && blocks_light(surface_at(scene, at)); });
    }));
}

void SeenPlaces::follow_rays() {
    constexpr int columns = 48, rows = 36, most_turns = 3;
    const Camera& camera = scene.camera;
    std::vector<char> clear, is_mirror;
    for (const Primitive& body : scene.primitives)
        clear.push_back(transparent(scene, body)), is_mirror.push_back(mirrors(scene, body));
    const CameraFrame frame = frame_of(camera, camera.aspectratio.value_or(4. / 3));
    Surfaces surfaces(scene);
    rays = std::size_t{columns} * rows;
    for (int i = 0; i < columns * rows; ++i) {
        const double x = (2 * (i % columns) + 1.) / columns - 1, y = (2 * (i / columns) + 1.) / rows - 1;
        const CameraRay<double> eye = camera_ray(camera.projection, frame, x, y);
        if (!eye.seen) continue;
        Ray<double> ray{camera.position + eye.start, normalize(eye.way), -1};
        for (int turns = 0; turns <= most_turns; ++turns) {
            const std::vector<BodyHit> met = surfaces.along(ray);
            const RayHit* mirror = nullptr;
            for (std::size_t k = 0; k < met.size(); ++k) {
                const auto body = static_cast<std::size_t>(met[k].body);
                const DVec3 p = ray.origin + met[k].hit.t * ray.direction;
                const auto next = std::ranges::find_if(met.begin() + std::ptrdiff_t(k) + 1, met.end(),
                                                       [&](const BodyHit& at) { return at.body != met[k].body; });
                Place place{p, met[k].hit.normal, body};
                if (next != met.end() && next->hit.t - met[k].hit.t < 1e-9 * (1 + length(p)))
                    place.other = static_cast<std::size_t>(next->body), place.material = material_at(scene, met[k]),
                    place.other_material = material_at(scene, *next);
                all->push_back(place);
                if (is_mirror[body] && !mirror) mirror = &met[k].hit;
                // Not all parts of a body through which light goes are clear: where it is clipped nothing is.
                if (!clear[body] || !surface_at(scene, met[k]).transmits()) break;
            }
            if (!mirror) break;
            ray.origin = ray.origin + mirror->t * ray.direction;
            ray.direction = ray.direction - 2 * dot_product(ray.direction, mirror->normal) * mirror->normal;
        }
    }
}

}  // namespace strahl::pov
