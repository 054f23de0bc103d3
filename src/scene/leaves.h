// The simple bodies that a primitive consists of: itself, or in a composite its parts, theirs, and so on.
#pragma once
#include <glm/mat4x4.hpp>

#include "scene/scene.h"

namespace strahl {

/// A leaf's own matrix takes its shape into the world, through the transformations of all levels. That of its material
/// takes the material's patterns there: from the space of the outermost composite around it with the same material all
/// the way in, so that the pattern of a whole goes on through its parts, or from its own.
struct LeafMatrices {
    glm::dmat4 shape{1}, material{1};
};

/// Calls visit(leaf, matrices) for each in the order declared. `outer` are those of the composite around the primitive,
/// which has the material `outer_material`; of a primitive by itself that is none.
template <class Visit>
void for_each_leaf_placed(const Primitive& primitive, const Visit& visit, const LeafMatrices& outer = {},
                          int outer_material = -1) {
    const glm::dmat4 whole = outer.shape * matrix(primitive.transformations);
    const LeafMatrices own{whole, primitive.material == outer_material ? outer.material : whole};
    const auto look = [&]<class Kind>(const Kind& kind) {
        if constexpr (is_composite<Kind>)
            for (const Primitive& part : *kind.parts) for_each_leaf_placed(part, visit, own, primitive.material);
        else
            visit(primitive, own);
    };
    std::visit(look, primitive.shape);
}

/// The way of a composite's leaf into the composite's own space, and its transformations all the way into the world.
struct LeafWay {
    glm::dmat4 inner{1};
    double similarity = 0;                        // of the way into the world
    std::vector<Transformation> steps, material;  // the latter of its material's patterns
};
/// Calls visit(leaf, way) for the leaves of a composite in the order declared, and combine(operation) where the last
/// two results become one.
template <class Visit, class Combine>
void for_each_leaf_within(const Primitive& composite, const Visit& visit, const Combine& combine) {
    const auto look = [&](const auto& self, const Primitive& part, const LeafWay& way) -> void {
        std::visit(
            [&]<class Kind>(const Kind& kind) {
                if constexpr (is_composite<Kind>) {
                    for (std::size_t i = 0; i < kind.parts->size(); ++i) {
                        const Primitive& next = (*kind.parts)[i];
                        LeafWay own{way.inner * matrix(next.transformations),
                                    way.similarity * similarity(next.transformations),
                                    next.transformations,
                                    {}};
                        own.steps.insert(own.steps.end(), way.steps.begin(), way.steps.end());
                        own.material = next.material == part.material ? way.material : own.steps;
                        self(self, next, own);
                        if (i > 0) combine(Kind::operation);
                    }
                } else {
                    visit(part, way);
                }
            },
            part.shape);
    };
    look(look, composite,
         {glm::dmat4(1), similarity(composite.transformations), composite.transformations, composite.transformations});
}

/// Those of all leaves.
inline std::vector<LeafWay> ways_of(const Primitive& composite) {
    std::vector<LeafWay> ways;
    for_each_leaf_within(
        composite, [&](const Primitive&, const LeafWay& way) { ways.push_back(way); }, [](Operation) {});
    return ways;
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

/// Calls visit(leaf, matrix), where no patterns matter.
template <class Visit>
void for_each_leaf(const Primitive& primitive, const Visit& visit) {
    for_each_leaf_placed(primitive,
                         [&](const Primitive& leaf, const LeafMatrices& matrices) { visit(leaf, matrices.shape); });
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
