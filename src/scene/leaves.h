// The simple bodies that a primitive consists of: itself, or in a composite its parts, theirs, and so on.
#pragma once
#include <glm/mat4x4.hpp>

#include "scene/scene.h"

namespace strahl {

/// Calls visit(leaf, matrix) for each in the order declared. `matrix` takes its shape into the world, through the
/// transformations of all levels.
template <class Visit>
void for_each_leaf(const Primitive& primitive, const Visit& visit, const glm::dmat4& outer = glm::dmat4(1)) {
    const glm::dmat4 whole = outer * matrix(primitive.transformations);
    const auto look = [&]<class Kind>(const Kind& kind) {
        if constexpr (is_composite<Kind>)
            for (const Primitive& part : *kind.parts) for_each_leaf(part, visit, whole);
        else
            visit(primitive, whole);
    };
    std::visit(look, primitive.shape);
}

/// The sum of count(kind) for each of them.
template <class Count>
int sum_of_leaves(const Shape& shape, const Count& count) {
    const auto look = [&]<class Kind>(const Kind& kind) {
        int sum = 0;
        if constexpr (is_composite<Kind>)
            for (const Primitive& part : *kind.parts) sum += sum_of_leaves(part.shape, count);
        else
            sum = count(kind);
        return sum;
    };
    return std::visit(look, shape);
}

/// Does light pass any of its surfaces?
inline bool transparent(const Scene& scene, const Primitive& primitive) {
    bool any = false;
    for_each_leaf(primitive, [&](const Primitive& leaf, const glm::dmat4&) {
        any |= scene.materials[static_cast<std::size_t>(leaf.material)].refraction > 0;
    });
    return any;
}

}  // namespace strahl
