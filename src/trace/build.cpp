#include "trace/build.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/matrix.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/overlap.h"
#include "trace/bound.h"
#include "trace/hierarchy.h"
#include "trace/sight.h"

namespace strahl {
namespace {

constexpr int few_items = 16;  // up to here a plain loop is faster than a hierarchy
constexpr int widest = 16;     // lanes of the widest pack

template <class T>
Vec3<T> to(const DVec3& v) {
    return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}
DVec3 point(const glm::dmat4& m, const DVec3& p) { return DVec3(m * glm::dvec4(p, 1)); }
double dot_product(const DVec3& a, const DVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// A primitive's way from its own space into the world's.
struct Setting {
    glm::dmat4 matrix;
    double similarity;
    Placement placement;

    DVec3 to_world(const DVec3& p) const { return (point(matrix, p) - placement.origin) * placement.scale; }
    double length(double x) const { return x * similarity * placement.scale; }
};

template <class T, template <class> class K>
typename Affine<K>::template Kernel<T> affine(const DVec3& centre, double unit, const Setting& setting, K<T> shape) {
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(setting.matrix)) * (1 / (unit * setting.placement.scale));
    const auto row = [&](int i) { return to<T>(DVec3(inverse[0][i], inverse[1][i], inverse[2][i])); };
    return {to<T>(setting.to_world(centre)), row(0), row(1), row(2), shape};
}

/// Items with the numbers of an earlier one go, and their boxes: of bodies in the same place the first declared is
/// seen, and rays that start on it would meet its double a rounding error before or behind.
template <class T, class I>
void drop_doubles(std::vector<I>& items, std::vector<Box>& boxes) {
    using Shape = decltype(I::shape);
    using Numbers = std::array<T, sizeof(Shape) / sizeof(T)>;
    const auto numbers = [&](std::size_t i) { return std::bit_cast<Numbers>(items[i].shape); };
    const std::size_t slots = std::bit_ceil(2 * items.size() + 1);
    std::vector<std::int32_t> table(slots, -1);  // of the items kept, by their numbers; the next slot if taken
    std::size_t kept = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Numbers own = numbers(i);
        std::uint64_t hash = 0;
        for (const T v : own) {  // 0 is added because -0 equals it
            hash = (hash ^ std::bit_cast<std::uint64_t>(static_cast<double>(v) + 0.)) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 29;
        }
        std::size_t slot = hash & (slots - 1);
        while (table[slot] >= 0 && !(numbers(table[slot]) == own)) slot = (slot + 1) & (slots - 1);
        if (table[slot] >= 0) continue;
        table[slot] = static_cast<std::int32_t>(kept);
        boxes[kept] = boxes[i];
        items[kept++] = items[i];
    }
    items.resize(kept);
    boxes.resize(kept);
}

template <class I>
void sort_items(std::vector<I>& items, const std::vector<std::int32_t>& order) {
    std::vector<I> sorted;
    sorted.reserve(items.size());
    for (const std::int32_t i : order) sorted.push_back(items[i]);
    items = std::move(sorted);
}

template <class T>
DVec3 twice(const Vec3<T>& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
template <class K>
Outline outline_of(const K& kernel, const Box& box) {
    if constexpr (requires { kernel.normal; }) {
        return {box, {}, true, twice(kernel.normal), static_cast<double>(kernel.distance)};
    } else if constexpr (requires { kernel.ball(); }) {
        return {box, kernel.ball()};
    } else {
        const DVec3 size = box.size();
        return {box, {box.centre(), std::hypot(size.x, size.y, size.z) / 2}};
    }
}

/// Field by field (see World::Group).
template <class T, class I>
std::vector<T> columns_of(const std::vector<I>& items, std::size_t stride) {
    constexpr std::size_t fields = sizeof(I) / sizeof(T);
    std::vector<T> columns(fields * stride);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const auto values = std::bit_cast<std::array<T, fields>>(items[i]);
        for (std::size_t f = 0; f < fields; ++f) columns[f * stride + i] = values[f];
    }
    return columns;
}

}  // namespace

