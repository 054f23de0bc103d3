// Camera rays of a view, in the world of a placement.
#pragma once
#include "trace/world/extended_numbers.h"

namespace strahl {

template <class T>
Eye<T> eye_of(const View& view, const Placement& placement) {
    if constexpr (std::is_same_v<T, Extended>)
        if (view.prove) return extended_eye(view, placement);
    const CameraFrame frame = frame_of(view.camera, static_cast<double>(view.width) / view.height);
    return {.position = cast<T>((view.camera.position - placement.origin) * placement.scale),
            .forward = cast<T>(frame.forward),
            .right = cast<T>(frame.right * frame.tan_x),
            .down = cast<T>(frame.down * frame.tan_y),
            .scale_x = static_cast<T>(2. / view.width),
            .scale_y = static_cast<T>(2. / view.height),
            .bias_x = static_cast<T>((1 + 2 * view.shift_x) / view.width - 1),
            .bias_y = static_cast<T>((1 + 2 * view.shift_y) / view.height - 1)};
}

}  // namespace strahl
