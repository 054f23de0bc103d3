#include "trace/kernel/camera_rays.h"

#include <algorithm>
#include <array>

#include "num/vec_math.h"
#include "scene/leaves.h"
#include "scene/overlap.h"
#include "trace/kernel/workspace.h"

namespace strahl {

template <class T>
CameraRays<T>::CameraRays(const Scene& scene, const View& view, const BuiltWorld<T>& built, const Placement& placement)
    : view(view),
      built(built),
      placement(placement),
      frame(frame_of(view.camera, static_cast<double>(view.width) / view.height)),
      sharp(focal_distance(view.camera)) {
    const double radius = view.camera.aperture;
    const double eyes = view.camera.stereo == Stereo::none ? 0 : view.camera.eye_distance / 2;
    if (!starts_apart(view.camera.projection) && radius == 0 && eyes == 0) return;
    const DVec3 middle = view.camera.position;
    const double wide = radius + starts_apart(view.camera.projection) * frame.tan_x;
    const double high = radius + starts_apart(view.camera.projection) * frame.tan_y;
    DVec3 reach;
    for (int i = 0; i < 3; ++i) reach[i] = eyes + std::abs(wide * frame.right[i]) + std::abs(high * frame.down[i]);
    starts_in_bodies = std::ranges::any_of(scene.primitives, [&](const Primitive& body) {
        if (!transparent(scene, body) && !built.world().finishes.enclosed) return false;
        const Box box = world_bounds(body);
        bool apart = false;
        for (int i = 0; i < 3; ++i) apart |= box.low[i] > middle[i] + reach[i] || box.high[i] < middle[i] - reach[i];
        return !box.finite() || !apart;
    });
}

/// Returns the place in the picture, from -1 to 1, of a point in pixels, of which (0, 0) is the middle of the first.
template <class T>
auto CameraRays<T>::place(Real x, Real y) const -> std::array<Real, 2> {
    return {(2 * (x + Real(view.shift_x)) + 1) / view.width - 1, (2 * (y + Real(view.shift_y)) + 1) / view.height - 1};
}

/// Returns the ray of an eye through a point in pixels, and a place on the lens.
template <class T>
auto CameraRays<T>::ray(Real x, Real y, Real across, Real below, int eye) const -> CameraRay<Real> {
    const auto [u, v] = place(x, y);
    CameraRay<Real> own = camera_ray(view.camera, frame, u, v, eye);
    if (across != 0 || below != 0) {  // aims at the point in focus that all of the lens sees there
        const Vec3<Real> off =
            Real(view.camera.aperture) * (across * Vec3<Real>(frame.right) + below * Vec3<Real>(frame.down));
        own.way = Real(sharp) * own.way - off, own.start = own.start + off;
    }
    own.start = Real(placement.scale) * (Vec3<Real>(view.camera.position - placement.origin) + own.start);
    own.way = Real(1) / std::sqrt(dot(own.way, own.way)) * own.way;
    return own;
}

template <class T>
void CameraRays<T>::make(const PixelBatch<T>& batch, Workspace<T>& workspace, RayQueue<T>& rays) const {
    for (int i = 0; i < batch.count; ++i) {
        const Real x = batch.x[i], y = batch.y[i];
        const Real across = batch.lens_x ? Real(batch.lens_x[i]) : 0, below = batch.lens_y ? Real(batch.lens_y[i]) : 0;
        const auto [u, v] = place(x, y);
        const int eye = eye_at(view.camera, u, v);
        const CameraRay<Real> own = ray(x, y, across, below, eye);
        for (int c = 0; c < 3; ++c) {
            rays.origin[c][i] = static_cast<T>(own.start[c]);
            rays.direction[c][i] = static_cast<T>(own.way[c]);
        }
        if (!own.seen) {
            rays.weight[i] = 0;
            if (rays.level)
                for (int c = 0; c < 3; ++c) rays.tint[c][i] = 0;
        }
        if (starts_in_bodies) {
            const DVec3 start = DVec3(own.start) / placement.scale + placement.origin;
            int list = 0;
            for (const int body : built.bodies_around(start)) list = push(workspace.mediums, list, body);
            rays.medium[i] = static_cast<T>(list);
        }
        if (!batch.footprints) continue;
        const Real side = batch.footprints->sides[i];
        // How rays change along an axis of the picture, by a side, and not beyond the picture, where rays may turn
        // round.
        const auto along = [&](int axis) {
            const Real at = axis ? y : x, last = (axis ? view.height : view.width) - Real(.5);
            const Real low = std::max(at - side / 2, Real(-.5)), high = std::min(at + side / 2, last);
            const auto own_ray = [&](Real to) {
                return axis ? ray(x, to, across, below, eye) : ray(to, y, across, below, eye);
            };
            const CameraRay<Real> first = own_ray(low), second = own_ray(high);
            const Real per = side / (high - low);
            return std::array{per * (second.start - first.start), per * (second.way - first.way)};
        };
        if (rays.cone.width) {
            const auto [down, turned] = along(1);
            rays.cone.width[i] = static_cast<T>(length(DVec3(down)));
            rays.cone.spread[i] = static_cast<T>(length(DVec3(turned)));
        }
        if (!rays.differentials.loose) continue;
        for (int k = 0; k < 2; ++k) {
            const auto [start, way] = along(k);
            for (int c = 0; c < 3; ++c) {
                rays.differentials.place[k][c][i] = static_cast<T>(start[c]);
                rays.differentials.direction[k][c][i] = static_cast<T>(way[c]);
            }
        }
        rays.differentials.loose[i] = 0;
    }
}

template <class T>
void make_camera_rays(const CameraRays<T>& cameras, const PixelBatch<T>& batch, Workspace<T>& workspace,
                      RayQueue<T>& rays) {
    cameras.make(batch, workspace, rays);
}

template class CameraRays<float>;
template class CameraRays<double>;
template class CameraRays<long double>;
template void make_camera_rays(const CameraRays<float>&, const PixelBatch<float>&, Workspace<float>&, RayQueue<float>&);
template void make_camera_rays(const CameraRays<double>&, const PixelBatch<double>&, Workspace<double>&,
                               RayQueue<double>&);
template void make_camera_rays(const CameraRays<long double>&, const PixelBatch<long double>&, Workspace<long double>&,
                               RayQueue<long double>&);

}  // namespace strahl
