#include "scene/split_unions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "scene/leaves.h"
#include "scene/moving_scene.h"
#include "scene/overlap.h"

namespace strahl {
namespace {

using Steps = std::vector<Transformation>;

/// A part that is no union, with the transformations of all unions around it but the outermost one's.
struct Part {
    Primitive primitive;
    Steps to_pattern;  // from its own space to that of its material's pattern
};

Steps joined(const Steps& first, const Steps& then) {
    Steps steps = first;
    steps.insert(steps.end(), then.begin(), then.end());
    return steps;
}

Steps inverse(const Steps& steps) {
    Steps result;
    struct {
        Steps& result;
        void operator()(const Rotate& step) const {
            for (int c = 2; c >= 0; --c) {
                DVec3 degrees(0);
                degrees[c] = -step.degrees[c];
                if (degrees[c] != 0) result.push_back(Rotate{degrees});
            }
        }
        void operator()(const Translate& step) const { result.push_back(Translate{-step.by}); }
        void operator()(const Scale& step) const { result.push_back(Scale{1. / step.by}); }
        void operator()(const Motion&) const {}  // unions whose parts move stay whole
    } invert{result};
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) std::visit(invert, *step);
    return result;
}

/// The parts of a union; `outer` are the transformations of the unions around it, as above.
void collect(const Primitive& whole, const Steps& outer, const Steps& to_pattern, std::vector<Part>& parts) {
    for (const Primitive& part : *std::get<Union>(whole.shape).parts) {
        Part own{part, {}};
        own.primitive.transformations = joined(part.transformations, outer);
        if (part.material == whole.material) own.to_pattern = joined(part.transformations, to_pattern);
        if (std::holds_alternative<Union>(part.shape))
            collect(part, own.primitive.transformations, own.to_pattern, parts);
        else
            parts.push_back(std::move(own));
    }
}

/// Gives it another material, and its parts as far as they have theirs from it.
void repaint(Primitive& primitive, int material) {
    const int before = std::exchange(primitive.material, material);
    const auto look = [&]<class Kind>(Kind& kind) {
        if constexpr (is_composite<Kind>) {
            std::vector<Primitive> parts = *kind.parts;
            for (Primitive& part : parts)
                if (part.material == before) repaint(part, material);
            kind.parts = std::make_shared<const std::vector<Primitive>>(std::move(parts));
        }
    };
    std::visit(look, primitive.shape);
}

/// Boxes that meet, or that such ones link, are in one group.
class Groups {
  public:
    explicit Groups(std::vector<Box> all) : boxes(std::move(all)), parents(boxes.size()), order(boxes.size()) {
        std::iota(parents.begin(), parents.end(), 0);
        std::iota(order.begin(), order.end(), 0);
        nodes.resize(4 * boxes.size());
        look_within({0, 0, boxes.size()});
    }
    /// The first box of the group.
    std::size_t operator[](std::size_t i) {
        for (; parents[i] != i; i = parents[i]) parents[i] = parents[parents[i]];
        return i;
    }

  private:
    struct Range {
        std::size_t node, first, count;
        Range lower() const { return {2 * node + 1, first, count / 2}; }
        Range upper() const { return {2 * node + 2, first + count / 2, count - count / 2}; }
    };
    struct Node {
        Box box;
        bool one_group = true;
    };
    static bool apart(const Box& a, const Box& b) {
        for (int c = 0; c < 3; ++c)
            if (a.high[c] < b.low[c] || b.high[c] < a.low[c]) return true;
        return false;
    }
    bool same(const Range& a, const Range& b) {
        return nodes[a.node].one_group && nodes[b.node].one_group && (*this)[order[a.first]] == (*this)[order[b.first]];
    }
    void unite(std::size_t a, std::size_t b) {
        a = (*this)[a], b = (*this)[b];
        parents[std::max(a, b)] = std::min(a, b);
    }
    /// Halves the boxes along the axis on which they are spread the furthest. Pairs are looked at where halves meet.
    void look_within(const Range& range) {
        Node& own = nodes[range.node];
        Box lows;
        for (std::size_t i = 0; i < range.count; ++i) {
            const Box& box = boxes[order[range.first + i]];
            own.box.add(box);
            if (std::isfinite(box.low.x + box.low.y + box.low.z)) lows.add(box.low);
        }
        if (range.count < 2) return;
        const DVec3 spread = lows.size();
        const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(range.first);
        std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(range.count / 2),
                         begin + static_cast<std::ptrdiff_t>(range.count),
                         [&](std::size_t a, std::size_t b) { return boxes[a].low[axis] < boxes[b].low[axis]; });
        look_within(range.lower()), look_within(range.upper());
        look_between(range.lower(), range.upper());
        own.one_group = same(range.lower(), range.upper());
    }
    void look_between(const Range& a, const Range& b) {
        if (apart(nodes[a.node].box, nodes[b.node].box) || same(a, b)) return;
        if (a.count == 1 && b.count == 1) return unite(order[a.first], order[b.first]);
        const bool halve_a = a.count >= b.count;
        look_between(halve_a ? a.lower() : a, halve_a ? b : b.lower());
        look_between(halve_a ? a.upper() : a, halve_a ? b : b.upper());
    }

    std::vector<Box> boxes;
    std::vector<std::size_t> parents, order;
    std::vector<Node> nodes;
};

