#include "scene/kinds/composite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/leaves.h"
#include "scene/overlap.h"
#include "scene/scene.h"

namespace strahl {
namespace {

/// The box around a part. That of a plane at right angles to an axis ends there, up to rounding errors of its normal.
Box box_of(const Primitive& part, const glm::dmat4& to_world) {
    Box box = transformed_bounds(part, to_world);
    const Plane* const plane = std::get_if<Plane>(&part.shape);
    if (!plane) return box;
    const HalfSpace space = plane->half_space(to_world * matrix(part.transformations));
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    for (int c = 0; c < 3; ++c) {
        const bool leans =
            std::abs(space.normal[(c + 1) % 3]) > rounding || std::abs(space.normal[(c + 2) % 3]) > rounding;
        if (!leans) (space.normal[c] > 0 ? box.high : box.low)[c] = space.point[c];
    }
    return box;
}

}  // namespace

bool fits_composite(const Shape& shape) {
    const auto fits = []<class Kind>(const Kind& kind) {
        if constexpr (requires { kind.open(); }) return !kind.open();
        return can_be_part<Kind>;
    };
    return std::visit(fits, shape);
}

const ContourData* contours_of(const Shape& shape) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> const ContourData* {
            if constexpr (has_contours<Kind>) return kind.data.get();
            return nullptr;
        },
        shape);
}

int leaves_of(const Shape& shape) {
    return sum_of_leaves(shape, [](const auto&) { return 1; });
}

template <Operation operation>
bool Composite<operation>::operator==(const Composite& other) const {
    return keeps == other.keeps && (parts == other.parts || *parts == *other.parts);
}

template <Operation operation>
const char* Composite<operation>::fault() const {
    if (parts->empty()) return "it has no parts";
    int leaves = 0;
    for (const Primitive& part : *parts) {
        if (!std::visit([]<class Kind>(const Kind&) { return can_be_part<Kind>; }, part.shape))
            return "a part is not a closed body; discs and triangles cannot be parts";
        if (!fits_composite(part.shape)) return "a mesh or a lathe among its parts is open and has no inside";
        leaves += leaves_of(part.shape);
    }
    return leaves > most_parts ? "it consists of more than 100000 bodies" : nullptr;
}

template <Operation operation>
Box Composite<operation>::bounds(const glm::dmat4& to_world) const {
    Box box = box_of(parts->front(), to_world);
    if (operation == Operation::subtract) return box;
    for (std::size_t i = 1; i < parts->size(); ++i) {
        const Box own = box_of((*parts)[i], to_world);
        if (operation == Operation::unite) {
            box.add(own);
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            box.low[c] = std::max(box.low[c], own.low[c]);
            box.high[c] = std::max(box.low[c], std::min(box.high[c], own.high[c]));
        }
    }
    return box;
}

template <Operation operation>
bool Composite<operation>::contains(const DVec3& p) const {
    const auto in = [&](const Primitive& part) { return strahl::contains(part, p); };
    if (operation == Operation::unite) return std::ranges::any_of(*parts, in);
    if (operation == Operation::intersect) return std::ranges::all_of(*parts, in);
    return in(parts->front()) && std::none_of(parts->begin() + 1, parts->end(), in);
}

template <Operation operation>
std::shared_ptr<const std::vector<Primitive>> Composite<operation>::usual_parts() {
    static const auto shared = std::make_shared<const std::vector<Primitive>>(
        std::vector<Primitive>{{Sphere{{0, 0, 0}, 1}, 0, {}}, {Sphere{{.7, 0, 0}, .8}, 0, {}}});
    return shared;
}

template struct Composite<Operation::unite>;
template struct Composite<Operation::intersect>;
template struct Composite<Operation::subtract>;

}  // namespace strahl
