// Ray queries on the whole world with error bounds, nearest hit and transmitted light: each lane is certain or
// undecided.
#pragma once
#include "trace/proof/composite_bounds.h"
#include "trace/proof/light_buffer_bounds.h"

namespace strahl::inline STRAHL_LEVEL {

/// Returns a ray for traversing the hierarchy, widened by the errors of bodies, which boxes have too, and by how far
/// the exact ray is from the computed one anywhere in the hierarchy.
template <class S>
STRAHL_INLINE RoundedTraversalRay<S> traversal_ray(const DoubtfulRay<S>& own, const Slack<Element<S>>& slack) {
    const S way = norm1(own.ray.origin) + S(2 * slack.reach);
    const S off = own.doubt.away + (own.doubt.turn + S(8 * unit_error<S>)) * way + S(4 * slack.culled * slack.reach);
    const Vec3<S> offs(off, off, off);
    return {own.ray.origin - offs, own.ray.origin + offs, traversal_ray(own.ray).inverse};
}

/// Finds what rays may meet in the hierarchy. Kept out of line: inlined, its stack frame would slow down small worlds.
template <class S>
[[gnu::noinline]] void candidates_in_hierarchy(const World<Element<S>>& world, const DoubtfulRay<S>& own,
                                               Mask<S> active, const Slack<Element<S>>& slack, Candidates<S>& found) {
    using T = Element<S>;
    const auto line = traversal_ray(own, slack);
    const auto look = [&](const Leaf& leaf, Mask<S> mask) {
        const bool known = if_known(world, leaf.form(), [&](const auto& group) {
            for (int i = leaf.first; i < leaf.first + leaf.count(); ++i)
                add_item(group.items[i], own, mask, slack, T(-1), found);
        });
        if (!known && !add_composites(world, leaf.form(), leaf.first, leaf.count(), own, mask, slack, found))
            found.add_unknown(mask, S(0));
        return false;
    };
    traverse<true>(world.nodes, line, active, found.high, look, [&](int k, const Leaf& from) {
        const DoubtfulRay<S> single = lane_of(own, k);
        T limit = lane(found.high, k);
        Candidates<S> all;  // candidates of this ray alone, one in each lane
        const auto look_single = [&](const Leaf& leaf) {
            const bool known = if_known(world, leaf.form(), [&](const auto& group) {
                for (int i = leaf.first; i < leaf.first + leaf.count(); i += width<S>)
                    add_item(load_of_leaf<S>(group, leaf.first, leaf.count(), i), single,
                             first_lanes<S>(leaf.first + leaf.count() - i), slack, T(-1), all);
            });
            const Mask<S> one = first_lanes<S>(1);
            if (!known && !add_composites(world, leaf.form(), leaf.first, leaf.count(), single, one, slack, all))
                all.add_unknown(one, S(0));
            limit = min(limit, least(all.high));
            return false;
        };
        if (from.code != 0)
            look_single(from);
        else
            traverse_single<true>(world.nodes, from.first, lane_of(line, k), limit, look_single);
        const Mask<S> own_lane = first_lanes<S>(k + 1) & !first_lanes<S>(k);
        for (int i = 0; i < width<S>; ++i) {
            if (!(lane(all.low, i) < Candidates<S>::inf)) continue;
            const T second = lane(all.second, i);
            found.add(own_lane, S(lane(all.low, i)), S(lane(all.high, i)), S(lane(all.t, i)), S(lane(all.surface, i)),
                      S(-1));
            found.second = select(own_lane, min(found.second, S(second)), found.second);
        }
    });
}

/// Bounds the span in the ball around a body of which nothing else is known, where the box around it is met. For worlds
/// where each item has a bin.
template <class S>
[[gnu::noinline]] SpanBounds<S> span_around(const World<Element<S>>& world, int bin, const DoubtfulRay<S>& own,
                                            const Slack<Element<S>>& slack) {
    using T = Element<S>;
    const SphereKernel<T> ball{{world.few.centres.x[bin], world.few.centres.y[bin], world.few.centres.z[bin]},
                               world.few.radii[bin]};
    SpanBounds<S> span = span_bounds(ball, own.ray, own.doubt, S(-1), slack);
    const BodyBox<T>& box = world.few.boxes[bin];
    S near;
    span.maybe = span.maybe & crosses(splat<S>(box.low), splat<S>(box.high), traversal_ray(own, slack),
                                      S(std::numeric_limits<T>::infinity()), near);
    return span;
}

/// Returns more than the errors of rays and of bodies where they come near to each other within the world. The balls
/// around bodies with a bin each are no further off.
template <class S>
STRAHL_INLINE S off_nearby(const DoubtfulRay<S>& own, const Slack<Element<S>>& slack) {
    const S way = norm1(own.ray.origin) + S(8 * slack.reach);
    const Element<S> bodies = (16 * (slack.share + slack.turn) + 4 * slack.culled) * slack.reach;
    return S(4) * (own.doubt.away + S(bodies) + way * (own.doubt.turn + S(16 * unit_error<S>)));
}

/// Returns the bodies of a set that rays may meet, by the balls around them.
template <class S>
STRAHL_INLINE BodySet met_bodies(const World<Element<S>>& world, const DoubtfulRay<S>& own, Mask<S> active, BodySet set,
                                 const Slack<Element<S>>& slack) {
    const Vec3<S> origin = own.ray.origin, direction = own.ray.direction;
    const S off = off_nearby(own, slack);
    BodySet met = 0;
    for (BodySet left = set; left; left &= left - 1) {
        const int bin = std::countr_zero(left);
        const Vec3<S> way =
            Vec3<S>(S(world.few.centres.x[bin]), S(world.few.centres.y[bin]), S(world.few.centres.z[bin])) - origin;
        const S reach = S(world.few.radii[bin]) + off, along = dot(way, direction);
        const Vec3<S> across = fma(-along, direction, way);
        met |= BodySet(any(active & !((dot(across, across) > reach * reach) | (along < -reach)))) << bin;
    }
    return met;
}

/// Finds what rays may meet first; if each item has a bin, of the bodies of the set.
template <class S>
[[gnu::noinline]] Candidates<S> candidates(const World<Element<S>>& world, const DoubtfulRay<S>& own, Mask<S> active,
                                           BodySet set, const Slack<Element<S>>& slack) {
    using T = Element<S>;
    Candidates<S> found;
    found.bin = S(static_cast<T>(world.bins));
    if (world.bin_per_item && slack.fits()) set = met_bodies(world, own, active, set, slack);
    each_hot_item(
        world, set, [&](const auto& group, int i) __attribute__((always_inline)) {
            const int bin = world.bin_per_item ? group.first_bin + i : group.first_bin;
            add_item(group.items[i], own, active, slack, static_cast<T>(bin), found);
            return false;
        });
    each_cold_range(world, set, [&](const ItemRange& items, int bin) {
        const bool known = if_known(world, items.form, [&](const auto& group) {
            for (int i = items.first; i < items.first + items.count; ++i)
                add_item(group.items[i], own, active, slack, static_cast<T>(world.bin_per_item ? bin : group.first_bin),
                         found);
        });
        if (known || add_composites(world, items.form, items.first, items.count, own, active, slack, found))
            return false;
        if (!world.bin_per_item) return found.add_unknown(active, S(0)), false;
        const SpanBounds<S> span = span_around(world, bin, own, slack);
        found.add_unknown(active & span.maybe & !(span.far_high <= S(0)), span.near_low);
        return false;
    });
    if (world.nodes) candidates_in_hierarchy(world, own, active, slack, found);
    if (world.nodes || world.composites.list) {
        const Mask<S> beyond = (found.bin < S(0)) & (found.surface >= S(0));
        if (any(beyond)) found.bin = select(beyond, bins_of(world, select(beyond, found.surface, S(-1))), found.bin);
    }
    return found;
}

/// Attenuates light by the bodies in the hierarchy. Kept out of line: inlined, its stack frame would slow down small
/// worlds.
template <class S>
[[gnu::noinline]] void light_bounds_in_hierarchy(const World<Element<S>>& world, const DoubtfulRay<S>& own,
                                                 const S& distance, const S& off, Mask<S> active,
                                                 const Slack<Element<S>>& slack, LightBounds<S>& light) {
    S limit = select(active & !light.dark, distance + off, S(-1));
    const auto line = traversal_ray(own, slack);
    const auto look = [&](const Leaf& leaf, Mask<S> mask) {
        const bool known = if_known(world, leaf.form(), [&](const auto& group) {
            for (int i = leaf.first; i < leaf.first + leaf.count(); ++i)
                pass_item(world, group.items[i], own, mask, distance, off, slack, light);
        });
        if (!known &&
            !pass_composites(world, leaf.form(), leaf.first, leaf.count(), own, mask, distance, off, slack, light))
            light.doubt = light.doubt | mask;
        limit = select(light.dark, S(-1), limit);
        return all(limit < S(0));
    };
    traverse<false>(world.nodes, line, active & !light.dark, limit, look, [&](int k, const Leaf& from) {
        const Mask<S> own_lane = first_lanes<S>(k + 1) & !first_lanes<S>(k);
        if (from.code != 0)
            look(from, own_lane);
        else
            traverse_single<false>(world.nodes, from.first, lane_of(line, k), lane(limit, k), [&](const Leaf& leaf) {
                look(leaf, own_lane);
                return lane(limit, k) < 0;
            });
    });
}

/// Returns the bodies of a set whose cones, as seen from a light, some rays to it can be in. Tests width<S> bodies side
/// by side.
template <class S>
STRAHL_INLINE BodySet bodies_in_cones(const World<Element<S>>& world, int light, const DoubtfulRay<S>& own,
                                      const S& furthest, Mask<S> active, BodySet set) {
    using T = Element<S>;
    constexpr int stride = FewBodies<T>::cone_stride;
    const T* const columns = world.few.cone_columns + light * (5 * stride);
    const auto most = [&](const S& value) { return S(-least(select(active, -value, S(0)))); };
    const S turn = most(own.doubt.turn), end = most(furthest);
    Vec3<S> directions[width<S>];  // lanes that are not active have that of one that is
    for (int k = 0; k < width<S>; ++k) {
        const int from = bits(active) >> k & 1 ? k : first(active);
        for (int c = 0; c < 3; ++c) directions[k][c] = S(lane(own.ray.direction[c], from));
    }
    BodySet met = 0;
    for (int i = 0; i < world.bins; i += width<S>) {
        const auto at = [&](int column) { return load_lanes<S>(columns + column * stride + i); };
        const Vec3<S> axis(at(0), at(1), at(2));
        const S limit = turn - at(3);
        Mask<S> near = first_lanes<S>(0);
        for (int k = 0; k < width<S>; ++k) near = near | !(dot(axis, directions[k]) > limit);
        met |= BodySet(bits(near & (end > at(4)))) << i;
    }
    return set & met;
}

/// Returns the bodies, by their bins, that can be in the way of some rays, and in `reached` of which ones. For worlds
/// where each item has a bin, and slack that fits into the margins of cones.
template <class S>
STRAHL_INLINE BodySet reached_bodies(const World<Element<S>>& world, const DoubtfulRay<S>& own, const S& furthest,
                                     Mask<S> active, const Start<S>& start, Mask<S>* reached) {
    const Vec3<S> direction = own.ray.direction;
    const S turn = own.doubt.turn;
    const LightCone<Element<S>>* const cones = world.few.cones + start.light * world.bins;
    constexpr int many = 8;
    BodySet left = world.few.occluders[start.light * world.bins + start.bin], set = 0;
    if (std::popcount(left) > many && any(active))
        left = bodies_in_cones(world, start.light, own, furthest, active, left);
    for (; left; left &= left - 1) {
        const int bin = std::countr_zero(left);
        const LightCone<Element<S>>& cone = cones[bin];
        Mask<S> mask =
            active & !(dot(splat<S>(cone.axis), direction) > S(-cone.cosine) + turn) & (furthest > S(cone.distance));
        if (bin == start.bin && (world.few.convex >> bin & 1)) mask = mask & !start.outside;
        reached[bin] = mask;
        set |= BodySet(any(mask)) << bin;
    }
    return set;
}

/// Bounds the share of a light's light that reaches hits.
template <class S>
[[gnu::noinline]] LightBounds<S> light_bounds(const World<Element<S>>& world, const DoubtfulRay<S>& own,
                                              const S& distance, const S& off, Mask<S> active, const Start<S>& start,
                                              const Slack<Element<S>>& slack) {
    LightBounds<S> light;
    light.dark = light.doubt = first_lanes<S>(0);
    const bool culls = world.bin_per_item && slack.fits();
    Mask<S> reached[most_item_bins];
    const BodySet set = culls                ? reached_bodies(world, own, distance + off, active, start, reached)
                        : world.bin_per_item ? ~BodySet(0)
                                             : 0;
    const auto reached_by = [&](int bin) { return culls ? reached[bin] : active; };
    each_hot_item(
        world, set, [&](const auto& group, int i) __attribute__((always_inline)) {
            const Mask<S> mask = reached_by(group.first_bin + i) & !light.dark;
            if (none(mask)) return false;
            pass_item(world, group.items[i], own, mask, distance, off, slack, light);
            return none(active & !light.dark);
        });
    if (none(active & !light.dark)) return light;
    each_cold_range(world, set, [&](const ItemRange& items, int bin) {
        const Mask<S> mask = reached_by(bin) & !light.dark;
        const bool known = if_known(world, items.form, [&](const auto& group) {
            for (int i = items.first; any(mask) && i < items.first + items.count; ++i)
                pass_item(world, group.items[i], own, mask, distance, off, slack, light);
        });
        if (known ||
            pass_composites(world, items.form, items.first, items.count, own, mask, distance, off, slack, light))
            return false;
        if (!world.bin_per_item) return light.doubt = light.doubt | mask, false;
        const SpanBounds<S> span = span_around(world, bin, own, slack);
        light.doubt = light.doubt | (mask & span.maybe & !(span.far_high <= S(0)) & !(span.near_low >= distance + off));
        return false;
    });
    if (!world.nodes) return light;
    Mask<S> left = active & !light.dark;
    if (world.light_buffers && world.light_buffers[start.light].faces)
        left = light_bounds_in_buffer(world, start.light, own, distance, off, left, slack, light);
    if (any(left)) light_bounds_in_hierarchy(world, own, distance, off, left, slack, light);
    return light;
}

}  // namespace strahl::inline STRAHL_LEVEL
