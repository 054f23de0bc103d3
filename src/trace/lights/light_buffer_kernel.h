// Shadow rays by light buffers: tests one candidate of each lane side by side.
#pragma once
#include <algorithm>

#include "trace/forms/form_kernel.h"
#include "trace/lights/light_buffer.h"
#include "trace/lights/light_buffer_calls.h"
#include "trace/lights/light_buffer_cells_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// Finds the shadow rays that opaque bodies are in the way of.
template <class S>
struct Darkening {
    using T = Element<S>;
    const World<T>& world;
    const Ray<S>& ray;
    const S& distance;

    /// Returns the lanes in which an opaque item, one in each lane, is in the way; tests them one after the other.
    [[gnu::noinline]] Mask<S> darkened_one_by_one(Mask<S> lanes, int form, const int* items) const {
        const S one(1);
        T dark[width<S>] = {};
        for (unsigned left = bits(lanes); left; left &= left - 1) {
            const int k = std::countr_zero(left);
            const Mask<S> own = first_lanes<S>(k + 1) & !first_lanes<S>(k);
            Transmission<S> light{{one, one, one}, select(own, one, S(-1))};
            dark[k] = calls<S>(form).occlude(world, items[k], 1, ray, distance, own, light);
        }
        return load_lanes<S>(dark) > S(0);
    }
    /// Returns the lanes that items darken, tested side by side; closely where rays seem to start in a body.
    STRAHL_INLINE Mask<S> darkened(Mask<S> lanes, int form, const int* items) const {
        Mask<S> dark = first_lanes<S>(0);
        const auto side_by_side = [&](const auto& group) __attribute__((always_inline)) {
            using Group = std::remove_cvref_t<decltype(group)>;
            using Item = typename Group::template ItemOf<S>;
            if constexpr (Group::Form::Kind::bounded) {
                const auto span = crossings_of(gather_items<Item, S>(group.items, items), ray, lanes);
                const auto crossed_by = crossed(span, span.hit & lanes, distance);
                dark = crossed_by[0];
                const Mask<S> exits = crossed_by[1] & !dark;
                if (any(exits)) [[unlikely]]
                    dark = dark | darkened_one_by_one(exits, form, items);
            }
        };
        if (!if_hot(world, form, side_by_side)) dark = darkened_one_by_one(lanes, form, items);
        return dark;
    }
};

template <class S>
Mask<S> LightBufferCalls<S>::occlude(const World<T>& world, int number, const Ray<S>& ray, const S& distance,
                                     Transmission<S>& light) {
    const T furthest = world.light_buffers[number].furthest;
    const Mask<S> active = light.limit > S(0), near = active & (dot(ray.origin, ray.origin) < S(furthest * furthest));
    const Darkening<S> bodies{world, ray, distance};
    Mask<S> dark = first_lanes<S>(0);
    walk_candidates(world, number, ray.origin, distance, near, [&](int form, Mask<S> lanes, const int* items) {
        const Mask<S> found = bodies.darkened(lanes, form, items);
        dark = dark | found;
        return found;
    });
    light.limit = select(dark, S(-1), light.limit);
    return active & !near;
}

}  // namespace strahl::inline STRAHL_LEVEL
