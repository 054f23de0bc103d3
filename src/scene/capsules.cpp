#include "scene/capsules.h"

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

namespace strahl {
namespace {

/// An upper bound on how much a matrix lengthens vectors: the root of the product of the largest sums of rows and
/// columns.
double stretch(const glm::dmat4& m) {
    double rows = 0, columns = 0;
    for (int i = 0; i < 3; ++i) {
        rows = std::max(rows, std::abs(m[0][i]) + std::abs(m[1][i]) + std::abs(m[2][i]));
        columns = std::max(columns, std::abs(m[i][0]) + std::abs(m[i][1]) + std::abs(m[i][2]));
    }
    return std::sqrt(rows * columns);
}

template <class Kind>
std::vector<Capsule> own_capsules(const Kind& kind) {
    if constexpr (!Kind::bounded || std::is_same_v<Kind, Mesh>)
        return {};
    else if constexpr (requires { kind.capsules(); })
        return kind.capsules();
    else
        return {capsule_around(kind.bounds())};
}

}  // namespace

std::vector<Capsule> capsules_of(const Primitive& primitive, const glm::dmat4& outer) {
    const glm::dmat4 to_world = outer * matrix(primitive.transformations);
    const auto visit = [&]<class Kind>(const Kind& kind) {
        std::vector<Capsule> found;
        if constexpr (is_composite<Kind>) {
            // An intersection lies inside any of its bounded parts, a difference inside its first.
            for (const Primitive& part : *kind.parts) {
                const std::vector<Capsule> own = capsules_of(part, to_world);
                if (Kind::operation == Operation::unite && own.empty()) return own;
                found.insert(found.end(), own.begin(), own.end());
                if (Kind::operation == Operation::subtract) break;
                if (Kind::operation == Operation::intersect && !own.empty()) break;
            }
        } else {
            found = own_capsules(kind);
            const double factor = similarity(primitive.transformations) > 0 && outer == glm::dmat4(1)
                                      ? similarity(primitive.transformations)
                                      : stretch(to_world);
            for (Capsule& capsule : found)
                capsule = {transform_point(to_world, capsule.from), transform_point(to_world, capsule.to),
                           capsule.radius * factor};
        }
        return found;
    };
    return std::visit(visit, primitive.shape);
}

}  // namespace strahl
