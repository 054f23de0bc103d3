#include "trace/build.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/matrix.hpp>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/overlap.h"
#include "trace/bound.h"
#include "trace/duplicates.h"
#include "trace/hierarchy.h"
#include "trace/light_culling.h"
#include "trace/thread_pool.h"

namespace strahl {
namespace {

constexpr int few_items = 16;  // of a kind, in a world without a key per item: a plain loop is faster than a hierarchy
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

// Numbers of the kernels.
constexpr int spheres = 0, planes = 1, cylinders = 2, affine_spheres = 3, affine_cylinders = 4;
int kernel_of(const Sphere&, bool similar) { return similar ? spheres : affine_spheres; }
int kernel_of(const Plane&, bool) { return planes; }
int kernel_of(const Cylinder&, bool similar) { return similar ? cylinders : affine_cylinders; }

template <class T>
DVec3 twice(const Vec3<T>& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
/// What is around a kernel, from its box if need be, whose corners may be off by `slack`.
template <class K>
BoundingVolume bounding_volume_of(const K& kernel, const ItemBox& rounded, double slack) {
    Box box;
    for (int c = 0; c < 3; ++c) box.low[c] = rounded.low[c] - slack, box.high[c] = rounded.high[c] + slack;
    if constexpr (requires { kernel.normal; }) {
        return {box, {}, true, twice(kernel.normal), static_cast<double>(kernel.distance)};
    } else if constexpr (requires { kernel.ball(); }) {
        return {box, kernel.ball()};
    } else {
        const DVec3 size = box.size();
        return {box, {box.centre(), std::hypot(size.x, size.y, size.z) / 2}};
    }
}

/// What comes before a primitive.
struct Before {
    std::array<int, 5> items{};  // by kernel
    int surfaces = 0;
    Before& operator+=(const Before& b) {
        for (std::size_t i = 0; i < items.size(); ++i) items[i] += b.items[i];
        return surfaces += b.surfaces, *this;
    }
};

/// Removes the duplicates. How many items are left?
template <class T, class G>
int drop_duplicates(G& group, int count, ThreadPool& pool) {
    const std::vector<std::int32_t> gone = duplicates<T>(group.items.get(), count, pool);
    int kept = gone.empty() ? count : gone[0];
    for (std::size_t i = 0; i < gone.size(); ++i)
        for (int from = gone[i] + 1; from < (i + 1 < gone.size() ? gone[i + 1] : count); ++from, ++kept)
            group.items[kept] = group.items[from], group.boxes[kept] = group.boxes[from];
    return kept;
}

}  // namespace

template <class T>
struct BuiltWorld<T>::Arrays {
    template <template <class> class K>
    struct Group {
        using I = typename Item<K>::template Of<T>;
        Buffer<I> items;
        Buffer<ItemBox> boxes;
        std::atomic<bool> bounded{true};  // all of them
        Buffer<Node> nodes;
        Buffer<T> columns;
    };
    World<T> world;
    PerKernel<Group> groups;
    Buffer<Place> places;
    std::vector<MaterialKernel<T>> materials;
    std::vector<LightKernel<T>> lights;
    std::vector<T> iors;
    std::vector<BoundingVolume> volumes;  // by key, if there is one for each item
    BodySet glass = 0;                    // of these the transparent ones
    std::vector<T> balls;
    std::vector<Cone<T>> cones;
    std::vector<BodySet> occluders;
    double reach = 0;  // the largest coordinate of a bounded body

    struct Body {
        int surface;
        Shape shape;
        glm::dmat4 inverse;
    };
    std::vector<Body> transparent;  // only where the bodies around an eye matter

    Arrays(const Scene& scene, const Placement& placement, ThreadPool& pool);

    /// What coordinates may be off, the largest of them being `furthest`.
    static double rounding(double furthest) {
        return 32 * static_cast<double>(std::numeric_limits<T>::epsilon()) * furthest;
    }
    void bound_bodies();
    void cull_for_lights();

