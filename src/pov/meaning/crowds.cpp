#include "pov/meaning/crowds.h"

#include <functional>

#include "scene/kinds/kinds.h"
#include "scene/overlap.h"
#include "scene/union_groups.h"

namespace strahl::pov {
namespace {

/// Keeps the parts of a composite for which keep(part, is_first) is true. Returns false if none is left, or nothing of
/// a difference.
bool keep_parts(Primitive& whole, const std::function<bool(Primitive&, bool)>& keep) {
    return std::visit(
        [&]<class Kind>(Kind& kind) {
            if constexpr (is_composite<Kind>) {
                std::vector<Primitive> parts;
                for (std::size_t i = 0; i < kind.parts->size(); ++i) {
                    Primitive part = (*kind.parts)[i];
                    if (keep(part, i == 0))
                        parts.push_back(std::move(part));
                    else if (i == 0 && Kind::operation == Operation::subtract)
                        return false;
                }
                if (parts.empty()) return false;
                if (parts.size() > 1) {
                    kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
                    return true;
                }
                Primitive only = std::move(parts[0]);
                only.transformations.insert(only.transformations.end(), whole.transformations.begin(),
                                            whole.transformations.end());
                whole = std::move(only);
            }
            return true;
        },
        whole.shape);
}

bool meet(const Box& a, const Box& b) {
    for (int i = 0; i < 3; ++i)
        if (!(a.low[i] <= b.high[i] && b.low[i] <= a.high[i])) return false;
    return true;
}

/// Keeps what of a body, or of the parts of a union, is in a box.
bool keep_in(Primitive& body, const Box& box) {
    if (!meet(world_bounds(body), box)) return false;
    if (!std::holds_alternative<Union>(body.shape) || !body.transformations.empty()) return true;
    return keep_parts(body, [&](Primitive& part, bool) { return keep_in(part, box); });
}

/// Keeps the first `left` bodies.
bool keep_first(Primitive& body, int& left) {
    if (leaves_of(body.shape) <= left) return left -= leaves_of(body.shape), true;
    return left > 0 && keep_parts(body, [&](Primitive& part, bool) { return keep_first(part, left); });
}

}  // namespace

bool limit_crowd(Primitive& whole, const std::vector<Material>& materials) {
    const auto too_many = [&] {
        return leaves_of(whole.shape) > most_leaves && most_leaves_together(whole, materials) > most_leaves;
    };
    if (!too_many()) return false;
    if (const auto* const difference = std::get_if<Difference>(&whole.shape)) {
        const Box box = world_bounds((*difference->parts)[0]);
        keep_parts(whole, [&](Primitive& part, bool is_first) { return is_first || keep_in(part, box); });
        if (!too_many()) return false;
    }
    int left = most_leaves;
    keep_first(whole, left);
    return true;
}

}  // namespace strahl::pov
