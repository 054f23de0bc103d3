// The eye of a view: where camera rays start, and their directions.
#pragma once
#include "num/vec.h"

namespace strahl {

template <class T>
class CameraRays;

/// The start and the directions of camera rays: pixel (x, y) looks along forward + u * right + v * down, with u, v in
/// [-1, 1]; or `rays` makes them.
template <class T>
struct Eye {
    Vec3<T> position, forward, right, down;  // right and down scaled by the picture's half sizes at distance 1
    T scale_x, scale_y, bias_x, bias_y;      // u = x * scale_x + bias_x
    T medium = 0;                            // stack of bodies that the eye is in
    const CameraRays<T>* rays = nullptr;     // of lenses and other projections (kernel/camera_rays.h)
};

}  // namespace strahl
