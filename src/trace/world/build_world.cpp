#include "trace/world/build_world.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <unordered_map>
#include <vector>

#include "files/error.h"
#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "trace/world/extended_numbers.h"
#include "trace/world/light_bound.h"
#include "trace/world/world_arrays.h"

namespace strahl {
namespace {

/// Returns the cosine whose power is a 64th of the last bit of 1.
template <class T>
T shines_from(double exponent) {
    return std::pow(std::numeric_limits<T>::epsilon() / 64, 1 / static_cast<T>(exponent));
}

/// Returns the bounding volume of a kernel; from its box, whose corners may be off by `slack`, if the kernel has no
/// ball.
template <class Kind, class K>
BoundingVolume bounding_volume_of(const K& kernel, const ItemBox& rounded, double slack) {
    Box box;
    for (int c = 0; c < 3; ++c) box.low[c] = rounded.low[c] - slack, box.high[c] = rounded.high[c] + slack;
    if constexpr (!Kind::bounded) {
        return {box, {}, true, to_double(kernel.normal), static_cast<double>(kernel.distance)};
    } else if constexpr (requires { kernel.ball(); }) {
        return {box, kernel.ball()};
    } else if (!box.finite()) {
        return {box, {DVec3(0), std::numeric_limits<double>::infinity()}};
    } else {
        const DVec3 size = box.size();
        return {box, {box.centre(), std::hypot(size.x, size.y, size.z) / 2}};
    }
}

template <class T>
LightKernel<T> light_kernel(const Light& light, const Placement& placement) {
    using M = Made<T>;
    const Vec3<M> position = (cast<M>(light.position) - cast<M>(placement.origin)) * M(placement.scale);
    LightKernel<T> kernel{};
    kernel.position = Vec3<T>(position), kernel.color = cast<T>(light.color);
    if (light.direction) {
        if constexpr (std::is_same_v<M, Extended>)
            kernel.position = -quick_unit(extended(*light.direction));
        else
            kernel.position = cast<T>(-normalize(*light.direction));
        kernel.finite = 0, kernel.far = std::numeric_limits<T>::infinity();
    }
    if (light.area) {
        // Shorter edges than this have no more digits; nothing that can be seen depends on their length.
        constexpr double shortest = 1e-7;
        const auto edge = [&](const DVec3& given) {
            const double own = length(given);
            return cast<T>(std::max(own * placement.scale, shortest) / own * given);
        };
        AreaKernel<T>& area = kernel.rectangle;
        kernel.area = true, area.soft = light.soft;
        // Edges may lose their right angle if the light moves and is scaled unevenly. Those of a grid need none.
        const DVec3 along = normalize(light.area->u);
        const double slant = light.area->columns > 0 ? 0 : dot_product(light.area->v, along);
        area.u = edge(light.area->u), area.v = edge(light.area->v - slant * along);
        area.columns = light.area->columns, area.rows = light.area->rows;
        area.adaptive = static_cast<std::int32_t>(light.adaptive);
        area.circular = light.circular, area.jitter = light.jitter;
        area.orient = light.orient, area.mirrored = light.mirrored;
    }
    if (light.direction && light.from) {
        kernel.starts = true;
        const DVec3 start = (*light.from - placement.origin) * placement.scale;
        kernel.start = static_cast<T>(-dot_product(normalize(*light.direction), start));
        kernel.beam = {cast<T>(start), static_cast<T>(light.beam * placement.scale),
                       static_cast<T>(light.core * placement.scale), static_cast<T>(light.tightness)};
    }
    if (light.spot) {
        const auto less_cosine = [](double degrees) {  // 1 - cos(degrees)
            const M sine = std::sin(degrees * (std::numbers::pi_v<M> / 360));
            return 2 * sine * sine;
        };
        const M radius = less_cosine(light.spot->radius), falloff = less_cosine(light.spot->falloff);
        SpotKernel<T>& cone = kernel.cone;
        kernel.spot = true;
        if constexpr (std::is_same_v<M, Extended>)
            cone.axis = quick_unit(extended(light.spot->look_at) - extended(light.position));
        else
            cone.axis = cast<T>(normalize(light.spot->look_at - light.position));
        cone.radius = static_cast<T>(radius), cone.falloff = static_cast<T>(falloff);
        cone.per = static_cast<T>(1 / (falloff - radius));
        cone.tightness = static_cast<T>(light.spot->tightness);
    }
    kernel.shadowless = light.shadowless;
    if (light.fades()) {
        kernel.fade_per = static_cast<T>(1 / (light.fade_distance * placement.scale));
        kernel.fade_power = static_cast<T>(light.fade_power);
    }
    kernel.special = kernel.area || kernel.starts || kernel.shadowless || kernel.fade_per > 0;
    return kernel;
}

template <class T>
FogKernel<T> fog_kernel(const Fog& fog, const Placement& placement) {
    const long double per = 1 / (fog.distance * placement.scale);
    FogKernel<T> own{true, static_cast<T>(std::min<long double>(per, std::numeric_limits<T>::max())),
                     cast<T>(fog.color)};
    own.swirls = fog.turbulence != DVec3(0);
    own.even = !(fog.altitude > 0) && fog.transmit == 0 && fog.filter == 0 && !own.swirls;
    own.turbulence = fog.turbulence, own.place = placement.origin, own.unit = 1 / placement.scale;
    own.octaves = static_cast<int>(fog.octaves), own.generator = static_cast<int>(fog.generator);
    own.omega = static_cast<float>(fog.omega), own.lambda = static_cast<float>(fog.lambda), own.depth = fog.depth;
    own.least = static_cast<T>(fog.transmit);
    own.tint = cast<T>(Color(1 - fog.filter) + fog.filter * fog.color);
    own.base = -1;  // all points are below the ground fog's top
    if (fog.altitude > 0 && length(fog.up) > 0) {
        const DVec3 up = normalize(fog.up);
        // Lower fog is not seen, and heights in its units would overflow.
        const double altitude = std::max(fog.altitude, 1e-6 / placement.scale);
        own.rise = cast<T>(up / (altitude * placement.scale));
        own.base = static_cast<T>((dot_product(up, placement.origin) - fog.offset) / altitude);
    }
    return own;
}

/// May rays of the eye start in an opaque body, which matters to fog, unless it is hollow, and to `fresnel`?
bool encloses_eye(const Scene& scene, const Primitive& body, bool fresnel) {
    const Material& own = scene.materials[static_cast<std::size_t>(body.material)];
    return scene.settings.passed_over > 0 && (fresnel || (scene.fog && !own.hollow)) && !own.transmits() &&
           (starts_apart(scene.camera.projection) || contains(body, scene.camera.position));
}

}  // namespace

/// Sets the `Group` pointers by which kernels reach the items; in small worlds also makes their volumes.
template <class T>
void WorldArrays<T>::fill_groups() {
    int form = 0, bin = 0;
    world.groups.each([&](auto& group) {
        using Form = typename std::remove_cvref_t<decltype(group)>::Form;
        FormItems<T>& own = forms[form++];
        group.items = reinterpret_cast<const Item<Form, T>*>(own.numbers.get());
        group.count = own.count, group.in_hierarchy = own.in_hierarchy;
        group.columns = own.columns.get();
        group.first_bin = bin;
        bin += world.bin_per_item ? own.count : 1;
        if (!world.bin_per_item) return;
        for (int i = 0; i < own.count; ++i) {
            few.volumes.push_back(
                bounding_volume_of<typename Form::Kind>(group.items[i].shape, own.boxes[i], reach * 0x1p-23));
            bool shadows = finishes.list.empty();
            const auto add = [&](auto material) { shadows = shadows || finishes.list[std::size_t(material)].shadow; };
            if constexpr (std::is_same_v<Form, CompositeForm>) {
                const CompositeInfo& info = composites.list[std::size_t(group.items[i].shape.number)];
                for (int leaf = 0; leaf < info.leaves; ++leaf) add(composites.leaves[info.first_leaf + leaf].material);
            } else {
                add(group.items[i].material);
            }
            few.shadowing |= BodySet(shadows) << (group.first_bin + i);
        }
    });
    boxes.reset();
}

template <class T>
void WorldArrays<T>::add_materials(const Scene& scene) {
    using M = Made<T>;
    const Vec3<M> ambient = cast<M>(scene.settings.ambient_light);
    const std::vector<double> scattered = scattered_light(scene);
    for (const Material& m : scene.materials) {
        const Vec3<M> rgb = cast<M>(m.rgb.color);
        materials.push_back({Vec3<T>(ambient * rgb * M(m.ambient)), Vec3<T>(rgb * M(m.diffuse)),
                             Vec3<T>(rgb * M(m.refraction)), static_cast<T>(m.specular), static_cast<T>(m.pow),
                             static_cast<T>(m.reflection), static_cast<T>(m.refraction), static_cast<T>(m.ior),
                             shines_from<T>(m.pow), static_cast<T>(scattered[materials.size()])});
        world.transparent |= m.refraction > 0;
    }
}

/// Lists the transparent bodies if rays have to know which they are in: if these may overlap, and with fog.
template <class T>
void WorldArrays<T>::list_transparent(const Scene& scene) {
    const auto encloses = [&](const Primitive& body) { return encloses_eye(scene, body, world.finishes.fresnel); };
    const auto shares = [](const Material& m) { return m.transmits() && (m.bends() || m.interior > 0); };
    world.finishes.enclosed = std::ranges::any_of(scene.primitives, encloses);
    world.nested =
        world.finishes.enclosed || (world.transparent && (world.fog.any || transparent_bodies_overlap(scene) ||
                                                          std::ranges::any_of(scene.materials, shares)));
    if (!world.nested) return;
    ItemCounts before;
    std::unordered_map<int, std::int32_t> shared;  // the first surfaces of interiors
    const bool any_hollow = std::ranges::any_of(scene.materials, &Material::hollow);
    for (const Primitive& primitive : scene.primitives) {
        const Material* medium = &scene.materials[primitive.material];
        for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            const Material& own = scene.materials[leaf.material];
            if (!medium->transmits() && own.transmits()) medium = &own;
        });
        const auto body = static_cast<std::int32_t>(before.surfaces);
        count_items<T>(primitive, before);
        media.bodies.resize(before.surfaces, body);
        media.iors.resize(before.surfaces, static_cast<T>(medium->ior));
        if (any_hollow) media.hollow.resize(before.surfaces, medium->hollow);
        int surface = body;
        for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            const Material& own = scene.materials[leaf.material];
            const auto* const mesh = std::get_if<Mesh>(&leaf.shape);
            const int faces = &leaf == &primitive ? static_cast<int>(before.surfaces) - body
                              : mesh              ? static_cast<int>(mesh->data->triangles.size())
                                                  : faces_of(leaf.shape);
            if (own.interior > 0) {
                const std::int32_t first = shared.try_emplace(own.interior, surface).first->second;
                std::fill_n(media.bodies.begin() + surface, faces, first);
                media.iors[first] = static_cast<T>(own.ior);
                if (any_hollow) media.hollow[first] = own.hollow;
            }
            surface += faces;
        });
        const int interior = scene.materials[primitive.material].interior;
        const auto around = interior > 0 ? shared.find(interior) : shared.end();
        const bool fills = medium->transmits() || encloses(primitive);
        if (fills)
            media.transparent.push_back({body, around == shared.end() ? media.bodies[body] : around->second,
                                         primitive.shape, glm::inverse(matrix(primitive.transformations))});
    }
    world.media = {media.iors.data(), media.bodies.data(), any_hollow ? media.hollow.data() : nullptr};
}

