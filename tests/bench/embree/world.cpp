#include "world.h"

#include <stdexcept>
#include <string>

#include "tests/bench/flat.h"

namespace strahl::bench {
namespace {

Vec3<float> to_float(const DVec3& v) { return Vec3<float>(v); }

/// Lane i of a packet's rays, whatever its width.
Ray<float> ray_of(RTCRayN* rays, unsigned n, unsigned i) {
    return {{RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
            {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
            -1};
}
/// All lanes; in Embree's memory a value's lanes follow each other.
Ray<S> packet_of(RTCRayN* rays) {
    return {{load_lanes<S>(&RTCRayN_org_x(rays, lanes, 0)), load_lanes<S>(&RTCRayN_org_y(rays, lanes, 0)),
             load_lanes<S>(&RTCRayN_org_z(rays, lanes, 0))},
            {load_lanes<S>(&RTCRayN_dir_x(rays, lanes, 0)), load_lanes<S>(&RTCRayN_dir_y(rays, lanes, 0)),
             load_lanes<S>(&RTCRayN_dir_z(rays, lanes, 0))},
            S(-1)};
}

struct Crossings {
    float near[16], far[16], near_face[16], far_face[16];
    bool hit[16];
};
Crossings cross(const CylinderKernel<float>& cylinder, RTCRayN* rays, unsigned n, const int* valid) {
    Crossings c;
    if (n == lanes) {
        const Span<S> span = cylinder.span(packet_of(rays), S(-1));
        store_lanes(c.near, span.near), store_lanes(c.far, span.far);
        store_lanes(c.near_face, span.near_face), store_lanes(c.far_face, span.far_face);
        float hit[lanes];
        store_lanes(hit, select(span.hit, S(1), S(0)));
        for (int i = 0; i < lanes; ++i) c.hit[i] = valid[i] && hit[i] != 0;
        return c;
    }
    for (unsigned i = 0; i < n; ++i) {
        const Span<float> span = cylinder.span(ray_of(rays, n, i), -1.f);
        c.near[i] = span.near, c.far[i] = span.far, c.hit[i] = valid[i] && span.hit;
        c.near_face[i] = span.near_face, c.far_face[i] = span.far_face;
    }
    return c;
}

void cylinder_bounds(const RTCBoundsFunctionArguments* a) {
    const auto& k = static_cast<const Group*>(a->geometryUserPtr)->cylinders[a->primID];
    const DVec3 base(k.base), axis(k.axis);
    const Box box = Cylinder{base, base + static_cast<double>(k.height) * axis, k.radius}.bounds();
    const double margin = 1e-5 * (k.height + k.radius);
    *a->bounds_o = {static_cast<float>(box.low.x - margin),  static_cast<float>(box.low.y - margin),
                    static_cast<float>(box.low.z - margin),  0,
                    static_cast<float>(box.high.x + margin), static_cast<float>(box.high.y + margin),
                    static_cast<float>(box.high.z + margin), 0};
}

void intersect_cylinder(const RTCIntersectFunctionNArguments* a) {
    const auto& cylinder = static_cast<const Group*>(a->geometryUserPtr)->cylinders[a->primID];
    RTCRayN* const rays = RTCRayHitN_RayN(a->rayhit, a->N);
    RTCHitN* const hits = RTCRayHitN_HitN(a->rayhit, a->N);
    const Crossings c = cross(cylinder, rays, a->N, a->valid);
    for (unsigned i = 0; i < a->N; ++i) {
        if (!c.hit[i]) continue;
        const bool enters = c.near[i] > 0;
        const float t = enters ? c.near[i] : c.far[i], face = enters ? c.near_face[i] : c.far_face[i];
        if (!(t > 0 && t < RTCRayN_tfar(rays, a->N, i))) continue;
        const Vec3<float> normal = cylinder.at(ray_of(rays, a->N, i), t, face).normal;
        RTCRayN_tfar(rays, a->N, i) = t;
        RTCHitN_Ng_x(hits, a->N, i) = normal.x;
        RTCHitN_Ng_y(hits, a->N, i) = normal.y;
        RTCHitN_Ng_z(hits, a->N, i) = normal.z;
        RTCHitN_primID(hits, a->N, i) = a->primID;
        RTCHitN_geomID(hits, a->N, i) = a->geomID;
        RTCHitN_instID(hits, a->N, i, 0) = RTC_INVALID_GEOMETRY_ID;
    }
}

void weaken(ShadowContext& context, unsigned ray, const Surface<float>& surface) {
    for (int c = 0; c < 3; ++c) context.share[c][ray] *= surface.filter[c];
}

/// An opaque cylinder blocks; a transparent one weakens the light once for each of its two surfaces crossed.
void occlude_cylinder(const RTCOccludedFunctionNArguments* a) {
    const Group& group = *static_cast<const Group*>(a->geometryUserPtr);
    const Surface<float>& surface = (*group.materials)[group.material[a->primID]];
    const Crossings c = cross(group.cylinders[a->primID], a->ray, a->N, a->valid);
    for (unsigned i = 0; i < a->N; ++i) {
        if (!c.hit[i]) continue;
        float& far = RTCRayN_tfar(a->ray, a->N, i);
        const int crossed = (c.near[i] > 0 && c.near[i] < far) + (c.far[i] > 0 && c.far[i] < far);
        if (crossed && surface.refraction == 0) far = -std::numeric_limits<float>::infinity();
        if (surface.refraction > 0)
            for (int k = 0; k < crossed; ++k)
                weaken(*reinterpret_cast<ShadowContext*>(a->context), RTCRayN_id(a->ray, a->N, i), surface);
    }
}

/// Weakens light at transparent balls; Embree reports both of their surfaces.
void pass_through(const RTCFilterFunctionNArguments* a) {
    const Group& group = *static_cast<const Group*>(a->geometryUserPtr);
    for (unsigned i = 0; i < a->N; ++i) {
        if (!a->valid[i]) continue;
        a->valid[i] = 0;
        weaken(*reinterpret_cast<ShadowContext*>(a->context), RTCRayN_id(a->ray, a->N, i),
               (*group.materials)[group.material[RTCHitN_primID(a->hit, a->N, i)]]);
    }
}

void attach(World& world, RTCGeometry geometry, int id) {
    rtcSetGeometryUserData(geometry, &world.groups[id]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(world.scene, geometry, id);
    rtcReleaseGeometry(geometry);
    world.empty = false;
}

/// Attaches all opaque meshes, or all transparent ones, as one geometry.
void attach_meshes(World& world, const std::vector<Body<MeshData>>& meshes, bool clear) {
    std::size_t points = 0, triangles = 0;
    const auto own = [&](const Body<MeshData>& mesh) {
        return (world.materials[mesh.material].refraction > 0) == clear;
    };
    for (const auto& mesh : meshes)
        if (own(mesh)) points += mesh.shape.points.size(), triangles += mesh.shape.triangles.size();
    if (triangles == 0) return;
    const RTCGeometry geometry = rtcNewGeometry(world.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* point = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), points));
    auto* corner = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles));
    std::size_t before = 0;
    for (const auto& mesh : meshes) {
        if (!own(mesh)) continue;
        for (const DVec3& p : mesh.shape.points)
            for (int c = 0; c < 3; ++c) *point++ = static_cast<float>(p[c]);
        for (const auto& triangle : mesh.shape.triangles)
            for (const int i : triangle) *corner++ = static_cast<unsigned>(before) + i;
        before += mesh.shape.points.size();
        world.groups[4 + clear].material.resize(world.groups[4 + clear].material.size() + mesh.shape.triangles.size(),
                                                mesh.material);
    }
    if (clear) rtcSetGeometryOccludedFilterFunction(geometry, pass_through);
    attach(world, geometry, 4 + clear);
}

}  // namespace

