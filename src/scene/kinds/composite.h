// Bodies made of bodies: constructive solid geometry.
#pragma once
#include <memory>
#include <tuple>
#include <vector>

#include "num/bounding_box.h"
#include "num/vec_math.h"
#include "scene/kinds/world_transform.h"

namespace strahl {

struct Primitive;

/// The points that belong to a composite: those in any of its parts, in all, or in the first and in none of the others.
enum class Operation { unite, intersect, subtract };

/// The number of a composite in its world. Where rays cross it is computed from its parts.
template <class T>
struct CompositeKernel {
    T number;
};

/// A body made of closed bodies or of composites, each with its own material and transformations.
template <Operation own_operation>
struct Composite {
    std::shared_ptr<const std::vector<Primitive>> parts = usual_parts();
    bool keeps = false;  // said of a union: surfaces of its parts are there inside others too. Scene text has no word

    bool operator==(const Composite& other) const;

    static constexpr Operation operation = own_operation;
    static constexpr const char* name = operation == Operation::unite       ? "union"
                                        : operation == Operation::intersect ? "intersection"
                                                                            : "difference";
    static constexpr int faces = 0, max_crossings = 2;
    /// Its box may be infinite nevertheless. It is not `closed` although it has an inside: rays count the composites
    /// that they are in, where for closed bodies the normal decides.
    static constexpr bool bounded = true, convex = true, closed = false, hot = false;
    static constexpr auto fields = std::make_tuple();

    const char* fault() const;
    Box bounds() const { return bounds(glm::dmat4(1)); }
    Box bounds(const glm::dmat4& matrix) const;
    bool contains(const DVec3& p) const;

    /// All three operations use the form of the first.
    template <class T>
    using Kernels = std::conditional_t<operation == Operation::unite, std::tuple<CompositeKernel<T>>, std::tuple<>>;
    template <class T, class Emit>
    void emit(const WorldTransform&, const Emit& emit) const {
        emit(CompositeKernel<T>{});
    }

    /// Two balls that share space.
    static std::shared_ptr<const std::vector<Primitive>> usual_parts();
};

using Union = Composite<Operation::unite>;
using Intersection = Composite<Operation::intersect>;
using Difference = Composite<Operation::subtract>;

template <class Kind>
inline constexpr bool is_composite = requires {
    Kind::operation;
};

/// Can bodies of this kind be parts of a composite? See fits_composite().
template <class Kind>
inline constexpr bool can_be_part = is_composite<Kind> || Kind::closed || requires(const Kind kind) {
    kind.open();
};

/// Most simple bodies in one composite, and most that are connected: see union_groups.h.
inline constexpr int most_parts = 100'000, most_leaves = 1024;

}  // namespace strahl