/// Finds balls around all bodies, and which can shadow which, if there is a bin for each.
template <class T>
void WorldArrays<T>::bound_bodies() {
    const double margin = rounding(reach);
    auto& [volumes, glass, shadowing, balls, boxes, cones, shadows, columns, occluders] = few;
    const std::size_t stride = most_item_bins + widest_pack;
    balls.assign(4 * stride, -std::numeric_limits<T>::infinity());
    std::fill_n(balls.begin(), 3 * stride, T(0));
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        const auto [centre, radius] = volumes[i].ball;
        for (int c = 0; c < 3; ++c) balls[c * stride + i] = static_cast<T>(centre[c]);
        balls[3 * stride + i] = volumes[i].plane ? std::numeric_limits<T>::infinity() : static_cast<T>(radius + margin);
        boxes.push_back({cast<T>(volumes[i].box.low - DVec3(margin)), cast<T>(volumes[i].box.high + DVec3(margin))});
        // In nested worlds rays carry more than the queue of rays inside bodies holds.
        if ((glass & world.few.convex) >> i & 1 && !world.nested && isolated(volumes, i, margin))
            world.few.enclosed |= BodySet(1) << i;
    }
    const T* const first = balls.data();
    world.few.centres = {first, first + stride, first + 2 * stride};
    world.few.radii = first + 3 * stride;
    world.few.boxes = boxes.data();
}

