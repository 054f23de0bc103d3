// Ways through a hierarchy: of a pack of rays together, and of one ray alone.
#pragma once
#include <bit>
#include <limits>

#include "num/memory.h"
#include "trace/hierarchy.h"
#include "trace/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// Most entries of a stack: on each level all children of a node but the one gone into, and this one.
inline constexpr int most_entries = Hierarchy::most_levels * (Node::width - 1) + 1;

/// Rays as boxes see them, with finite reciprocals of the direction.
template <class S>
struct Line {
    Vec3<S> origin, inverse;
};
template <class S>
STRAHL_INLINE Line<S> line_of(const Ray<S>& ray) {
    using T = Element<S>;
    constexpr T tiny = T(1) / (T(1) * (std::uint64_t(1) << 60));
    const auto reciprocal = [](S d) { return S(1) / select(abs(d) < S(tiny), select(d < S(0), S(-tiny), S(tiny)), d); };
    return {ray.origin, {reciprocal(ray.direction.x), reciprocal(ray.direction.y), reciprocal(ray.direction.z)}};
}
template <class S>
STRAHL_INLINE Line<S> lane_of(const Line<S>& line, int k) {
    const auto pick = [k](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, k)), S(lane(v.y, k)), S(lane(v.z, k))); };
    return {pick(line.origin), pick(line.inverse)};
}

/// Does the line cross the box before `limit`, and where at the earliest? Boxes are grown when built and their far ends
/// here (T. Ize, "Robust BVH Ray Traversal", JCGT 2013): rounding never hides a hit. One ray in each lane and the same
/// box, or the other way round.
template <class S>
STRAHL_INLINE Mask<S> crosses(const Vec3<S>& low, const Vec3<S>& high, const Line<S>& line, const S& limit, S& near) {
    const S grow(1 + 4 * std::numeric_limits<Element<S>>::epsilon());
    S far = limit;
    near = S(0);
    for (int i = 0; i < 3; ++i) {
        const S a = (low[i] - line.origin[i]) * line.inverse[i], b = (high[i] - line.origin[i]) * line.inverse[i];
        near = max(near, min(a, b));
        far = min(far, max(a, b) * grow);
    }
    return near <= far;
}

/// Boxes of the children from `c` on, one in each lane.
template <class S>
STRAHL_INLINE Vec3<S> boxes(const float (&side)[3][Node::width], int c) {
    return {load_converted<S>(side[0] + c), load_converted<S>(side[1] + c), load_converted<S>(side[2] + c)};
}
/// The box of child `c` in all lanes.
template <class S>
STRAHL_INLINE Vec3<S> box(const float (&side)[3][Node::width], int c) {
    using T = Element<S>;
    return {S(static_cast<T>(side[0][c])), S(static_cast<T>(side[1][c])), S(static_cast<T>(side[2][c]))};
}

/// All lines of a pack, as intervals: what none of them can cross need not be looked at one by one.
template <class S>
class Beam {
    using T = Element<S>;

  public:
    STRAHL_INLINE Beam(const Line<S>& line, Mask<S> active) {
        const S most(std::numeric_limits<T>::infinity());
        for (int i = 0; i < 3; ++i) {
            origin_low[i] = S(least(select(active, line.origin[i], most)));
            origin_high[i] = S(-least(select(active, -line.origin[i], most)));
            const T low = least(select(active, line.inverse[i], most));
            const T high = -least(select(active, -line.inverse[i], most));
            way[i] = low > 0 ? 1 : high < 0 ? -1 : 0;
            flat[i] = S(low > 0 ? low : -high);
            steep[i] = S(low > 0 ? high : -low);
        }
    }
    /// Is a box in the way of any? `near` is a lower bound of where.
    STRAHL_INLINE Mask<S> meets(const Vec3<S>& low, const Vec3<S>& high, S& near) const {
        const S grow(1 + 4 * std::numeric_limits<T>::epsilon());
        S far(std::numeric_limits<T>::infinity());
        near = S(0);
        for (int i = 0; i < 3; ++i) {
            if (way[i] == 0) continue;
            const S a = way[i] > 0 ? low[i] - origin_high[i] : origin_low[i] - high[i];
            const S b = way[i] > 0 ? high[i] - origin_low[i] : origin_high[i] - low[i];
            near = max(near, a * select(a < S(0), steep[i], flat[i]));
            far = min(far, b * select(b < S(0), flat[i], steep[i]) * grow);
        }
        return near <= far;
    }

  private:
    Vec3<S> origin_low, origin_high;
    Vec3<S> flat, steep;  // smallest and largest reciprocal, without its sign
    int way[3];           // that sign, or 0 where lines go both ways
};

