// Visits the leaves of a primitive: the simple bodies that it consists of, itself or the parts of a composite at any
// depth.
#pragma once
#include <glm/mat4x4.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// Calls visit(part) for the parts of a composite; of other primitives there are none.
template <class Visit>
void each_part(const Primitive& primitive, const Visit& visit) {
    const auto look = [&]<class Kind>(const Kind& kind) {
        if constexpr (is_composite<Kind>)
            for (const Primitive& part : *kind.parts) visit(part);
    };
    std::visit(look, primitive.shape);
}
/// Replaces the parts of a composite by copies that change(part) has changed.
template <class Change>
void change_parts(Primitive& primitive, const Change& change) {
    const auto look = [&]<class Kind>(Kind& kind) {
        if constexpr (is_composite<Kind>) {
            std::vector<Primitive> parts = *kind.parts;
            for (Primitive& part : parts) change(part);
            kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
        }
    };
    std::visit(look, primitive.shape);
}

/// Matrices from a leaf into the world. `shape` is that of the leaf. `material` is that of its material's patterns: if
/// the composites around the leaf have the same material, it begins in the space of the outermost of these, so that the
/// pattern continues through all parts.
struct LeafMatrices {
    glm::dmat4 shape{1}, material{1};
};

/// Calls visit(leaf, matrices) for each leaf in the order declared. `outer` are the matrices of the composite around
/// the primitive, and `outer_material` its material; -1 if there is none.
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

/// How a leaf of a composite gets into the composite's own space, and from there into the world.
struct LeafWay {
    glm::dmat4 inner{1};
    double similarity = 0;                        // of the transformations into the world
    std::vector<Transformation> steps, material;  // into the world: of the leaf, and of its material's patterns
};
/// Calls combine(operation), or combine(operation, keeps) if it takes that.
template <class Combine, class Kind>
void combine_with(const Combine& combine, const Kind& kind) {
    if constexpr (requires { combine(Kind::operation, kind.keeps); })
        combine(Kind::operation, kind.keeps);
    else
        combine(Kind::operation);
}
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
                        if (i > 0) combine_with(combine, kind);
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

/// Returns the ways of a composite's leaves, in the order declared.
inline std::vector<LeafWay> ways_of(const Primitive& composite) {
    std::vector<LeafWay> ways;
    for_each_leaf_within(
        composite, [&](const Primitive&, const LeafWay& way) { ways.push_back(way); }, [](Operation) {});
    return ways;
}

/// The sum of count(kind) over all leaves.
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

/// Calls visit(leaf, matrix) with the matrix of the shape alone.
template <class Visit>
void for_each_leaf(const Primitive& primitive, const Visit& visit) {
    for_each_leaf_placed(primitive,
                         [&](const Primitive& leaf, const LeafMatrices& matrices) { visit(leaf, matrices.shape); });
}

/// Does any surface of the primitive transmit light?
inline bool transparent(const Scene& scene, const Primitive& primitive) {
    bool any = false, composite = false;
    each_part(primitive, [&](const Primitive& part) { composite = true, any = any || transparent(scene, part); });
    return composite ? any : scene.materials[static_cast<std::size_t>(primitive.material)].transmits();
}

}  // namespace strahl