    /// A primitive that is being added.
    struct Entry {
        Before& before;
        Box box;
        T surface, material;
    };
    template <class G, class K>
    void put(G& group, int kernel, const K& shape, const Entry& entry) {
        const int item = entry.before.items[kernel]++;
        ItemBox& box = group.boxes[item];
        for (int c = 0; c < 3; ++c)
            box.low[c] = static_cast<float>(entry.box.low[c]), box.high[c] = static_cast<float>(entry.box.high[c]);
        for (int c = 0; c < 3; ++c)
            if (!std::isfinite(box.high[c] - box.low[c])) group.bounded = false;
        group.items[item] = {shape, entry.surface, entry.material};
    }
    void add(const Sphere& sphere, const Setting& setting, const Entry& entry) {
        if (setting.similarity > 0) {
            const SphereKernel<T> kernel{to<T>(setting.to_world(sphere.centre)),
                                         static_cast<T>(setting.length(sphere.radius))};
            put(groups.spheres, spheres, kernel, entry);
        } else {
            const SphereKernel<T> kernel{Vec3<T>(T(0)), T(1)};
            put(groups.affine_spheres, affine_spheres,
                affine<T, SphereKernel>(sphere.centre, sphere.radius, setting, kernel), entry);
        }
    }
    void add(const Plane& plane, const Setting& setting, const Entry& entry) {
        const DVec3 n = glm::transpose(glm::inverse(glm::dmat3(setting.matrix))) * plane.normal();
        const DVec3 normal = n / std::sqrt(dot_product(n, n));
        const double distance = dot_product(normal, setting.to_world(plane.a));
        put(groups.planes, planes, PlaneKernel<T>{to<T>(normal), static_cast<T>(distance)}, entry);
    }
    void add(const Cylinder& cylinder, const Setting& setting, const Entry& entry) {
        const DVec3 rise = cylinder.cap - cylinder.base, axis = cylinder.axis();
        const double height = std::sqrt(dot_product(rise, rise));
        if (setting.similarity > 0) {
            const DVec3 turned = glm::dmat3(setting.matrix) * axis;
            const CylinderKernel<T> kernel{
                to<T>(setting.to_world(cylinder.base)), to<T>(turned / std::sqrt(dot_product(turned, turned))),
                static_cast<T>(setting.length(cylinder.radius)), static_cast<T>(setting.length(height))};
            put(groups.cylinders, cylinders, kernel, entry);
        } else {
            const CylinderKernel<T> kernel{Vec3<T>(T(0)), to<T>(axis), T(1), static_cast<T>(height / cylinder.radius)};
            put(groups.affine_cylinders, affine_cylinders,
                affine<T, CylinderKernel>(cylinder.base, cylinder.radius, setting, kernel), entry);
        }
    }
    double add_all(const Scene& scene, const Placement& placement, ThreadPool& pool);
    template <class G, class V>
    void finish(G& group, V& view, ItemBox* spare, ThreadPool& pool);

