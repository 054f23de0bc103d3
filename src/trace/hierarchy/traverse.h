// Traversal of the hierarchy: by a pack of rays together, and by a single ray.
#pragma once
#include <bit>
#include <limits>
#include <type_traits>

#include "trace/hierarchy/hierarchy.h"
#include "trace/hierarchy/traversal_ray.h"

namespace strahl::inline STRAHL_LEVEL {

/// The most entries of a stack: on each level the children of a node but the one that is entered, and that one.
inline constexpr int most_entries = Hierarchy::most_levels * (Node::width - 1) + 1;

/// Finds where rays enter boxes, at 0 if they start inside, and leave them; where they do not cross them they leave
/// before they enter. Boxes are grown when they are built and far ends here, so that rounding hides no hit (T. Ize,
/// "Robust BVH Ray Traversal", JCGT 2013). Lanes hold rays and one box, or boxes and one ray.
template <class S, class L>
STRAHL_INLINE void cross_boxes(const Vec3<S>& low, const Vec3<S>& high, const L& ray, S& near, S& far) {
    const S grow(1 + 8 * std::numeric_limits<Element<S>>::epsilon());
    far = S(std::numeric_limits<Element<S>>::infinity());
    near = S(0);
    for (int i = 0; i < 3; ++i) {
        const S a = (low[i] - ray.high(i)) * ray.inverse[i], b = (high[i] - ray.low(i)) * ray.inverse[i];
        near = max(near, min(a, b));
        far = min(far, max(a, b));
    }
    far = far * grow;
}
/// Returns whether rays cross boxes before `limit`, and sets `near` to where they enter.
template <class S, class L>
STRAHL_INLINE Mask<S> crosses(const Vec3<S>& low, const Vec3<S>& high, const L& ray, const S& limit, S& near) {
    S far;
    cross_boxes(low, high, ray, near, far);
    return near <= min(far, limit);
}

/// Returns one side of the boxes of the children from `c` on, one child in each lane.
template <class S>
STRAHL_INLINE Vec3<S> boxes(const float (&side)[3][Node::width], int c) {
    return {load_converted<S>(side[0] + c), load_converted<S>(side[1] + c), load_converted<S>(side[2] + c)};
}
/// Returns one side of the box of child `c` in all lanes.
template <class S>
STRAHL_INLINE Vec3<S> box(const float (&side)[3][Node::width], int c) {
    using T = Element<S>;
    return {S(static_cast<T>(side[0][c])), S(static_cast<T>(side[1][c])), S(static_cast<T>(side[2][c]))};
}

/// Intervals that hold all rays of a pack: a box that none of them can cross need not be tested ray by ray.
template <class S>
class PacketBounds {
    using T = Element<S>;
    using F = ForBoxes<S>;
    using E = Element<F>;

  public:
    /// Finds them, unless they are not `wanted`.
    STRAHL_INLINE PacketBounds(const auto& ray, Mask<S> active, bool wanted) {
        if (!wanted) return;
        const S most(std::numeric_limits<T>::infinity());
        for (int i = 0; i < 3; ++i) {
            const T origin_least = least(select(active, ray.low(i), most));
            const T origin_most = -least(select(active, -ray.high(i), most));
            const T inverse_least = least(select(active, ray.inverse[i], most));
            const T inverse_most = -least(select(active, -ray.inverse[i], most));
            sign[i] = inverse_least > 0 ? 1 : inverse_most < 0 ? -1 : 0;
            if (!std::is_same_v<F, S> && !(origin_least > -farthest && origin_most < farthest)) sign[i] = 0;
            origin_low[i] = F(rounded<E>(origin_least, origin_least < 0));
            origin_high[i] = F(rounded<E>(origin_most, origin_most > 0));
            inv_min[i] = F(rounded<E>(inverse_least > 0 ? inverse_least : -inverse_most, false));
            inv_max[i] = F(rounded<E>(inverse_least > 0 ? inverse_most : -inverse_least, true));
        }
    }
    /// Is a box in the way of any? `near` is a lower bound of where.
    STRAHL_INLINE Mask<F> meets(const Vec3<F>& low, const Vec3<F>& high, F& near) const {
        const F grow(1 + 8 * std::numeric_limits<E>::epsilon());
        F far(std::numeric_limits<E>::infinity());
        near = F(0);
        for (int i = 0; i < 3; ++i) {
            if (sign[i] == 0) continue;
            const F a = sign[i] > 0 ? low[i] - origin_high[i] : origin_low[i] - high[i];
            const F b = sign[i] > 0 ? high[i] - origin_low[i] : origin_high[i] - low[i];
            near = max(near, a * inv_min[i]);  // negative ones do not matter, of whatever size, nor does how much
            far = min(far, b * inv_max[i]);    // a negative end is below 0
        }
        return near <= far * grow;
    }