/// A stack whose topmost stretch can be kept sorted, the nearest on top. Entries are written and read in place, field
/// by field: whole copies would wait for fields just written.
template <class Entry>
class Stack {
  public:
    /// To be read before anything is pushed.
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

/// One ray's way through the part of a hierarchy from a node on: leaf(first, count) for leaves whose boxes it crosses
/// before `limit`, until that returns true. Front to back if `sorted`, else in the order of the items.
template <bool sorted, class S, class Leaf>
STRAHL_INLINE void traverse_alone(const Node* nodes, int root, const Line<S>& line, const Element<S>& limit,
                                  const Leaf& leaf) {
    using T = Element<S>;
    struct Entry {
        T near;
        std::int32_t first, count;
    };
    Stack<Entry> stack;
    const auto put = [](Entry& entry, T near, std::int32_t first, std::int32_t count) {
        entry.near = near, entry.first = first, entry.count = count;
    };
    put(stack.push(), T(0), root, 0);
    while (!stack.empty()) {
        const Entry& top = stack.pop();
        const std::int32_t at = top.first, items = top.count;
        if (top.near > limit) continue;
        if (items > 0) {
            if (leaf(at, items)) return;
            continue;
        }
        const Node& node = nodes[at];
        const int bottom = stack.height();
        T nears[Node::width];
        const auto look = [&](int c) {
            S near;
            const Mask<S> hit = crosses(boxes<S>(node.low, c), boxes<S>(node.high, c), line, S(limit), near) &
                                first_lanes<S>(node.children - c);
            store_lanes(nears + c, near);
            return bits(hit);
        };
        if constexpr (sorted) {
            for (int c = 0; c < node.children; c += width<S>)
                for (unsigned hits = look(c); hits; hits &= hits - 1) {
                    const int i = c + std::countr_zero(hits);
                    put(stack.push_sorted(nears[i], bottom), nears[i], node.first[i], node.count[i]);
                }
        } else {
            for (int c = (node.children - 1) / width<S> * width<S>; c >= 0; c -= width<S>)
                for (unsigned hits = look(c); hits;) {
                    const int i = c + std::bit_width(hits) - 1;
                    hits &= ~(1u << (i - c));
                    put(stack.push(), nears[i], node.first[i], node.count[i]);
                }
        }
    }
}

/// The way of a pack of rays: leaf(first, count, mask) for leaves, with the lanes whose rays cross its box; until that
/// returns true. Where few rays are left, each goes on by itself: alone(lane, first, count), a leaf's items or 0. What is asked of a ray
/// does not depend on its neighbours if `sorted` is false, and else but for the order.
template <bool sorted, class S, class Leaf, class Alone>
STRAHL_INLINE void traverse(const Node* nodes, const Line<S>& line, Mask<S> active, const S& limit, const Leaf& leaf,
                            const Alone& alone) {
    using T = Element<S>;
    constexpr int few = width < S >> 4 ? width<S> / 4 : 1;
    constexpr int dear = 3;  // so many items of a pack cost as much as a pack of items of a ray
    struct Entry {
        S enters;
        Mask<S> mask;
        T near;
        std::int32_t first, count;
    };
    const Beam<S> beam(line, active);
    Stack<Entry> stack;
    const auto put = [](Entry& entry, const S& enters, Mask<S> mask, T near, std::int32_t first, std::int32_t count) {
        entry.enters = enters, entry.mask = mask, entry.near = near, entry.first = first, entry.count = count;
    };
    put(stack.push(), S(0), active, T(0), 0, 0);
    while (!stack.empty()) {
        const Entry& top = stack.pop();
        const std::int32_t at = top.first, items = top.count;
        const Mask<S> mask = top.mask & (top.enters <= limit);
        const int rays = count(mask);
        if (rays == 0) continue;
        // Items beside each other for one ray after the other, or rays for one item after the other?
        if (items > 0 ? rays * dear * ((items - 1) / width<S> + 1) <= items : rays <= few) {
            for (unsigned left = bits(mask); left; left &= left - 1) alone(std::countr_zero(left), at, items);
            continue;
        }
        if (items > 0) {
            if (leaf(at, items, mask)) return;
            continue;
        }
        const Node& node = nodes[at];
        const int bottom = stack.height();
        T nears[Node::width];
        const auto look = [&](int c) {
            S near;
            const Mask<S> met =
                beam.meets(boxes<S>(node.low, c), boxes<S>(node.high, c), near) & first_lanes<S>(node.children - c);
            store_lanes(nears + c, near);
            return bits(met);
        };
        const auto enter = [&](int i) {
            S enters;
            const Mask<S> hit = mask & crosses(box<S>(node.low, i), box<S>(node.high, i), line, limit, enters);
            if (none(hit)) return;
            Entry& child = sorted ? stack.push_sorted(nears[i], bottom) : stack.push();
            put(child, enters, hit, nears[i], node.first[i], node.count[i]);
        };
        for (int c = (node.children - 1) / width<S> * width<S>; c >= 0; c -= width<S>)
            for (unsigned met = look(c); met;) {
                const int i = c + std::bit_width(met) - 1;
                met &= ~(1u << (i - c));
                enter(i);
            }
    }
}

}  // namespace strahl::inline STRAHL_LEVEL
