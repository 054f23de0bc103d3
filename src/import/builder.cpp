#include "import/builder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>
#include <type_traits>

#include "num/decimal.h"
#include "num/vec_math.h"
#include "scene/overlap.h"
#include "text/reading/parameter.h"

namespace strahl {
namespace {

bool within(const DVec3& v, const NumberRange& range) {
    return range.contains(v.x) && range.contains(v.y) && range.contains(v.z);
}

double largest(const DVec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

/// Is it a direction once it is divided by its largest component?
bool has_direction(const DVec3& v) { return within(v, anything) && largest(v) >= smallest_positive; }

}  // namespace

void SceneBuilder::set_camera(const Camera& camera) {
    if (!within(camera.position, coordinates) || !within(camera.look_at, coordinates) ||
        !within(camera.up, coordinates))
        words.fail("the camera is too far away: coordinates are at most 1e9");
    if (const char* const fault = degenerate(camera)) words.fail(std::string("invalid camera: ") + fault);
    scene.camera = camera;
}

void SceneBuilder::add_light(Light light) {
    if (scene.lights.size() == limits.lights) words.fail("more than " + std::to_string(limits.lights) + " lights");
    if (!within(light.position, coordinates)) return warn("a light is left out: coordinates are at most 1e9");
    if (light.direction && !has_direction(*light.direction))
        return warn("a directional light is left out: it has no direction");
    if (light.direction && !within(*light.direction, directions)) *light.direction /= largest(*light.direction);
    if (light.spot && !(within(light.spot->look_at, coordinates) && light.spot->look_at != light.position))
        return warn("a spotlight is left out: it has no direction");
    if (Spot* const spot = light.spot ? &*light.spot : nullptr) {
        const double radius = std::clamp(spot->radius, 0., 90.), falloff = std::clamp(spot->falloff, radius, 90.);
        if (radius != spot->radius || falloff != spot->falloff)
            warn("the spotlight's angles are limited to the range from 0 to 90 degrees");
        spot->radius = radius, spot->falloff = falloff;
    }
    for (int i = 0; i < 3; ++i) {
        const double component = std::clamp(light.color[i], not_negative.low, not_negative.high);
        if (component != light.color[i]) warn("the light's colour is limited to the range from 0 to 1e9");
        light.color[i] = component;
    }
    scene.lights.push_back(light);
}

void SceneBuilder::set_fog(Fog fog) {
    const double distance = std::clamp(fog.distance, lengths.low, lengths.high);
    if (distance != fog.distance) warn("the fog's distance is " + text_of(distance) + " instead");
    fog.distance = distance;
    scene.fog = fog;
}

void SceneBuilder::set_material(Material changed) {
    const auto limit = [&](double& value, Range range, const char* name) {
        const auto [low, high, words, whole] = range_of(range);
        const double limited = std::clamp(value, low, high);
        if (limited != value)
            warn(std::string("the material's ") + name + " is " + text_of(value) + "; " + text_of(limited) +
                 " instead");
        value = limited;
    };
    const auto limit_field = [&](const auto& field) {
        auto& value = changed.*field.member;
        if constexpr (std::is_same_v<decltype(value), double&>)
            limit(value, field.range, field.name);
        else if constexpr (std::is_same_v<decltype(value), Pigment&>)
            for (int i = 0; i < 3; ++i) limit(value.color[i], field.range, field.name);
    };
    std::apply([&](const auto&... field) { (limit_field(field), ...); }, Material::fields);
    if (material == changed) return;
    end_mesh();
    material = changed;
}

template <class Value>
bool SceneBuilder::fits(const Value& value, Range range, const char* name, const char* kind) {
    const NumberRange allowed = argument_range(range);
    bool good = true;
    if constexpr (std::is_same_v<Value, DVec3>)
        good = within(value, allowed);
    else if constexpr (std::is_same_v<Value, double>)
        good = allowed.contains(value);
    if (!good) warn(std::string("a ") + kind + " is left out: its " + name + " must be " + allowed.words);
    return good;
}

void SceneBuilder::add(const Shape& shape) {
    end_mesh();
    count_body();
    put(shape);
}

/// Counts a body; of a mesh each triangle counts.
void SceneBuilder::count_body() {
    if (++bodies > limits.primitives) words.fail("more than " + std::to_string(limits.primitives) + " bodies");
}

void SceneBuilder::put(const Shape& shape) {
    const bool good = std::visit(
        [&](const auto& body) {
            using Kind = std::decay_t<decltype(body)>;
            const bool inside = std::apply(
                [&](const auto&... field) {
                    return (fits(body.*field.member, field.range, field.name, Kind::name) && ...);
                },
                Kind::fields);
            if (!inside) return false;
            const char* const fault = body.fault();
            if (fault) warn(std::string("a ") + Kind::name + " is left out: " + fault);
            return !fault;
        },
        shape);
    if (!good) return;
    scene.primitives.push_back({.shape = shape, .material = materials.number(material), .transformations = {}});
}

void SceneBuilder::add_plane(const DVec3& point, const DVec3& normal) {
    if (!has_direction(normal)) return warn("a plane is left out: its normal has no direction");
    const DVec3 n = normal / largest(normal);
    // Two directions in the plane, along coordinate axes if the normal is.
    const auto least = std::min({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
    DVec3 axis(0);
    axis[std::fabs(n.x) == least ? 0 : std::fabs(n.y) == least ? 1 : 2] = 1;
    const DVec3 u = cross_product(cross_product(n, axis), n), v = cross_product(n, u);
    const double step = std::max(1., std::exp2(std::floor(std::log2(1 + largest(point))) - 20));
    add(Plane{point, point + step / largest(u) * u, point + step / largest(v) * v});
}

void SceneBuilder::add_endless_cylinder(const DVec3& centre, const DVec3& axis, double radius) {
    if (!has_direction(axis)) return warn("a cylinder is left out: its axis has no direction");
    if (largest(centre) > largest_coordinate / 2) return warn("a cylinder is left out: it is too far away");
    warn("an endless cylinder: it ends far away here");
    const std::size_t before = scene.primitives.size();
    add(Cylinder{centre, centre + axis / largest(axis), radius});
    if (scene.primitives.size() > before) endless.push_back({before, centre, axis / largest(axis)});
}

void SceneBuilder::add_polygon(std::span<const DVec3> corners, std::span<const DVec3> bent) {
    for (const DVec3& corner : corners)
        if (!fits(corner, Range::any, "corners", "polygon")) return;
    for (const DVec3& normal : bent)
        if (!fits(normal, Range::direction, "normals", "polygon")) return;
    if (std::ranges::any_of(bent, [](const DVec3& normal) { return !(length(normal) > 0); })) {
        warn("a normal without a direction: this polygon is flat here");
        bent = {};
    }
    if (!triangles.empty() && bent.empty() != corner_normals.empty()) end_mesh();
    std::vector<std::int32_t> all(corners.size());
    std::iota(all.begin(), all.end(), 0);
    const auto cut = splitter.split({corners.begin(), corners.end()}, all);
    if (cut.empty())
        return warn("a polygon is left out: it is not convex and has more than " +
                    std::to_string(FaceSplitter::most_concave) + " corners");
    bool seen = false;
    for (const FaceSplitter::Triangle& triangle : cut) {
        const std::int32_t a = triangle[0], b = triangle[1], c = triangle[2];
        if (Triangle::flat(corners[a], corners[b], corners[c])) continue;
        seen = true;
        const auto joined = [&](PointJoiner& joiner, std::span<const DVec3> list) {
            return MeshData::Corners{joiner.number_of(list[a]), joiner.number_of(list[b]), joiner.number_of(list[c])};
        };
        triangles.push_back(joined(points, corners));
        if (!bent.empty()) corner_normals.push_back(joined(normals, bent));
        count_body();
    }
    if (!seen) warn("a polygon is left out: it has no area");
}

/// Turns the run of polygons into a body: a triangle, or a mesh.
void SceneBuilder::end_mesh() {
    if (triangles.empty()) return;
    MeshData mesh{std::move(points.points()), std::move(normals.points()), std::move(triangles),
                  std::move(corner_normals)};
    points = {}, normals = {}, triangles = {}, corner_normals = {};
    const auto corner = [&](int k) { return mesh.points[mesh.triangles[0][k]]; };
    const auto normal = [&](int k) { return mesh.normals[mesh.corner_normals[0][k]]; };
    if (mesh.triangles.size() > 1)
        put(Mesh{std::make_shared<const MeshData>(std::move(mesh)), ""});
    else if (mesh.corner_normals.empty())
        put(Triangle{corner(0), corner(1), corner(2)});
    else
        put(SmoothTriangle{corner(0), corner(1), corner(2), normal(0), normal(1), normal(2)});
}

double SceneBuilder::reach() const {
    double reach = std::max(1., largest(scene.camera.position));
    for (const Primitive& primitive : scene.primitives)
        if (const Box box = world_bounds(primitive); box.finite())
            reach = std::max({reach, largest(box.low), largest(box.high)});
    return reach;
}

void SceneBuilder::place_far() {
    const double far = std::min(1e4 * std::pow(10, std::ceil(std::log10(reach()))), largest_coordinate / 2);
    for (const EndlessCylinder& each : endless) {
        auto& cylinder = std::get<Cylinder>(scene.primitives[each.number].shape);
        cylinder.base = each.centre - far * each.axis, cylinder.cap = each.centre + far * each.axis;
    }
}

Imported SceneBuilder::finish(std::string_view file) {
    end_mesh();
    if (!endless.empty()) place_far();
    scene.materials = std::move(materials.list);
    return {.scene = std::move(scene), .size = size, .warnings = warnings.messages(file)};
}

}  // namespace strahl