    /// Calls visit(group, view, number of the kernel).
    template <class Visit>
    void each_kernel(const Visit& visit) {
        visit(groups.spheres, world.groups.spheres, spheres);
        visit(groups.planes, world.groups.planes, planes);
        visit(groups.cylinders, world.groups.cylinders, cylinders);
        visit(groups.affine_spheres, world.groups.affine_spheres, affine_spheres);
        visit(groups.affine_cylinders, world.groups.affine_cylinders, affine_cylinders);
    }
};

/// Adds the primitives, all threads at once, each item where it would be if one came after the other. The largest
/// coordinate of a bounded one is returned.
template <class T>
double BuiltWorld<T>::Arrays::add_all(const Scene& scene, const Placement& placement, ThreadPool& pool) {
    constexpr std::int32_t stretch = 4096;
    const auto size = static_cast<std::int32_t>(scene.primitives.size());
    std::vector<Before> before(size / stretch + 2);
    share_out(pool, size, stretch, [&](std::int32_t first, std::int32_t last) {
        Before own;
        for (std::int32_t i = first; i < last; ++i) {
            const Primitive& primitive = scene.primitives[i];
            const bool similar = similarity(primitive.transformations) > 0;
            std::visit([&](const auto& shape) { ++own.items[kernel_of(shape, similar)], own.surfaces += shape.faces; },
                       primitive.shape);
        }
        before[first / stretch + 1] = own;
    });
    for (std::size_t i = 1; i < before.size(); ++i) before[i] += before[i - 1];
    const Before& all = before.back();
    each_kernel([&](auto& group, auto& view, int kernel) {
        view.count = all.items[kernel];
        group.items = uninitialized_buffer<typename std::remove_cvref_t<decltype(group)>::I>(view.count + widest);
        group.boxes = uninitialized_buffer<ItemBox>(view.count);
    });
    places = uninitialized_buffer<Place>(all.surfaces);

    std::vector<double> reaches(before.size());
    share_out(pool, size, stretch, [&](std::int32_t first, std::int32_t last) {
        Before own = before[first / stretch];
        std::fill(&places[own.surfaces], &places[before[first / stretch + 1].surfaces], Place{-1, -1});
        double reach = 0;
        for (std::int32_t i = first; i < last; ++i) {
            const Primitive& primitive = scene.primitives[i];
            const Setting setting{matrix(primitive.transformations), similarity(primitive.transformations), placement};
            Box box = world_bounds(primitive);
            box = {(box.low - placement.origin) * placement.scale, (box.high - placement.origin) * placement.scale};
            if (box.finite())
                for (int c = 0; c < 3; ++c) reach = std::max({reach, std::abs(box.low[c]), std::abs(box.high[c])});
            const Entry entry{own, box, static_cast<T>(own.surfaces), static_cast<T>(primitive.material)};
            std::visit([&](const auto& shape) { add(shape, setting, entry), own.surfaces += shape.faces; },
                       primitive.shape);
        }
        reaches[first / stretch] = reach;
    });
    return *std::max_element(reaches.begin(), reaches.end());
}

/// Makes a group's hierarchy and puts its items in order.
template <class T>
template <class G, class V>
void BuiltWorld<T>::Arrays::finish(G& group, V& view, ItemBox* spare, ThreadPool& pool) {
    constexpr std::int32_t stretch = 4096;
    using I = typename G::I;
    view.first_key = world.keys;
    world.keys += world.key_per_item ? view.count : 1;
    view.last_key = world.keys;
    if (!world.key_per_item && view.count > few_items && group.bounded) {
        Hierarchy hierarchy =
            build_hierarchy({group.boxes.get(), static_cast<std::size_t>(view.count)}, spare, rounding(reach), pool);
        group.nodes = std::move(hierarchy.nodes);
        view.nodes = group.nodes.get();
        Buffer<I> sorted = uninitialized_buffer<I>(view.count);
        share_out(pool, view.count, stretch, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) sorted[i] = group.items[hierarchy.order[i]];
        });
        // The columns take the place of the items as they came.
        constexpr std::size_t fields = sizeof(I) / sizeof(T);
        view.stride = view.count + widest;
        group.columns = Buffer<T>(reinterpret_cast<T*>(group.items.release()));
        group.items = std::move(sorted);
        share_out(pool, view.count, stretch, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) {
                const auto values = std::bit_cast<std::array<T, fields>>(group.items[i]);
                for (std::size_t f = 0; f < fields; ++f) group.columns[f * view.stride + i] = values[f];
            }
        });
        for (std::size_t f = 0; f < fields; ++f)
            std::fill_n(&group.columns[f * view.stride + view.count], widest, T(0));
        view.columns = group.columns.get();
    }
    if (world.key_per_item)
        for (int i = 0; i < view.count; ++i) {
            if (materials[static_cast<int>(group.items[i].material)].refraction > 0)
                glass |= BodySet(1) << volumes.size();
            volumes.push_back(bounding_volume_of(group.items[i].shape, group.boxes[i], reach * 0x1p-23));
        }
    group.boxes.reset();
    view.items = group.items.get();
    share_out(pool, view.count, stretch, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t i = first; i < last; ++i)
            for (int face = 0; face < group.items[i].shape.faces; ++face)
                places[static_cast<int>(group.items[i].surface) + face] = {
                    i, world.key_per_item ? view.first_key + i : view.first_key};
    });
}