  private:
    Vec3<F> origin_low, origin_high;
    Vec3<F> inv_min, inv_max;  // smallest and largest reciprocal, without its sign
    int sign[3];               // the common sign, or 0 where rays go both ways
};

/// A stack whose topmost stretch can be kept sorted, the nearest on top. Entries are written and read in place, field
/// by field: whole copies would wait for fields just written.
template <class Entry>
class Stack {
  public:
    /// Removes the topmost entry. The reference is valid until something is pushed.
    STRAHL_INLINE const Entry& pop() { return entries[--size]; }
    STRAHL_INLINE bool empty() const { return size == 0; }
    STRAHL_INLINE int height() const { return size; }
    STRAHL_INLINE Entry& push() { return entries[size++]; }
    template <class T>
    STRAHL_INLINE Entry& push_sorted(T near, int bottom) {
        int at = size++;
        for (; at > bottom && entries[at - 1].near < near; --at) entries[at] = entries[at - 1];
        return entries[at];
    }

  private:
    Entry entries[most_entries];
    int size = 0;
};

/// The items of a leaf; if `code` is 0, the inner node whose number is `first`.
struct Leaf {
    std::int32_t first, code;
    STRAHL_INLINE int count() const { return LeafCode::items(code); }
    STRAHL_INLINE int form() const { return LeafCode::form(code); }
};

/// Traverses the part of a hierarchy from a node on with one ray: visit(leaf) for leaves whose boxes it crosses before
/// `limit`, until that returns true. Front to back if `sorted`, else in the order of the leaves.
template <bool sorted, template <class> class R, class S, class T0, class Visit>
STRAHL_INLINE void traverse_single(const Node* nodes, int root, const R<S>& ray, const T0& limit, const Visit& visit) {
    using T = Element<S>;
    constexpr bool fewer_bits = !std::is_same_v<T, T0>;
    constexpr T shrink = fewer_bits ? 1 - 8 * std::numeric_limits<T>::epsilon() : 1;
    struct Entry {
        T near;
        Leaf leaf;
    };
    Stack<Entry> stack;
    const auto put = [](Entry& entry, T near, const Node& node, int i) {
        entry.near = near;
        entry.leaf.first = node.first[i], entry.leaf.code = node.leaves[i];
    };
    Entry& start = stack.push();
    start.near = T(0), start.leaf.first = root, start.leaf.code = 0;
    while (!stack.empty()) {
        const Entry& top = stack.pop();
        if (top.near > limit) continue;
        const Leaf leaf{top.leaf.first, top.leaf.code};
        if (leaf.code != 0) {
            if (visit(leaf)) return;
            continue;
        }
        const Node& node = nodes[leaf.first];
        const int bottom = stack.height();
        T nears[Node::width];
        const auto test = [&](int c) {
            S near;
            const Mask<S> hit =
                crosses(boxes<S>(node.low, c), boxes<S>(node.high, c), ray, S(rounded<T>(limit, true)), near) &
                first_lanes<S>(node.children - c);
            // A distance that overflows in this type need not in the other.
            store_lanes(nears + c, fewer_bits ? min(near * S(shrink), S(std::numeric_limits<T>::max())) : near);
            return bits(hit);
        };
        if constexpr (sorted) {
            for (int c = 0; c < node.children; c += width<S>)
                for (unsigned hits = test(c); hits; hits &= hits - 1) {
                    const int i = c + std::countr_zero(hits);
                    put(stack.push_sorted(nears[i], bottom), nears[i], node, i);
                }
        } else {
            for (int c = (node.children - 1) / width<S> * width<S>; c >= 0; c -= width<S>)
                for (unsigned hits = test(c); hits;) {
                    const int i = c + std::bit_width(hits) - 1;
                    hits &= ~(1u << (i - c));
                    put(stack.push(), nears[i], node, i);
                }
        }
    }
}

/// Calls visit(first, count) for the leaves of a hierarchy whose boxes a ray crosses before `limit`, in any order:
/// faster than traverse_single, where entries are pushed and sorted, if all leaves are wanted.
template <template <class> class R, class S, class Limit, class Visit>
STRAHL_INLINE void visit_leaves(const Node* nodes, const R<S>& ray, const Limit& limit, const Visit& visit) {
    std::int32_t stack[most_entries];
    stack[0] = 0;
    for (int size = 1; size > 0;) {
        const Node& node = nodes[stack[--size]];
        for (int c = 0; c < node.children; c += width<S>) {
            S near;
            const S end(rounded<Element<S>>(limit, true));
            const Mask<S> hit = crosses(boxes<S>(node.low, c), boxes<S>(node.high, c), ray, end, near);
            for (unsigned hits = bits(hit & first_lanes<S>(node.children - c)); hits; hits &= hits - 1) {
                const int i = c + std::countr_zero(hits), code = node.leaves[i];
                if (code != 0)
                    visit(node.first[i], LeafCode::items(code));
                else
                    stack[size++] = node.first[i];
            }
        }
    }
}

/// Traverses a hierarchy with a pack of rays: visit(leaf, mask) for leaves, with the lanes whose rays cross its box,
/// until that returns true. Where few rays are left, each goes on by itself: single(lane, leaf), which may be an inner
/// node. If `sorted` is false, the visits of a ray do not depend on its neighbours; else only their order does.
template <bool sorted, template <class> class R, class S, class Visit, class Single>
STRAHL_INLINE void traverse(const Node* nodes, const R<S>& ray, Mask<S> active, const S& limit, const Visit& visit,
                            const Single& single) {
    using F = ForBoxes<S>;
    using T = Element<F>;
    constexpr int threshold = width<S> / 4 > 0 ? width<S> / 4 : 1;  // up to so many rays leave the pack
    constexpr int cost_ratio = 3;  // of an item for a pack of rays to a pack of items for a ray
    struct Entry {
        S enters;
        Mask<S> mask;
        T near;
        Leaf leaf;
    };
    // To find these takes as long as to test some ten boxes.
    const PacketBounds<S> packet(ray, active, !nodes->only);
    Stack<Entry> stack;
    Entry& start = stack.push();
    start.enters = S(0), start.mask = active, start.near = T(0), start.leaf.first = 0, start.leaf.code = 0;
    while (!stack.empty()) {
        const Entry& top = stack.pop();
        const Leaf leaf{top.leaf.first, top.leaf.code};
        const Mask<S> mask = top.mask & (top.enters <= limit);
        const int rays = count(mask);
        if (rays == 0) continue;
        // Few rays: test packs of items for one ray after the other. Many: test the pack of rays for each item.
        if (leaf.code != 0 ? rays * cost_ratio * ((leaf.count() - 1) / width<S> + 1) <= leaf.count()
                           : rays <= threshold && !nodes[leaf.first].together) {
            for (unsigned left = bits(mask); left; left &= left - 1) single(std::countr_zero(left), leaf);
            continue;
        }
        if (leaf.code != 0) {
            if (visit(leaf, mask)) return;
            continue;
        }
        const Node& node = nodes[leaf.first];
        const int bottom = stack.height();
        T nears[Node::width];
        const auto test = [&](int c) {
            F near;
            Mask<F> met = first_lanes<F>(node.children - c);
            if (node.only) return bits(met);
            met = met & packet.meets(boxes<F>(node.low, c), boxes<F>(node.high, c), near);
            store_lanes(nears + c, near);
            return bits(met);
        };
        const auto enter = [&](int i) {
            S enters;
            const Mask<S> hit = mask & crosses(box<S>(node.low, i), box<S>(node.high, i), ray, limit, enters);
            if (none(hit)) return;
            if (sorted && node.only) nears[i] = lane(enters, first(hit));
            Entry& child = sorted ? stack.push_sorted(nears[i], bottom) : stack.push();
            child.enters = enters, child.mask = hit, child.near = nears[i];
            child.leaf.first = node.first[i], child.leaf.code = node.leaves[i];
        };
        for (int c = (node.children - 1) / width<F> * width<F>; c >= 0; c -= width<F>)
            for (unsigned met = test(c); met;) {
                const int i = c + std::bit_width(met) - 1;
                met &= ~(1u << (i - c));
                enter(i);
            }
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