World::World(const Scene& from, int threads) : background(to_float(from.background.color)) {
    device = rtcNewDevice(("threads=" + std::to_string(threads)).c_str());
    if (!device) throw std::runtime_error("Embree does not start");
    scene = rtcNewScene(device);
    for (const Material& m : from.materials) {
        const Color& rgb = m.rgb.color;
        materials.push_back({to_float(from.settings.ambient_light * rgb * m.ambient), to_float(rgb * m.diffuse),
                             to_float(rgb * m.refraction), static_cast<float>(m.specular), static_cast<float>(m.pow),
                             static_cast<float>(m.reflection), static_cast<float>(m.refraction),
                             static_cast<float>(m.ior)});
    }
    for (const Light& light : from.lights) lights.push_back({to_float(light.position), to_float(light.color)});
    for (Group& group : groups) group.materials = &materials;
    const auto transparent = [&](int material) { return from.materials[material].refraction > 0; };

    const FlatScene flat = flatten(from);
    for (const auto& [plane, material] : flat.planes) {
        const DVec3 n = plane.normal();
        planes.push_back({to_float(n), static_cast<float>(glm::dot(n, plane.a))});
        plane_material.push_back(material);
    }
    for (const bool clear : {false, true}) {
        std::vector<float> balls;
        for (const auto& [ball, material] : flat.spheres)
            if (transparent(material) == clear) {
                for (int c = 0; c < 3; ++c) balls.push_back(static_cast<float>(ball.centre[c]));
                balls.push_back(static_cast<float>(ball.radius));
                groups[clear].material.push_back(material);
            }
        if (!balls.empty()) {
            const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
            void* const buffer =
                rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 16, balls.size() / 4);
            std::memcpy(buffer, balls.data(), balls.size() * sizeof(float));
            if (clear) rtcSetGeometryOccludedFilterFunction(geometry, pass_through);
            attach(*this, geometry, clear);
        }
        Group& group = groups[2 + clear];
        for (const auto& [cylinder, material] : flat.cylinders)
            if (transparent(material) == clear) {
                const DVec3 rise = cylinder.cap - cylinder.base;
                group.cylinders.push_back({to_float(cylinder.base), to_float(cylinder.axis()),
                                           static_cast<float>(cylinder.radius), static_cast<float>(glm::length(rise))});
                group.material.push_back(material);
            }
        if (!group.cylinders.empty()) {
            const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
            rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(group.cylinders.size()));
            rtcSetGeometryBoundsFunction(
                geometry, [](const RTCBoundsFunctionArguments* a) { cylinder_bounds(a); }, nullptr);
            rtcSetGeometryIntersectFunction(geometry, intersect_cylinder);
            rtcSetGeometryOccludedFunction(geometry, occlude_cylinder);
            attach(*this, geometry, 2 + clear);
        }
        attach_meshes(*this, flat.meshes, clear);
    }
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build the scene");
}

World::~World() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}

}  // namespace strahl::bench