/// What is known of each body, if there is a key for each.
template <class T>
void BuiltWorld<T>::Arrays::bound_bodies() {
    const double margin = rounding(reach);
    const std::size_t room = most_item_keys + widest;
    balls.assign(4 * room, -std::numeric_limits<T>::infinity());
    std::fill_n(balls.begin(), 3 * room, T(0));
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const auto [centre, radius] = volumes[i].ball;
        for (int c = 0; c < 3; ++c) balls[c * room + i] = static_cast<T>(centre[c]);
        balls[3 * room + i] = volumes[i].plane ? std::numeric_limits<T>::infinity() : static_cast<T>(radius + margin);
        if (glass >> i & 1 && !world.nested && isolated(volumes, i, margin)) world.enclosed |= BodySet(1) << i;
    }
    const T* const first = balls.data();
    world.centres = {first, first + room, first + 2 * room};
    world.radii = first + 3 * room;
}

template <class T>
void BuiltWorld<T>::Arrays::cull_for_lights() {
    for (const LightKernel<T>& light : lights) {
        const DVec3 point = twice(light.position);
        const double margin = rounding(reach + std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}));
        for (std::size_t i = 0; i < volumes.size(); ++i) {
            cones.push_back(cone_of<T>(volumes[i], point, margin));
            occluders.push_back(occluders_of(volumes, i, point, margin));
        }
    }
    world.cones = cones.data();
    world.occluders = occluders.data();
}

/// The cosine whose power is a 64th of the last bit of 1.
template <class T>
T shines_from(double exponent) {
    return std::pow(std::numeric_limits<T>::epsilon() / 64, 1 / static_cast<T>(exponent));
}

template <class T>
BuiltWorld<T>::Arrays::Arrays(const Scene& scene, const Placement& placement, ThreadPool& pool) {
    const DVec3 ambient = scene.settings.ambient_light;
    const std::vector<double> scattered = scattered_light(scene);
    for (const Material& m : scene.materials) {
        materials.push_back({to<T>(ambient * m.rgb * m.ambient), to<T>(m.rgb * m.diffuse), to<T>(m.rgb * m.refraction),
                             static_cast<T>(m.specular), static_cast<T>(m.pow), static_cast<T>(m.reflection),
                             static_cast<T>(m.refraction), static_cast<T>(m.ior), shines_from<T>(m.pow),
                             static_cast<T>(scattered[materials.size()])});
        world.transparent |= m.refraction > 0;
    }
    for (const Light& light : scene.lights)
        lights.push_back({to<T>((light.position - placement.origin) * placement.scale), to<T>(light.color)});
    world.nested = world.transparent && transparent_bodies_overlap(scene);
    world.background = to<T>(scene.background);

    reach = add_all(scene, placement, pool);
    if (world.nested) {
        int surface = 0;
        for (const Primitive& primitive : scene.primitives) {
            const Material& material = scene.materials[primitive.material];
            if (material.refraction > 0)
                transparent.push_back({surface, primitive.shape, glm::inverse(matrix(primitive.transformations))});
            const int faces = std::visit([](const auto& shape) { return shape.faces; }, primitive.shape);
            iors.insert(iors.end(), faces, static_cast<T>(material.ior));
            surface += faces;
        }
    }
    int items = 0, most = 0;
    each_kernel([&](auto& group, auto& view, int) {
        view.count = drop_duplicates<T>(group, view.count, pool);
        items += view.count;
        most = std::max(most, view.count);
    });
    world.key_per_item = items <= most_item_keys;
    const Buffer<ItemBox> spare = uninitialized_buffer<ItemBox>(most);
    each_kernel([&](auto& group, auto& view, int) { finish(group, view, spare.get(), pool); });
    world.places = places.get();
    world.materials = materials.data();
    world.lights = lights.data();
    world.light_count = static_cast<int>(lights.size());
    world.iors = iors.data();
    if (world.key_per_item) {
        bound_bodies();
        cull_for_lights();
    }
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