template <class T>
void WorldArrays<T>::cull_for_lights() {
    auto& [volumes, glass, shadowing, balls, boxes, cones, shadows, columns, occluders] = few;
    for (LightKernel<T>& light : lights) {
        const LightPlace place{to_double(light.position), light.finite == 0};
        const DVec3& point = place.point;
        const double margin = rounding(reach + std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}));
        const bool across = place.parallel && !light.area;
        const LightAxes axes = across ? axes_across(volumes, point) : LightAxes{};
        if (across) light.u = Vec3<T>(axes.u), light.v = Vec3<T>(axes.v);
        shadows.push_back(shadows_of<T>(across ? volumes : std::vector<BoundingVolume>(), axes, margin));
        for (std::size_t i = 0; i < sort_bins.size(); ++i) {
            const bool known = i < volumes.size() && !light.area;
            cones.push_back(known ? cone_of<T>(volumes[i], place, margin) : LightCone<T>());
            occluders.push_back(shadowing & (known ? occluders_of(volumes, i, place, margin) : ~BodySet(0)));
        }
    }
    world.few.cones = cones.data();
    world.few.shadows = shadows.data();
    world.few.occluders = occluders.data();
    constexpr std::size_t stride = FewBodies<T>::cone_stride;
    columns.resize(5 * stride * lights.size());
    for (std::size_t n = 0; n < cones.size(); ++n) {
        T* const to = columns.data() + n / world.bins * 5 * stride + n % world.bins;
        const auto& [axis, cosine, distance] = cones[n];
        to[0] = axis.x, to[stride] = axis.y, to[2 * stride] = axis.z, to[3 * stride] = cosine,
        to[4 * stride] = distance;
    }
    world.few.cone_columns = columns.data();
}