Extent extent_of(const Scene& scene) {
    constexpr std::size_t enough = 4096;
    const std::size_t stride = 1 + scene.primitives.size() / enough;
    std::vector<double> along[3], sizes;
    for (std::size_t i = 0; i < scene.primitives.size(); i += stride) {
        const Box box = world_bounds(scene.primitives[i]);
        if (!box.finite()) continue;
        const DVec3 centre = box.centre(), size = box.size();
        for (int c = 0; c < 3; ++c) along[c].push_back(centre[c]);
        sizes.push_back(std::max({size.x, size.y, size.z}));
    }
    if (sizes.empty())
        return {scene.camera.look_at, std::hypot(scene.camera.position.x - scene.camera.look_at.x,
                                                 scene.camera.position.y - scene.camera.look_at.y,
                                                 scene.camera.position.z - scene.camera.look_at.z)};
    const auto quantile = [](std::vector<double>& values, int quarters) {
        const auto nth = values.begin() + (values.size() - 1) * quarters / 4;
        std::nth_element(values.begin(), nth, values.end());
        return *nth;
    };
    Extent extent;
    double spread = 0;
    for (int c = 0; c < 3; ++c) {
        extent.centre[c] = quantile(along[c], 2);
        spread = std::max(spread, quantile(along[c], 3) - quantile(along[c], 1));
    }
    extent.size = 2 * (spread + quantile(sizes, 2));
    return extent;
}

Placement placement(const Extent& extent, const DVec3& camera) {
    const int exponent = std::ilogb(extent.size);
    const auto snap = [](const DVec3& p, double cell) {
        return DVec3(std::round(p.x / cell), std::round(p.y / cell), std::round(p.z / cell)) * cell;
    };
    const DVec3 home = snap(extent.centre, std::ldexp(1., exponent));
    return {home + snap(camera - home, std::ldexp(1., exponent + 3)), std::ldexp(1., -exponent)};
}

template <class T>
struct BuiltWorld<T>::Arrays {
    template <template <class> class K>
    struct Group {
        std::vector<typename Item<K>::template Of<T>> items;
        std::vector<Box> boxes;
        std::vector<Node> nodes;
        std::vector<T> columns;
    };
    World<T> world;
    PerKernel<Group> groups;
    std::vector<Place> places;
    std::vector<MaterialKernel<T>> materials;
    std::vector<LightKernel<T>> lights;
    std::vector<T> iors;
    std::vector<Outline> outlines;  // by key, if there is one for each item
    std::vector<T> balls;
    std::vector<Cone<T>> cones;
    std::vector<BodySet> blockers;
    double reach = 0;  // the largest coordinate of a bounded body

    struct Body {
        int surface;
        Shape shape;
        glm::dmat4 inverse;
    };
    std::vector<Body> transparent;  // only where the bodies around an eye matter

    Arrays(const Scene& scene, const Placement& placement, ThreadPool& pool);

