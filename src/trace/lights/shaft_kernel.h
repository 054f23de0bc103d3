// Shafts: tests which bodies may be between a point and a rectangle.
#pragma once
#include <bit>

#include "num/memory.h"
#include "trace/hierarchy/hierarchy.h"
#include "trace/world/world.h"

namespace strahl::inline STRAHL_LEVEL {

/// The pyramid from a point to a rectangle: all that is not in front of any of its planes.
template <class T>
class Shaft {
  public:
    /// `ways` are the vectors from the point to the corners, neighbours of which differ by `u` and by `v` in turn.
    /// `slack` is the error of coordinates.
    Shaft(const Vec3<T>& point, const Vec3<T> (&ways)[4], const Vec3<T>& u, const Vec3<T>& v, T slack) : point(point) {
        const Vec3<T> middle = scale(T(.5), ways[0] + ways[2]);
        for (int i = 0; i < 4; ++i) {
            corner[i] = point + ways[i];
            add(cross(i % 2 == 0 ? u : v, ways[i]), point, middle, slack);
        }
        add(cross(u, v), corner[0], Vec3<T>(0) - middle, slack);
    }
    /// Returns the lanes in which a ball is certainly outside; the second function, a box.
    template <class S>
    Mask<S> beside_ball(const Vec3<S>& centre, const S& radius) const {
        Mask<S> beside = first_lanes<S>(0);
        for (int i = 0; i < planes; ++i) beside = beside | (dot(splat<S>(normal[i]), centre) - S(offset[i]) > radius);
        return beside;
    }
    template <class S>
    Mask<S> beside_box(const Vec3<S>& low, const Vec3<S>& high) const {
        Mask<S> beside = first_lanes<S>(0);
        for (int i = 0; i < planes; ++i) {
            S nearest(-offset[i]);  // of the corners
            for (int c = 0; c < 3; ++c) nearest = fma(S(normal[i][c]), normal[i][c] > 0 ? low[c] : high[c], nearest);
            beside = beside | (nearest > S(0));
        }
        return beside;
    }
    /// Returns true if a plane is certainly not in the way. One that contains the point is not if the rectangle is all
    /// on one side of it.
    bool beside_plane(const Vec3<T>& plane, T distance, bool on_it) const {
        const T own = dot(plane, point) - distance;
        bool above = on_it || own > 0, below = on_it || own < 0;
        for (const Vec3<T>& c : corner) {
            const T height = dot(plane, c) - distance;
            above = above && height > 0, below = below && height < 0;
        }
        return above || below;
    }

  private:
    void add(const Vec3<T>& across, const Vec3<T>& on, const Vec3<T>& inwards, T slack) {
        const T length = sqrt(dot(across, across));
        const Vec3<T> unit = scale((dot(across, inwards) > 0 ? T(-1) : T(1)) / length, across);
        const T at = dot(unit, on) + slack;
        if (!(abs(at) < std::numeric_limits<T>::infinity())) return;  // two corners in one direction
        normal[planes] = unit, offset[planes++] = at;
    }
    Vec3<T> point, corner[4], normal[5];
    T offset[5];
    int planes = 0;
};

/// Tells where a shaft begins: on which surface of which body, and whether on its outside.
template <class T>
struct ShaftStart {
    T surface;
    int light, bin;
    bool outside;
};

/// Returns true if an item is certainly not in the way. Convex bodies never are in the way of their own outside, nor is
/// a flat body in its own way.
template <class T, class Item>
[[gnu::flatten]] bool beside_item(const Shaft<T>& shaft, const Item& item, const ShaftStart<T>& start) {
    using Kind = typename Item::Kind;
    const bool own = start.surface >= item.surface && start.surface < item.surface + T(Item::faces);
    if constexpr (!Kind::bounded) {
        return shaft.beside_plane(item.shape.normal, item.shape.distance, own);
    } else {
        if (own && Kind::convex && (start.outside || !Kind::closed)) return true;
        if constexpr (requires { item.shape.ball(); }) {
            const Ball ball = item.shape.ball();
            const Vec3<T> centre(T(ball.centre.x), T(ball.centre.y), T(ball.centre.z));
            return shaft.beside_ball(centre, T(ball.radius));
        }
        return false;
    }
}
/// Returns true if items [first, first + count) of a group are all certainly not in the way.
template <class T, class Group>
bool beside_items(const Shaft<T>& shaft, const Group& group, int first, int count, const ShaftStart<T>& start) {
    for (int i = first; i < first + count; ++i)
        if (!beside_item(shaft, group.items[i], start)) return false;
    return true;
}

/// Returns the bodies that may reach into the shaft and can keep this light from the body where it starts.
/// For worlds where each item has a bin.
template <class S, class T>
BodySet bodies_in(const World<T>& world, const Shaft<T>& shaft, const ShaftStart<T>& start) {
    BodySet reach = 0;
    for (int i = 0; i < world.bins; i += width<S>) {
        const auto at = [i](const T* values) { return load_lanes<S>(values + i); };
        const Vec3<S> centre(at(world.few.centres.x), at(world.few.centres.y), at(world.few.centres.z));
        reach |= BodySet(bits(!shaft.beside_ball(centre, at(world.few.radii)))) << i;
    }
    if (start.outside && (world.few.convex >> start.bin & 1)) reach &= ~(BodySet(1) << start.bin);
    world.groups.each([&](const auto& group) {
        if constexpr (!std::remove_cvref_t<decltype(group)>::Form::Kind::bounded)
            for (int i = 0; i < group.count; ++i)
                if (beside_item(shaft, group.items[i], start)) reach &= ~(BodySet(1) << (group.first_bin + i));
    });
    return reach & world.few.occluders[start.light * world.bins + start.bin];
}

/// Returns true if anything may reach into the shaft. For worlds with a hierarchy.
template <class S, class T>
bool anything_in(const World<T>& world, const Shaft<T>& shaft, const ShaftStart<T>& start) {
    bool clear = true;
    world.groups.each([&](const auto& group) {
        clear = clear && beside_items(shaft, group, group.in_hierarchy, group.count - group.in_hierarchy, start);
    });
    std::int32_t stack[Hierarchy::most_levels * Node::width];
    int height = 0;
    if (world.nodes) stack[height++] = 0;
    while (clear && height > 0) {
        const Node& node = world.nodes[stack[--height]];
        const auto side = [](const float(&of)[3][Node::width], int c) {
            return Vec3<S>(load_converted<S>(of[0] + c), load_converted<S>(of[1] + c), load_converted<S>(of[2] + c));
        };
        for (int c = 0; c < node.children; c += width<S>) {
            const Mask<S> met =
                first_lanes<S>(node.children - c) & !shaft.beside_box(side(node.low, c), side(node.high, c));
            for (unsigned left = bits(met); clear && left; left &= left - 1) {
                const int i = c + std::countr_zero(left), code = node.leaves[i];
                if (code == 0) {
                    stack[height++] = node.first[i];
                    continue;
                }
                int form = 0;
                world.groups.each([&](const auto& group) {
                    if (form++ == LeafCode::form(code))
                        clear = beside_items(shaft, group, node.first[i], LeafCode::items(code), start);
                });
            }
        }
    }
    return !clear;
}

}  // namespace strahl::inline STRAHL_LEVEL