template <class T>
void WorldArrays<T>::add_lights(const Scene& scene, const Placement& placement) {
    for (const Light& light : points_of(scene.lights)) {
        lights.push_back(light_kernel<T>(light, placement));
        lights.back().group = finishes.group_number(light.group);
        lights.back().special |= light.group != 0;
    }
    world.lights = lights.data();
    world.light_count = static_cast<int>(lights.size());
}

template <class T>
WorldArrays<T>::WorldArrays(const WorldArrays& bodies, const Scene& scene, const Placement& placement)
    : world(bodies.world),
      sort_bins(bodies.sort_bins),
      reach(bodies.reach),
      moving(nullptr),
      images(bodies.images),
      lanes(bodies.lanes),
      meshes(bodies.meshes) {
    finishes.groups = bodies.finishes.groups, few.volumes = bodies.few.volumes;
    few.shadowing = bodies.few.shadowing;
    add_lights(scene, placement);
    if (world.bin_per_item) cull_for_lights();
}

template <class T>
void WorldArrays<T>::share(const WorldArrays& other) {
    const auto take = [](auto& own, const auto& theirs, std::size_t count) {
        if (own && theirs && std::memcmp(own.get(), theirs.get(), count * sizeof(own[0])) == 0) own = theirs;
    };
    int form = 0;
    world.groups.each([&](auto& group) {
        using Form = typename std::remove_cvref_t<decltype(group)>::Form;
        FormItems<T>& own = forms[form];
        const FormItems<T>& theirs = other.forms[form];
        const std::size_t fields = traits[form++].fields;
        if (own.count != theirs.count || own.in_hierarchy != theirs.in_hierarchy) return;
        if (composites.list.empty()) take(own.numbers, theirs.numbers, own.count * fields);  // leaves point to them
        take(own.columns, theirs.columns, own.in_hierarchy * fields);
        group.items = reinterpret_cast<const Item<Form, T>*>(own.numbers.get());
        group.columns = own.columns.get();
    });
    if (surfaces == other.surfaces) take(references, other.references, std::size_t(surfaces) + 1);
    world.references = &references[1];
}