/// A little larger than the part: what only rounding keeps apart is together.
Box box_of(const Part& part) {
    Box box = world_bounds(part.primitive);
    for (int c = 0; c < 3; ++c) {
        const double grow = 1e-6 * std::max(std::fabs(box.low[c]), std::fabs(box.high[c]));
        box.low[c] -= grow, box.high[c] += grow;
    }
    return box;
}

/// The materials of a composite and of all that it consists of.
template <class Visit>
void each_material(const Primitive& primitive, const Visit& visit) {
    visit(primitive.material);
    const auto look = [&]<class Kind>(const Kind& kind) {
        if constexpr (is_composite<Kind>)
            for (const Primitive& part : *kind.parts) each_material(part, visit);
    };
    std::visit(look, primitive.shape);
}

class Splitting {
  public:
    Splitting(const Primitive& whole, std::vector<Material>& materials) : whole(whole), materials(materials) {}

    std::vector<Primitive> result() {
        if (!std::holds_alternative<Union>(whole.shape) || several_media() || parts_move()) return {whole};
        collect(whole, {}, {}, parts);
        std::vector<Box> boxes;
        for (const Part& part : parts) boxes.push_back(box_of(part));
        Groups groups(std::move(boxes));
        std::map<std::size_t, std::vector<std::size_t>> members;
        for (std::size_t i = 0; i < parts.size(); ++i) members[groups[i]].push_back(i);
        std::vector<Primitive> pieces;
        for (const auto& [first, group] : members) {
            const bool alone = group.size() == 1 || (!glass(group) && (one_look(group) || leaves(group) > most_opaque));
            if (!alone && members.size() == 1) return {whole};
            if (!alone) {
                pieces.push_back(united(group));
                continue;
            }
            for (const std::size_t i : group) {
                Primitive piece = painted(parts[i], false);
                piece.transformations = joined(piece.transformations, whole.transformations);
                pieces.push_back(std::move(piece));
            }
        }
        return pieces;
    }

  private:
    bool parts_move() const { return std::ranges::any_of(*std::get<Union>(whole.shape).parts, moves); }
    /// Has it more than one index of refraction? The whole has that of its own material, a part by itself its own.
    bool several_media() const {
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
    bool glass(const std::vector<std::size_t>& group) const {
        bool any = false;
        for (const std::size_t i : group)
            for_each_leaf(parts[i].primitive, [&](const Primitive& leaf, const glm::dmat4&) {
                any |= materials[static_cast<std::size_t>(leaf.material)].may_transmit();
            });
        return any;
    }
    /// Is it the same on any of two faces that are in one plane? Patterns are where their parts are, or the whole is.
    bool one_look(const std::vector<std::size_t>& group) const {
        const int first = parts[group.front()].primitive.material;
        bool other = materials[static_cast<std::size_t>(first)].patterned() && first != whole.material;
        for (const std::size_t i : group)
            each_material(parts[i].primitive, [&](int number) { other |= number != first; });
        return !other;
    }
    int leaves(const std::vector<std::size_t>& group) const {
        int sum = 0;
        for (const std::size_t i : group) sum += leaves_of(parts[i].primitive.shape);
        return sum;
    }
    Primitive united(const std::vector<std::size_t>& group) {
        std::vector<Primitive> own;
        for (const std::size_t i : group) own.push_back(painted(parts[i], true));
        return {Union{std::make_shared<const std::vector<Primitive>>(std::move(own))}, whole.material,
                whole.transformations};
    }
    /// With its pattern where it was. In a union its material, if it is that of the union, has the union's space.
    Primitive painted(const Part& part, bool in_union) {
        Primitive own = part.primitive;
        Material material = materials[static_cast<std::size_t>(own.material)];
        const bool shared = in_union && own.material == whole.material;
        const std::size_t steps = shared ? own.transformations.size() : 0;
        if (!material.patterned() || part.to_pattern.size() == steps) return own;
        const auto moved = [&](Pattern pattern) {
            if (pattern.by_uv) return pattern;
            pattern.transformations = joined(pattern.transformations, inverse(part.to_pattern));
            return pattern;
        };
        if (material.rgb.pattern) material.rgb = Pigment(moved(*material.rgb.pattern));
        for (Relief* const relief : material.reliefs())
            if (relief->pattern) relief->pattern = std::make_shared<const Pattern>(moved(*relief->pattern));
        repaint(own, static_cast<int>(materials.size()));
        materials.push_back(std::move(material));
        return own;
    }

    const Primitive& whole;
    std::vector<Material>& materials;
    std::vector<Part> parts;
};

}  // namespace

std::vector<Primitive> split_union(const Primitive& primitive, std::vector<Material>& materials) {
    return Splitting(primitive, materials).result();
}

Scene with_split_unions(Scene scene) {
    const auto is_union = [](const Primitive& primitive) { return std::holds_alternative<Union>(primitive.shape); };
    if (std::ranges::none_of(scene.primitives, is_union)) return scene;
    std::vector<Primitive> all;
    for (Primitive& primitive : scene.primitives)
        if (is_union(primitive))
            std::ranges::move(split_union(primitive, scene.materials), std::back_inserter(all));
        else
            all.push_back(std::move(primitive));
    scene.primitives = std::move(all);
    return scene;
}

}  // namespace strahl