    /// What coordinates seen from a point may be off.
    double rounding(double furthest) const {
        return 32 * static_cast<double>(std::numeric_limits<T>::epsilon()) * furthest;
    }
    double rounding_at(const DVec3& point) const {
        return rounding(reach + std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}));
    }
    void surround(double margin) {
        const std::size_t room = most_item_keys + widest;
        balls.assign(4 * room, -std::numeric_limits<T>::infinity());
        std::fill_n(balls.begin(), 3 * room, T(0));
        for (std::size_t i = 0; i < outlines.size(); ++i) {
            const auto [centre, radius] = outlines[i].ball;
            for (int c = 0; c < 3; ++c) balls[c * room + i] = static_cast<T>(centre[c]);
            balls[3 * room + i] =
                outlines[i].plane ? std::numeric_limits<T>::infinity() : static_cast<T>(radius + margin);
        }
        const T* const first = balls.data();
        world.centres = {first, first + room, first + 2 * room};
        world.radii = first + 3 * room;
    }
    void see_from_lights() {
        for (const LightKernel<T>& light : lights) {
            const DVec3 point = twice(light.position);
            const double margin = rounding_at(point);
            for (std::size_t i = 0; i < outlines.size(); ++i) {
                cones.push_back(cone_of<T>(outlines[i], point, margin));
                blockers.push_back(blockers_of(outlines, i, point, margin));
            }
        }
    }

    void add(const Sphere& sphere, const Setting& setting, T surface, T material) {
        if (setting.similarity > 0) {
            const SphereKernel<T> kernel{to<T>(setting.to_world(sphere.centre)),
                                         static_cast<T>(setting.length(sphere.radius))};
            groups.spheres.items.push_back({kernel, surface, material});
        } else {
            groups.affine_spheres.items.push_back(
                {affine<T, SphereKernel>(sphere.centre, sphere.radius, setting, {Vec3<T>(T(0)), T(1)}), surface,
                 material});
        }
    }
    void add(const Plane& plane, const Setting& setting, T surface, T material) {
        const DVec3 n = glm::transpose(glm::inverse(glm::dmat3(setting.matrix))) * plane.normal();
        const DVec3 normal = n / std::sqrt(dot_product(n, n));
        const double distance = dot_product(normal, setting.to_world(plane.a));
        groups.planes.items.push_back({{to<T>(normal), static_cast<T>(distance)}, surface, material});
    }
    void add(const Cylinder& cylinder, const Setting& setting, T surface, T material) {
        const DVec3 rise = cylinder.cap - cylinder.base, axis = cylinder.axis();
        const double height = std::sqrt(dot_product(rise, rise));
        if (setting.similarity > 0) {
            const DVec3 turned = glm::dmat3(setting.matrix) * axis;
            const CylinderKernel<T> kernel{
                to<T>(setting.to_world(cylinder.base)), to<T>(turned / std::sqrt(dot_product(turned, turned))),
                static_cast<T>(setting.length(cylinder.radius)), static_cast<T>(setting.length(height))};
            groups.cylinders.items.push_back({kernel, surface, material});
        } else {
            const CylinderKernel<T> kernel{Vec3<T>(T(0)), to<T>(axis), T(1), static_cast<T>(height / cylinder.radius)};
            groups.affine_cylinders.items.push_back(
                {affine<T, CylinderKernel>(cylinder.base, cylinder.radius, setting, kernel), surface, material});
        }
    }
};