template <class T>
void WorldArrays<T>::point_at_patterns() {
    world.patterns.list = patterns.list.data(), world.patterns.bends = patterns.bends.data();
    world.patterns.stops = patterns.stops.data(), world.patterns.nested = patterns.nested.data();
    if (patterns.sky) world.patterns.sky = &*patterns.sky;
    world.patterns.coats = patterns.coats.data(), world.patterns.coat_count = static_cast<int>(patterns.coats.size());
    world.finishes.list = finishes.list.data(), world.finishes.layers = finishes.layers.data();
    world.finishes.shares = finishes.shares.data(), world.finishes.bends = finishes.bends.data();
    const auto averaged = [](const PatternKernel<T>& pattern) { return has_quick_mean(pattern.form); };
    world.patterns.has_quick_means =
        std::ranges::any_of(patterns.list, averaged) || std::ranges::any_of(patterns.nested, averaged) ||
        std::ranges::any_of(finishes.layers, averaged, &LayerKernel<T>::pattern) ||
        std::ranges::any_of(finishes.shares, averaged) || (patterns.sky && averaged(*patterns.sky));
}

template <class T>
void WorldArrays<T>::set_distances(const Settings& settings, const Placement& placement, bool proves) {
    world.rounding = static_cast<T>(rounding(reach));
    if (!proves && settings.passed_over > 0) {
        world.around_lights = 64 * std::numeric_limits<T>::epsilon();
        world.shadow_rays = ShadowRays::past_near;
    }
    const double passed_over = settings.passed_over * placement.scale;
    // Leaves the distance 0 where rounding is as large: there rays would meet the surface again that they start on.
    if (!proves && passed_over > 1024 * std::numeric_limits<T>::epsilon() * reach) {
        world.passed_over = static_cast<T>(passed_over);
        world.passed_in_shadows = static_cast<T>(10 * passed_over);
        if (world.finishes.list && world.transparent) world.shadow_rays = ShadowRays::followed_where_dimmed;
    }
    if (world.finishes.follows) world.shadow_rays = ShadowRays::followed;
    if (!proves && settings.farthest > 0) world.farthest = static_cast<T>(settings.farthest * placement.scale);
}

template <class T>
WorldArrays<T>::WorldArrays(const Scene& scene, const Placement& placement, ThreadPool& pool, MovingHierarchy* moving,
                            std::shared_ptr<Images> kept, bool proves, int lanes, const SharedMeshes<T>* meshes)
    : moving(moving), images(std::move(kept)), lanes(lanes), meshes(meshes) {
    // Each step needs what those before it have made.
    add_materials(scene);
    add_finishes(scene, placement);          // the finishes of these materials
    add_patterns(scene, placement, proves);  // with more materials: one for each space that a pattern is in
    point_at_patterns();
    add_lights(scene, placement);  // their groups are numbered by add_finishes
    if (scene.fog) world.fog = fog_kernel<T>(*scene.fog, placement);
    world.background = cast<T>(scene.background.color);
    world.materials = materials.data();
    list_transparent(scene);

    add_items(scene, placement, pool, proves);         // items have the numbers of materials
    set_distances(scene.settings, placement, proves);  // they depend on how far the items reach
    arrange_items(pool, proves);
    add_composites(scene, placement, pool, proves);  // their leaves follow the items of their forms
    world.sort_bins = sort_bins.data();
    world.bins = references[0].bin = static_cast<int>(sort_bins.size());
    fill_groups();
    if (world.bin_per_item) {
        bound_bodies();
        cull_for_lights();
    }
}

