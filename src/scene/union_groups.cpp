#include "scene/union_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "num/box_tree.h"
#include "scene/leaves.h"
#include "scene/moving_scene.h"
#include "scene/overlap.h"

namespace strahl {
namespace {

std::vector<Transformation> joined(std::vector<Transformation> steps, const std::vector<Transformation>& then) {
    steps.insert(steps.end(), then.begin(), then.end());
    return steps;
}

/// Adds the parts of a union. `outer` are the transformations of the unions around it but the outermost one's, and
/// `to_pattern` lead from its space to that of its material's pattern.
void collect(const Primitive& whole, const std::vector<Transformation>& outer,
             const std::vector<Transformation>& to_pattern, std::vector<UnionPart>& parts) {
    for (const Primitive& part : *std::get<Union>(whole.shape).parts) {
        UnionPart own{part, {}};
        own.primitive.transformations = joined(part.transformations, outer);
        if (part.material == whole.material) own.to_pattern = joined(part.transformations, to_pattern);
        if (std::holds_alternative<Union>(part.shape))
            collect(part, own.primitive.transformations, own.to_pattern, parts);
        else
            parts.push_back(std::move(own));
    }
}

/// Puts boxes that meet, or that are linked by boxes that meet, into one group.
class LinkedBoxes {
  public:
    explicit LinkedBoxes(std::vector<Box> boxes)
        : parents(boxes.size()), tree(std::move(boxes)), one_group(tree.size(), true) {
        std::iota(parents.begin(), parents.end(), 0);
        tree.visit_pairs(*this);
    }
    /// The first box of the group.
    std::size_t operator[](std::size_t i) {
        for (; parents[i] != i; i = parents[i]) parents[i] = parents[parents[i]];
        return i;
    }

    bool skips(const BoxTree::Subtree& a, const BoxTree::Subtree& b) {
        return apart(tree.box(a), tree.box(b)) || same(a, b);
    }
    void meet(std::size_t a, std::size_t b) {
        a = (*this)[a], b = (*this)[b];
        parents[std::max(a, b)] = std::min(a, b);
    }
    void leave(const BoxTree::Subtree& some) { one_group[some.index] = same(some.lower(), some.upper()); }

  private:
    static bool apart(const Box& a, const Box& b) {
        for (int c = 0; c < 3; ++c)
            if (a.high[c] < b.low[c] || b.high[c] < a.low[c]) return true;
        return false;
    }
    bool same(const BoxTree::Subtree& a, const BoxTree::Subtree& b) {
        return one_group[a.index] && one_group[b.index] && (*this)[tree.first(a)] == (*this)[tree.first(b)];
    }

    std::vector<std::size_t> parents;
    BoxTree tree;
    std::vector<char> one_group;  // by subtree
};

/// Returns a box a little larger than the part: what only rounding keeps apart is together.
Box box_of(const UnionPart& part) {
    Box box = world_bounds(part.primitive);
    for (int c = 0; c < 3; ++c) {
        const double grow = 1e-6 * std::max(std::fabs(box.low[c]), std::fabs(box.high[c]));
        box.low[c] -= grow, box.high[c] += grow;
    }
    return box;
}

/// Calls visit(material) for a composite and all that it consists of.
template <class Visit>
void each_material(const Primitive& primitive, const Visit& visit) {
    visit(primitive.material);
    each_part(primitive, [&](const Primitive& part) { each_material(part, visit); });
}

/// Returns whether there is more than one index of refraction. A whole has that of its own material, a part that is
/// traced by itself has its own.
bool several_media(const Primitive& whole, const std::vector<Material>& materials) {
    std::optional<double> ior;
    bool several = false;
    each_material(whole, [&](int number) {
        const Material& material = materials[static_cast<std::size_t>(number)];
        if (!material.may_transmit()) return;
        several |= (ior && *ior != material.ior) || any_follows(material.follows, "ior");
        ior = material.ior;
    });
    return several;
}

bool glass(const UnionGroup& group, const std::vector<Material>& materials) {
    bool any = false;
    for (const UnionPart& part : group)
        for_each_leaf(part.primitive, [&](const Primitive& leaf, const glm::dmat4&) {
            any |= materials[static_cast<std::size_t>(leaf.material)].may_transmit();
        });
    return any;
}

/// Returns whether it does not matter which of two faces in one plane is seen: all have the material `first`, whose
/// pattern, if any, goes on through the whole.
bool one_look(const UnionGroup& group, const Primitive& whole, const std::vector<Material>& materials) {
    const int first = group.front().primitive.material;
    bool other = materials[static_cast<std::size_t>(first)].patterned() && first != whole.material;
    for (const UnionPart& part : group) each_material(part.primitive, [&](int number) { other |= number != first; });
    return !other;
}

int leaves_of(const UnionGroup& group) {
    int sum = 0;
    for (const UnionPart& part : group) sum += leaves_of(part.primitive.shape);
    return sum;
}

}  // namespace

std::vector<UnionGroup> union_groups(const Primitive& whole, const std::vector<Material>& materials) {
    const Union* const shape = std::get_if<Union>(&whole.shape);
    if (!shape || several_media(whole, materials) || std::ranges::any_of(*shape->parts, moves)) return {};
    std::vector<UnionPart> parts;
    collect(whole, {}, {}, parts);
    std::vector<Box> boxes;
    for (const UnionPart& part : parts) boxes.push_back(box_of(part));
    LinkedBoxes linked(std::move(boxes));
    std::map<std::size_t, UnionGroup> linked_parts;
    for (std::size_t i = 0; i < parts.size(); ++i) linked_parts[linked[i]].push_back(std::move(parts[i]));
    std::vector<UnionGroup> groups;
    for (auto& [first, group] : linked_parts) {
        const bool divided =
            !glass(group, materials) && (one_look(group, whole, materials) || leaves_of(group) > most_opaque);
        if (group.size() == 1 || !divided)
            groups.push_back(std::move(group));
        else
            for (UnionPart& part : group) groups.push_back({std::move(part)});
    }
    if (groups.size() == 1 && groups[0].size() > 1) return {};
    return groups;
}

int most_leaves_together(const Primitive& whole, const std::vector<Material>& materials) {
    const std::vector<UnionGroup> groups = union_groups(whole, materials);
    int most = groups.empty() ? leaves_of(whole.shape) : 0;
    for (const UnionGroup& group : groups) most = std::max(most, leaves_of(group));
    return most;
}

}  // namespace strahl
