// The forms whose errors proofs can bound.
#pragma once
#include "trace/proof/affine_bounds.h"
#include "trace/proof/cone_bounds.h"
#include "trace/proof/flat_bounds.h"
#include "trace/proof/point_bounds.h"
#include "trace/proof/smooth_bounds.h"
#include "trace/proof/torus_bounds.h"
#include "trace/proof/triangle_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// True if there is a span_bounds() for the form's kernel.
template <class Form>
inline constexpr bool is_known = requires(const typename Form::template Kernel<double>& kernel, const Ray<double>& ray,
                                          const Doubt<double>& doubt, const Slack<double>& slack) {
    span_bounds(kernel, ray, doubt, 0., slack);
};
/// Calls visit(group) if the form is known. Returns true if it is.
template <class T, class Visit>
STRAHL_INLINE bool if_known(const World<T>& world, int form, const Visit& visit) {
    int number = 0;
    bool found = false;
    world.groups.each([&](const auto& group) __attribute__((always_inline)) {
        if constexpr (is_known<typename std::remove_cvref_t<decltype(group)>::Form>)
            if (number == form) visit(group), found = true;
        ++number;
    });
    return found;
}

}  // namespace strahl::inline STRAHL_LEVEL