template <class T>
BuiltWorld<T>::BuiltWorld(const Scene& scene, const Placement& placement, ThreadPool& pool, MovingHierarchy* moving,
                          const std::shared_ptr<Images>& images, bool proves, int lanes, const SharedMeshes<T>* meshes)
    : arrays(std::make_unique<WorldArrays<T>>(scene, placement, pool, moving,
                                              images ? images : std::make_shared<Images>(), proves, lanes, meshes)) {}
template <class T>
BuiltWorld<T>::BuiltWorld(std::shared_ptr<const BuiltWorld> own_bodies, const Scene& scene, const Placement& placement)
    : bodies(own_bodies->bodies ? own_bodies->bodies : std::move(own_bodies)),
      arrays(std::make_unique<WorldArrays<T>>(*bodies->arrays, scene, placement)) {}
template <class T>
BuiltWorld<T>::~BuiltWorld() = default;
template <class T>
void BuiltWorld<T>::share(const BuiltWorld& other) {
    arrays->share(*(other.bodies ? *other.bodies : other).arrays);
}
template <class T>
const World<T>& BuiltWorld<T>::world() const {
    return arrays->world;
}
template <class T>
std::vector<int> BuiltWorld<T>::bodies_around(const DVec3& eye) const {
    if (bodies) return bodies->bodies_around(eye);
    std::vector<int> around;
    for (const auto& body : arrays->media.transparent)
        if (arrays->world.references[body.surface].item >= 0 &&
            std::visit([&](const auto& shape) { return shape.contains(transform_point(body.inverse, eye)); },
                       body.shape) &&
            std::ranges::find(around, body.medium) == around.end())
            around.push_back(body.medium);
    return around;
}

template <class T>
std::vector<int> BuiltWorld<T>::materials() const {
    if (bodies) return bodies->materials();
    const auto& copies = arrays->copied_materials;
    std::vector<int> all(arrays->materials.size() - copies.size());
    std::iota(all.begin(), all.end(), 0);
    all.insert(all.end(), copies.begin(), copies.end());
    return all;
}

template <class T>
double BuiltWorld<T>::reach() const {
    return arrays->reach;
}

template <class T>
bool BuiltWorld<T>::lacks_items(const Scene& scene) const {
    ItemCounts declared;
    for (const Primitive& primitive : scene.primitives) count_items<T>(primitive, declared);
    int form = 0;
    bool lacks = false;
    world().groups.each([&](const auto& group) { lacks |= group.count != declared.items[form++]; });
    return lacks;
}

std::vector<int> primitives_of_surfaces(const Scene& scene) {
    std::vector<int> all;
    ItemCounts counts;
    for (const Primitive& primitive : scene.primitives) {
        count_items<float>(primitive, counts);
        all.resize(static_cast<std::size_t>(counts.surfaces), static_cast<int>(&primitive - scene.primitives.data()));
    }
    return all;
}

std::int64_t surfaces_of(const Scene& scene) {
    ItemCounts counts;
    for (const Primitive& primitive : scene.primitives) count_items<float>(primitive, counts);
    return counts.surfaces;
}

template <class T>
void check_capacity(std::int64_t surfaces) {
    constexpr double most = std::min<double>(World<T>::capacity, std::numeric_limits<int>::max());
    if (static_cast<double>(surfaces) <= most) return;
    throw FileError("this scene has " + std::to_string(surfaces) + " surfaces, and in this precision at most " +
                    std::to_string(static_cast<std::int64_t>(most)) +
                    " can be told apart; trace it with --precision double");
}
template void check_capacity<float>(std::int64_t);
template void check_capacity<double>(std::int64_t);
template void check_capacity<long double>(std::int64_t);

template class BuiltWorld<float>;
template class BuiltWorld<double>;
template class BuiltWorld<long double>;

}  // namespace strahl
