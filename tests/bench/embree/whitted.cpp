#include "whitted.h"

#include <algorithm>
#include <type_traits>

namespace strahl::bench {
namespace {

using RayHit = std::conditional_t<lanes == 16, RTCRayHit16, std::conditional_t<lanes == 8, RTCRayHit8, RTCRayHit4>>;
using ShadowRay = std::conditional_t<lanes == 16, RTCRay16, std::conditional_t<lanes == 8, RTCRay8, RTCRay4>>;

// Embree's functions for this machine's lanes.
using Context = RTCIntersectContext;
void intersect(const int* valid, RTCScene scene, Context* context, auto* rays) {
    if constexpr (lanes == 16)
        rtcIntersect16(valid, scene, context, rays);
    else if constexpr (lanes == 8)
        rtcIntersect8(valid, scene, context, rays);
    else
        rtcIntersect4(valid, scene, context, rays);
}
void occluded(const int* valid, RTCScene scene, Context* context, auto* rays) {
    if constexpr (lanes == 16)
        rtcOccluded16(valid, scene, context, rays);
    else if constexpr (lanes == 8)
        rtcOccluded8(valid, scene, context, rays);
    else
        rtcOccluded4(valid, scene, context, rays);
}

constexpr float infinity = std::numeric_limits<float>::infinity();

void flags(int* valid, Mask<S> mask) {
    float lane[lanes];
    store_lanes(lane, select(mask, S(1), S(0)));
    for (int i = 0; i < lanes; ++i) valid[i] = lane[i] != 0 ? -1 : 0;
}

void put(auto& rays, const Vec3<S>& origin, const Vec3<S>& direction, S far) {
    store_lanes(rays.org_x, origin.x), store_lanes(rays.org_y, origin.y), store_lanes(rays.org_z, origin.z);
    store_lanes(rays.dir_x, direction.x), store_lanes(rays.dir_y, direction.y), store_lanes(rays.dir_z, direction.z);
    store_lanes(rays.tnear, S(0)), store_lanes(rays.time, S(0)), store_lanes(rays.tfar, far);
    for (int i = 0; i < lanes; ++i) rays.mask[i] = ~0u, rays.id[i] = i, rays.flags[i] = 0;
}

/// x^p; whole exponents by squaring.
S power(S x, S p) {
    S result(1), base = x, left = p;
    if (any(!(floor(p) == p))) {
        float a[lanes], b[lanes];
        store_lanes(a, x), store_lanes(b, p);
        for (int i = 0; i < lanes; ++i) a[i] = std::pow(a[i], b[i]);
        return load_lanes<S>(a);
    }
    while (any(left > S(0))) {
        const S half = floor(left * S(.5f));
        result = select(half + half < left, result * base, result);
        base *= base, left = half;
    }
    return result;
}

S largest(const Vec3<S>& v) { return max(v.x, max(v.y, v.z)); }

}  // namespace

/// The hits of a packet of rays.
struct Whitted::Packet {
    Mask<S> active, outside;
    Vec3<S> direction, position, start, normal;  // `start` lies off the surface, on the side the ray came from
    S step;                                      // how far off
    Surface<S> surface;
};

Whitted::Whitted(const World& w, const Camera& camera, int columns, int rows, int generations)
    : world(w),
      eye(camera.position),
      frame(frame_of(camera, static_cast<double>(columns) / rows)),
      width(columns),
      height(rows),
      depth(generations) {
    for (int i = 0; i <= depth; ++i) queues.push_back(std::make_unique<Queue>());
    for (auto& sum : sums) sum.resize(most + lanes);
}

void Whitted::trace_tile(int x0, int y0, std::vector<float>& rgb) {
    const int columns = std::min(tile, width - x0), rows = std::min(tile, height - y0);
    Queue& rays = *queues[0];
    rays.count = 0;
    // Blocks of 4x4 pixels, so that a packet's rays stay close together.
    for (int block_y = 0; block_y < rows; block_y += 4)
        for (int block_x = 0; block_x < columns; block_x += 4)
            for (int y = block_y; y < std::min(block_y + 4, rows); ++y)
                for (int x = block_x; x < std::min(block_x + 4, columns); ++x)
                    rays.pixel[rays.count++] = static_cast<float>(y * tile + x);
    for (int i = 0; i < rays.count; i += lanes) {
        const S pixel = load_lanes<S>(rays.pixel + i), row = floor(pixel * S(1.f / tile));
        const S px = S(static_cast<float>(x0) + .5f) + (pixel - row * S(tile));
        const S py = S(static_cast<float>(y0) + .5f) + row;
        const S u = (px * S(2.f / static_cast<float>(width)) - S(1)) * S(static_cast<float>(frame.tan_x));
        const S v = (py * S(2.f / static_cast<float>(height)) - S(1)) * S(static_cast<float>(frame.tan_y));
        const auto axis = [](const DVec3& a) { return splat<S>(Vec3<float>(a)); };
        const Vec3<S> d = fma(u, axis(frame.right), fma(v, axis(frame.down), axis(frame.forward)));
        const Vec3<S> direction = scale(S(1) / sqrt(dot(d, d)), d);
        for (int c = 0; c < 3; ++c) {
            store_lanes(rays.origin[c] + i, S(eye[c]));
            store_lanes(rays.direction[c] + i, direction[c]);
        }
        store_lanes(rays.weight + i, S(1));
    }
    counts.camera += rays.count;
    for (auto& sum : sums) std::fill(sum.begin(), sum.end(), 0.f);
    trace(0);
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            for (int c = 0; c < 3; ++c)
                rgb[3 * (static_cast<std::size_t>(y0 + y) * width + x0 + x) + c] = sums[c][y * tile + x];
}

/// A generation is at most twice as large as the one before; it is traced in parts, each with all that follows from it.
void Whitted::trace(int generation) {
    const Queue& rays = *queues[generation];
    Queue& next = *queues[generation + 1];
    for (int begin = 0; begin < rays.count; begin += most) {
        next.count = 0;
        for (int i = begin; i < std::min(rays.count, begin + most); i += lanes) shade(rays, i, next, generation);
        if (next.count) trace(generation + 1);
    }
}

void Whitted::shade(const Queue& rays, int begin, Queue& next, int generation) {
    const Mask<S> live = first_lanes<S>(rays.count - begin);
    const auto fetch = [&](const float(&values)[3][2 * most + lanes]) {
        return Vec3<S>{load_lanes<S>(values[0] + begin), load_lanes<S>(values[1] + begin),
                       load_lanes<S>(values[2] + begin)};
    };
    const Ray<S> ray{fetch(rays.origin), fetch(rays.direction), S(-1)};
    const S weight = load_lanes<S>(rays.weight + begin);

    // Planes first: what lies behind one need not be looked for.
    alignas(64) RayHit packet;
    S far(infinity), plane(-1);
    for (std::size_t i = 0; i < world.planes.size(); ++i) {
        const Span<S> span = world.planes[i].span(ray, S(-1));
        const Mask<S> nearer = span.hit & (span.near > S(0)) & (span.near < far);
        far = select(nearer, span.near, far);
        plane = select(nearer, S(static_cast<float>(i)), plane);
    }
    put(packet.ray, ray.origin, ray.direction, far);
    for (int i = 0; i < lanes; ++i) packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    alignas(64) int valid[lanes];
    flags(valid, live);
    if (!world.empty) {
        Context context;
        rtcInitIntersectContext(&context);
        if (generation == 0) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        intersect(valid, world.scene, &context, &packet);
    }

    float on_plane[lanes], pixel[lanes], lane_weight[lanes], hit[lanes];
    store_lanes(on_plane, plane), store_lanes(pixel, load_lanes<S>(rays.pixel + begin)),
        store_lanes(lane_weight, weight);
    int material[lanes];
    for (int i = 0; i < lanes; ++i) {
        const unsigned geometry = packet.hit.geomID[i];
        hit[i] = valid[i] && (geometry != RTC_INVALID_GEOMETRY_ID || on_plane[i] >= 0);
        material[i] = 0;
        if (hit[i] == 0) {
            if (valid[i])
                for (int c = 0; c < 3; ++c) sums[c][static_cast<int>(pixel[i])] += lane_weight[i] * world.background[c];
            packet.hit.Ng_x[i] = packet.hit.Ng_y[i] = 0, packet.hit.Ng_z[i] = 1;
        } else if (geometry == RTC_INVALID_GEOMETRY_ID) {
            const auto& n = world.planes[static_cast<int>(on_plane[i])].normal;
            material[i] = world.plane_material[static_cast<int>(on_plane[i])];
            packet.hit.Ng_x[i] = n.x, packet.hit.Ng_y[i] = n.y, packet.hit.Ng_z[i] = n.z;
        } else
            material[i] = world.groups[geometry].material[packet.hit.primID[i]];
    }

    Packet p;
    p.active = load_lanes<S>(hit) > S(0);
    if (none(p.active)) return;
    const S t = load_lanes<S>(packet.ray.tfar);
    const Vec3<S> ng{load_lanes<S>(packet.hit.Ng_x), load_lanes<S>(packet.hit.Ng_y), load_lanes<S>(packet.hit.Ng_z)};
    const Vec3<S> outwards = scale(S(1) / sqrt(dot(ng, ng)), ng);
    p.direction = ray.direction;
    p.outside = dot(ray.direction, outwards) < S(0);
    p.normal = select(p.outside, outwards, -outwards);
    p.position = fma(t, ray.direction, ray.origin);
    const Vec3<S> reach{abs(p.position.x), abs(p.position.y), abs(p.position.z)};
    p.step = S(1e-5f) * max(largest(reach), t);
    p.start = fma(p.step, p.normal, p.position);
    p.surface = gather_items<Surface<S>, S>(world.materials.data(), material);

    const Vec3<S> light = illumination(p, generation);
    float sum[3][lanes];
    for (int c = 0; c < 3; ++c) store_lanes(sum[c], weight * light[c]);
    for (int i = 0; i < lanes; ++i)
        if (hit[i] != 0)
            for (int c = 0; c < 3; ++c) sums[c][static_cast<int>(pixel[i])] += sum[c][i];
    if (generation + 1 >= depth) return;

    const auto push = [&](Mask<S> mask, const Vec3<S>& origin, const Vec3<S>& d, S share) {
        mask = mask & (weight * share > S(0));
        if (none(mask)) return;
        for (int c = 0; c < 3; ++c) {
            compress(next.origin[c] + next.count, origin[c], mask);
            compress(next.direction[c] + next.count, d[c], mask);
        }
        compress(next.weight + next.count, weight * share, mask);
        compress(next.pixel + next.count, load_lanes<S>(rays.pixel + begin), mask);
        next.count += count(mask);
        counts.secondary += count(mask);
    };
    S reflection = p.surface.reflection;
    const S s = -dot(p.direction, p.normal);
    const Mask<S> glass = p.active & (p.surface.refraction > S(0));
    if (any(glass)) {
        const S b = select(p.outside, S(1) / p.surface.ior, p.surface.ior);
        const S k = fma(b * b, fma(s, s, S(-1)), S(1));
        const Mask<S> total = glass & (k < S(0));
        reflection = select(total, reflection + p.surface.refraction, reflection);
        const Vec3<S> g = fma(fma(b, s, -sqrt(max(k, S(0)))), p.normal, scale(b, p.direction));
        push(glass & !total, fma(-p.step, p.normal, p.position), scale(S(1) / sqrt(dot(g, g)), g),
             p.surface.refraction);
    }
    push(p.active, p.start, fma(s + s, p.normal, p.direction), reflection);
}

Vec3<S> Whitted::illumination(const Packet& p, int generation) {
    Vec3<S> light = p.surface.ambient;
    const Vec3<S> mirrored = fma(S(-2) * dot(p.direction, p.normal), p.normal, p.direction);
    const Mask<S> bright = p.active & ((largest(p.surface.diffuse) > S(0)) | (p.surface.specular > S(0)));
    if (none(bright)) return light;
    for (const auto& light_source : world.lights) {
        const Vec3<S> to_light = splat<S>(light_source.position) - p.start;
        const S distance = sqrt(dot(to_light, to_light));
        const Vec3<S> l = scale(S(1) / distance, to_light);
        const S cosine = dot(p.normal, l);
        const Mask<S> faces = bright & (cosine > S(0));
        if (none(faces)) continue;
        counts.shadow += count(faces);
        const Vec3<S> share = light_left(p.start, l, distance, faces, generation == 0);
        const S shine = min(max(dot(mirrored, l), S(0)), S(1));
        const Mask<S> glossy = faces & (shine > S(0)) & (p.surface.specular > S(0));
        const S highlight = any(glossy) ? select(glossy, p.surface.specular * power(shine, p.surface.pow), S(0)) : S(0);
        for (int c = 0; c < 3; ++c)
            light[c] +=
                select(faces, share[c] * S(light_source.color[c]) * fma(p.surface.diffuse[c], cosine, highlight), S(0));
    }
    return light;
}

Vec3<S> Whitted::light_left(const Vec3<S>& from, const Vec3<S>& direction, S distance, Mask<S> wanted, bool coherent) {
    const Ray<S> ray{from, direction, S(-1)};
    ShadowContext context;
    for (auto& share : context.share) store_lanes(share, S(1));
    for (std::size_t i = 0; i < world.planes.size(); ++i) {
        const Span<S> span = world.planes[i].span(ray, S(-1));
        const Mask<S> between = span.hit & (span.near > S(0)) & (span.near < distance);
        if (none(between)) continue;
        const auto& filter = world.materials[world.plane_material[i]].filter;
        for (int c = 0; c < 3; ++c) {
            const S before = load_lanes<S>(context.share[c]);
            store_lanes(context.share[c], select(between, before * S(filter[c]), before));
        }
    }
    const auto share = [&] {
        return Vec3<S>{load_lanes<S>(context.share[0]), load_lanes<S>(context.share[1]),
                       load_lanes<S>(context.share[2])};
    };
    const Mask<S> open = wanted & (largest(share()) > S(0));
    if (world.empty || none(open)) return share();

    alignas(64) ShadowRay packet;
    put(packet, from, direction, distance);
    alignas(64) int valid[lanes];
    flags(valid, open);
    rtcInitIntersectContext(&context.embree);
    if (coherent) context.embree.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    occluded(valid, world.scene, &context.embree, &packet);
    return select(open & (load_lanes<S>(packet.tfar) < S(0)), Vec3<S>(S(0)), share());
}

}  // namespace strahl::bench