template <class T>
BuiltWorld<T>::Arrays::Arrays(const Scene& scene, const Placement& placement, ThreadPool& pool) {
    const DVec3 ambient = scene.settings.ambient_light;
    for (const Material& m : scene.materials) {
        materials.push_back({to<T>(ambient * m.rgb * m.ambient), to<T>(m.rgb * m.diffuse), to<T>(m.rgb * m.refraction),
                             static_cast<T>(m.specular), static_cast<T>(m.pow), static_cast<T>(m.reflection),
                             static_cast<T>(m.refraction), static_cast<T>(m.ior),
                             static_cast<T>(path_factor(m.reflection, m.refraction)),
                             static_cast<T>(path_factor(m.refraction, m.reflection))});
        world.transparent |= m.refraction > 0;
    }
    for (const Light& light : scene.lights)
        lights.push_back({to<T>((light.position - placement.origin) * placement.scale), to<T>(light.color)});
    world.nested = world.transparent && transparent_bodies_overlap(scene);
    world.background = to<T>(scene.background);

    int surface = 0;
    for (const Primitive& primitive : scene.primitives) {
        const Setting setting{matrix(primitive.transformations), similarity(primitive.transformations), placement};
        std::visit(
            [&](const auto& shape) {
                add(shape, setting, static_cast<T>(surface), static_cast<T>(primitive.material));
            },
            primitive.shape);
        const Material& material = scene.materials[primitive.material];
        if (world.nested && material.refraction > 0)
            transparent.push_back({surface, primitive.shape, glm::inverse(setting.matrix)});
        Box box = world_bounds(primitive);
        box = {(box.low - placement.origin) * placement.scale, (box.high - placement.origin) * placement.scale};
        if (box.finite())
            for (int c = 0; c < 3; ++c) reach = std::max({reach, std::abs(box.low[c]), std::abs(box.high[c])});
        groups.each([&](auto& group) {
            if (group.items.size() > group.boxes.size()) group.boxes.push_back(box);
        });
        const int faces = std::visit([](const auto& shape) { return shape.faces; }, primitive.shape);
        if (world.nested) iors.insert(iors.end(), faces, static_cast<T>(material.ior));
        surface += faces;
    }

    groups.each([](auto& group) { drop_doubles<T>(group.items, group.boxes); });
    std::size_t items = 0;
    groups.each([&](auto& group) { items += group.items.size(); });
    world.key_per_item = items <= most_item_keys;
    places.resize(surface, {-1, -1});
    const double margin = rounding(reach);
    BodySet transparent_keys = 0;
    const auto finish = [&](auto& from, auto& view) {
        if (!world.key_per_item && from.items.size() > few_items &&
            std::all_of(from.boxes.begin(), from.boxes.end(), [](const Box& box) { return box.finite(); })) {
            Hierarchy hierarchy = build_hierarchy(from.boxes, margin, pool);
            sort_items(from.items, hierarchy.order);
            from.nodes = std::move(hierarchy.nodes);
            view.nodes = from.nodes.data();
            view.stride = from.items.size() + widest;
            from.columns = columns_of<T>(from.items, view.stride);
            view.columns = from.columns.data();
        }
        view.items = from.items.data();
        view.count = static_cast<int>(from.items.size());
        view.first_key = world.keys;
        world.keys += world.key_per_item ? view.count : 1;
        view.last_key = world.keys;
        for (int i = 0; i < view.count; ++i)
            for (int face = 0; face < from.items[i].shape.faces; ++face)
                places[static_cast<int>(from.items[i].surface) + face] = {
                    i, world.key_per_item ? view.first_key + i : view.first_key};
        if (world.key_per_item)
            for (int i = 0; i < view.count; ++i) {
                outlines.push_back(outline_of(from.items[i].shape, from.boxes[i]));
                if (materials[static_cast<int>(from.items[i].material)].refraction > 0)
                    transparent_keys |= BodySet(1) << (view.first_key + i);
            }
        from.boxes = {};
    };
    finish(groups.spheres, world.groups.spheres);
    finish(groups.planes, world.groups.planes);
    finish(groups.cylinders, world.groups.cylinders);
    finish(groups.affine_spheres, world.groups.affine_spheres);
    finish(groups.affine_cylinders, world.groups.affine_cylinders);

    world.places = places.data();
    world.materials = materials.data();
    world.lights = lights.data();
    world.light_count = static_cast<int>(lights.size());
    world.iors = iors.data();
    if (world.key_per_item) surround(margin);
    see_from_lights();
    for (std::size_t i = 0; i < outlines.size(); ++i)
        if (transparent_keys >> i & 1 && !world.nested && alone(outlines, i, margin)) world.enclosed |= BodySet(1) << i;
    world.cones = cones.data();
    world.blockers = blockers.data();
}

template <class T>
BuiltWorld<T>::BuiltWorld(const Scene& scene, const Placement& placement, ThreadPool& pool)
    : arrays(std::make_unique<Arrays>(scene, placement, pool)) {}
template <class T>
BuiltWorld<T>::~BuiltWorld() = default;
template <class T>
const World<T>& BuiltWorld<T>::world() const {
    return arrays->world;
}
template <class T>
std::vector<int> BuiltWorld<T>::bodies_around(const DVec3& eye) const {
    std::vector<int> bodies;
    for (const auto& body : arrays->transparent)
        if (arrays->places[body.surface].item >= 0 &&
            std::visit([&](const auto& shape) { return shape.contains(point(body.inverse, eye)); }, body.shape))
            bodies.push_back(body.surface);
    return bodies;
}

template class BuiltWorld<float>;
template class BuiltWorld<double>;
template class BuiltWorld<long double>;

}  // namespace strahl
