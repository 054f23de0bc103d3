// Ray queries on the whole world: nearest hit and transmitted light.
#pragma once
#include "trace/forms/form_kernel.h"
#include "trace/hierarchy/traverse.h"
#include "trace/lights/area_light_calls.h"
#include "trace/lights/light_buffer.h"
#include "trace/lights/light_buffer_calls.h"

namespace strahl::inline STRAHL_LEVEL {

template <class Group>
using FormOf = typename std::remove_cvref_t<Group>::Form;

/// Calls look(group, item) for the items of hot forms outside the hierarchy, until it returns true; if each item has a
/// bin, only for the items in the set.
template <class T, class Look>
STRAHL_INLINE void each_hot_item(const World<T>& world, BodySet set, const Look& look) {
    bool done = false;
    world.groups.each([&](const auto& group) __attribute__((always_inline)) {
        if constexpr (FormOf<decltype(group)>::hot) {
            if (done) return;
            if (!world.bin_per_item) {
                for (int i = group.in_hierarchy; i < group.count; ++i)
                    if (look(group, i)) return void(done = true);
            } else if (group.count > 0) {
                const BodySet own = ~BodySet(0) >> (most_item_bins - group.count);
                for (BodySet left = set >> group.first_bin & own; left; left &= left - 1)
                    if (look(group, std::countr_zero(left))) return void(done = true);
            }
        }
    });
}

/// Calls look(items, bin) for ranges of items of other forms outside the hierarchy, until it returns true.
template <class T, class Look>
STRAHL_INLINE void each_cold_range(const World<T>& world, BodySet set, const Look& look) {
    for (BodySet left = set & world.few.cold; left; left &= left - 1) {
        const SortBin& bin = world.sort_bins[std::countr_zero(left)];
        if (look(ItemRange{bin.form, bin.item, 1}, std::countr_zero(left))) return;
    }
    for (int i = 0; i < world.loop_count; ++i)
        if (look(world.loops[i], 0)) return;
}

/// Returns the lanes whose rays cross the box around the body of a bin before `limit`, and sets `near` to where.
template <class S>
STRAHL_INLINE Mask<S> crosses_body(const World<Element<S>>& world, int bin, const TraversalRay<S>& line, const S& limit,
                                   S& near) {
    const BodyBox<Element<S>>& box = world.few.boxes[bin];
    return crosses(splat<S>(box.low), splat<S>(box.high), line, limit, near);
}

/// Finds the nearest surfaces of items of other than hot forms, those in the nearest boxes first. For worlds where each
/// item has a bin.
template <class S>
STRAHL_INLINE void nearest_of_cold(const World<Element<S>>& world, const Ray<S>& ray, Mask<S> active, BodySet set,
                                   Nearest<S>& best) {
    using T = Element<S>;
    if (!(set & world.few.cold)) return;
    const S inf(std::numeric_limits<T>::infinity());
    struct BoxMet {
        T first;  // where the first ray enters
        const SortBin* item;
        int number;
    };
    Room<BoxMet, most_item_bins> order;
    Room<S, most_item_bins> entries;  // by number; infinite for rays that do not cross the box
    int count = 0;
    const TraversalRay<S> line = traversal_ray(ray);
    each_cold_range(world, set, [&](const ItemRange&, int bin) {
        S near;
        const Mask<S> own = active & crosses_body(world, bin, line, best.t, near);
        if (none(own)) return false;
        entries[count] = select(own, near, inf);
        const BoxMet box{least(entries[count]), &world.sort_bins[bin], count};
        int place = count++;
        for (; place > 0 && box.first < order[place - 1].first; --place) order[place] = order[place - 1];
        order[place] = box;
        return false;
    });
    for (int i = 0; i < count; ++i) {
        const auto& [first, item, number] = order[i];
        const Mask<S> own = (entries[number] <= best.t) & (entries[number] < inf);
        if (any(own)) calls<S>(item->form).intersect(world, item->item, 1, ray, own, best);
    }
}

/// Finds the nearest surfaces in the hierarchy, for packs that traverse it together.
template <class S>
STRAHL_INLINE void nearest_in_hierarchy(const World<Element<S>>& world, const Ray<S> (&rays)[together<S>],
                                        const Mask<S> (&active)[together<S>], Nearest<S> (&best)[together<S>]) {
    using F = ForBoxes<S>;
    const auto line = traversal_ray(rays);
    F limit(std::numeric_limits<Element<F>>::infinity());
    const auto set_limit = [&] {
        S ends[together<S>];
        for (int h = 0; h < together<S>; ++h) ends[h] = best[h].t;
        limit = join(ends);
        if constexpr (together < S >> 1) limit = limit * F(1 + 8 * std::numeric_limits<Element<F>>::epsilon());
    };
    const auto look = [&](const Leaf& leaf, Mask<F> mask) {
        for (int h = 0; h < together<S>; ++h) {
            const Mask<S> own = pack_of<S>(mask, h);
            if (together<S> == 1 || any(own))
                calls<S>(leaf.form()).intersect(world, leaf.first, leaf.count(), rays[h], own, best[h]);
        }
        set_limit();
        return false;
    };
    set_limit();
    traverse<true>(world.nodes, line, join_masks<S>(active), limit, look, [&](int lane_of_all, const Leaf& from) {
        const int h = lane_of_all / width<S>, k = lane_of_all % width<S>;
        SingleRay<S> single{lane_of(rays[h], k), lane(best[h].t, k), lane(best[h].surface, k)};
        const auto look_single = [&](const Leaf& leaf) {
            calls<S>(leaf.form()).intersect_single(world, leaf.first, leaf.count(), single);
            return false;
        };
        if (from.code != 0)
            look_single(from);
        else
            traverse_single<true>(world.nodes, from.first, lane_of(line, lane_of_all), single.t, look_single);
        best[h].t = with_lane(best[h].t, k, single.t);
        best[h].surface = with_lane(best[h].surface, k, single.surface);
        set_limit();
    });
}

/// Returns the bins of surfaces that were met outside the hot loops.
template <class S>
STRAHL_INLINE S bins_of(const World<Element<S>>& world, const S& surface) {
    using T = Element<S>;
    if (world.loop_count == 0 && world.hierarchy_bin >= 0) return S(static_cast<T>(world.hierarchy_bin));
    alignas(64) T surfaces[width<S>], bins[width<S>];
    store_lanes(surfaces, surface);
    for (int k = 0; k < width<S>; ++k) bins[k] = static_cast<T>(world.references[static_cast<int>(surfaces[k])].bin);
    return load_lanes<S>(bins);
}

/// Finds the nearest surfaces of all bodies outside the hot loops, for packs that traverse the hierarchy together. Kept
/// out of line: inlined, it would slow down small worlds.
template <class S>
[[gnu::noinline]] void nearest_beyond_loops(const World<Element<S>>& world, const Ray<S> (&rays)[together<S>],
                                            const Mask<S> (&active)[together<S>], BodySet set,
                                            Nearest<S> (&best)[together<S>]) {
    S before[together<S>];
    for (int h = 0; h < together<S>; ++h) {
        before[h] = best[h].surface;
        if (world.bin_per_item) {
            nearest_of_cold(world, rays[h], active[h], set, best[h]);
            continue;
        }
        each_cold_range(world, set, [&](const ItemRange& items, int) {
            calls<S>(items.form).intersect(world, items.first, items.count, rays[h], active[h], best[h]);
            return false;
        });
    }
    if (world.nodes) nearest_in_hierarchy(world, rays, active, best);
    for (int h = 0; h < together<S>; ++h)
        best[h].bin = select(best[h].surface == before[h], best[h].bin, bins_of(world, best[h].surface));
}

/// Searches the hot items again, more closely, for the rays that rounding seems to have put inside an opaque body: the
/// hot loops only mark them (`suspects`).
template <class S>
[[gnu::noinline]] void nearest_again(const World<Element<S>>& world, const Ray<S>& ray, Mask<S> suspects, BodySet set,
                                     Nearest<S>& best) {
    using T = Element<S>;
    Nearest<S> found;
    found.bin = S(static_cast<T>(world.bins));
    each_hot_item(world, set, [&](const auto& group, int i) {
        const S before = found.surface;
        FormFunctions<FormOf<decltype(group)>, S>::intersect(world, i, 1, ray, suspects, found);
        const int bin = world.bin_per_item ? group.first_bin + i : group.first_bin;
        found.bin = select(found.surface == before, found.bin, S(static_cast<T>(bin)));
        return false;
    });
    best.t = select(suspects, found.t, best.t);
    best.surface = select(suspects, found.surface, best.surface);
    best.bin = select(suspects, found.bin, best.bin);
}

/// Finds the nearest surfaces of hot items; if each item has a bin, among the bodies of the set.
template <class S>
STRAHL_INLINE Nearest<S> nearest_in_loops(const World<Element<S>>& world, const Ray<S>& ray, Mask<S> active,
                                          BodySet set) {
    using T = Element<S>;
    Nearest<S> best;
    best.bin = S(static_cast<T>(world.bins));
    Mask<S> suspects = first_lanes<S>(0);
    const auto note = [&](const Span<S>&, Mask<S> exits) __attribute__((always_inline)) {
        suspects = suspects | exits;
        return first_lanes<S>(0);
    };
    each_hot_item(
        world, set, [&](const auto& group, int i) __attribute__((always_inline)) {
            const auto& item = group.items[i];
            const Mask<S> better = intersect_item(world, item, crossings_of(item, ray, active), active, best, note);
            const int bin = world.bin_per_item ? group.first_bin + i : group.first_bin;
            best.bin = select(better, S(static_cast<T>(bin)), best.bin);
            return false;
        });
    if (any(suspects)) [[unlikely]] {
        Nearest<S> copy = best;
        nearest_again(world, Ray<S>(ray), suspects, set, copy);
        best = copy;
    }
    return best;
}

/// Finds the nearest surfaces.
template <class S>
STRAHL_INLINE Nearest<S> nearest(const World<Element<S>>& world, const Ray<S>& ray, Mask<S> active, BodySet set) {
    Nearest<S> best = nearest_in_loops(world, ray, active, set);
    if (world.beyond_loops) {  // works on copies, so that in small worlds all stays in registers
        Ray<S> rays[together<S>];
        Mask<S> lanes[together<S>];
        Nearest<S> copies[together<S>];
        for (int h = 0; h < together<S>; ++h)
            rays[h] = ray, lanes[h] = h == 0 ? active : first_lanes<S>(0), copies[h] = best;
        nearest_beyond_loops(world, rays, lanes, set, copies);
        best = copies[0];
    }
    return best;
}

/// Lets rays start `way` further on, in the lanes of `close`, as if on `source`, and finds the nearest surfaces from
/// there.
template <class S>
[[gnu::noinline]] void pass_over(const World<Element<S>>& world, const S& way, Mask<S> close, const S& source,
                                 Ray<S>& ray, Nearest<S>& best) {
    for (int c = 0; c < 3; ++c) ray.origin[c] = select(close, fma(way, ray.direction[c], ray.origin[c]), ray.origin[c]);
    ray.source = select(close, source, ray.source);
    const Nearest<S> behind = nearest(world, ray, close, ~BodySet(0));
    best.t = select(close, behind.t, best.t);
    best.surface = select(close, behind.surface, best.surface);
    best.bin = select(close, behind.bin, best.bin);
}

/// Attenuates light by the bodies in the hierarchy. `line` is the ray in the form for boxes.
template <class S>
STRAHL_INLINE void occlude_in_hierarchy(const World<Element<S>>& world, const Ray<S>& ray, const TraversalRay<S>& line,
                                        const S& distance, Mask<S> active, Transmission<S>& light) {
    using T = Element<S>;
    const auto look = [&](const Leaf& leaf, Mask<S> mask) {
        return calls<S>(leaf.form()).occlude(world, leaf.first, leaf.count(), ray, distance, mask, light);
    };
    const auto single = [&](int k, const Leaf& from) {
        SingleRay<S> one{.ray = lane_of(ray, k), .t = lane(distance, k), .notes = light.notes, .lane = k};
        if (world.transparent)
            for (int c = 0; c < 3; ++c) one.share[c] = lane(light.share[c], k);
        const T limit = lane(light.limit, k);
        bool dark = false;
        const auto look_single = [&](const Leaf& leaf) {
            return dark = calls<S>(leaf.form()).occlude_single(world, leaf.first, leaf.count(), one);
        };
        if (from.code != 0)
            look_single(from);
        else
            traverse_single<false>(world.nodes, from.first, lane_of(line, k), limit, look_single);
        light.limit = with_lane(light.limit, k, dark ? T(-1) : limit);
        if (world.transparent)
            for (int c = 0; c < 3; ++c) light.share[c] = with_lane(light.share[c], k, one.share[c]);
    };
    traverse<false>(world.nodes, line, active, light.limit, look, single);
}

/// Bounds where rays to a parallel light start: in the coordinates of its axes by ranges that rounding does not leave,
/// and towards it from below. Of other lights `shadows` is null, and no more is known.
template <class S>
struct StartAcross {
    const ParallelShadows<Element<S>>* shadows = nullptr;
    S u_low, u_high, v_low, v_high, along;

    /// Returns the rays that start in the shadows whose numbers `at` takes from their columns.
    template <class At>
    STRAHL_INLINE Mask<S> shadowed(const At& at) const {
        return !((u_high < at(shadows->left)) | (u_low > at(shadows->right)) | (v_high < at(shadows->bottom)) |
                 (v_low > at(shadows->top)) | (along > at(shadows->end)));
    }
    /// Returns the bodies in whose shadow a ray may start, of the first ones by their bins.
    STRAHL_INLINE BodySet bodies(Mask<S> active, int count) const {
        const auto lowest = [&](const S& s) {
            return S(least(select(active, s, S(std::numeric_limits<Element<S>>::infinity()))));
        };
        const StartAcross all{shadows, lowest(u_low), -lowest(-u_high), lowest(v_low), -lowest(-v_high), lowest(along)};
        BodySet set = 0;
        for (int i = 0; i < count; i += width<S>)
            set |= BodySet(bits(all.shadowed([i](const auto& column) { return load_lanes<S>(column.data() + i); })))
                   << i;
        return set;
    }
};
/// Finds these bounds; null shadows where items have no bins of their own.
template <class S>
STRAHL_INLINE StartAcross<S> start_across(const World<Element<S>>& world, const Ray<S>& ray, const Start<S>& start) {
    const LightKernel<Element<S>>& light = world.lights[start.light];
    if (!world.bin_per_item || light.finite != 0 || light.area) return {};
    const S u = dot(splat<S>(light.u), ray.origin), v = dot(splat<S>(light.v), ray.origin);
    const S along = dot(splat<S>(light.position), ray.origin);
    const S off = (abs(u) + abs(v) + abs(along)) * S(16 * std::numeric_limits<Element<S>>::epsilon());
    return {&world.few.shadows[start.light], u - off, u + off, v - off, v + off, along - off};
}

/// Returns the rays in whose way the body of a bin can be.
template <class S>
STRAHL_INLINE Mask<S> reached(const World<Element<S>>& world, int bin, const Ray<S>& ray, const S& distance,
                              Mask<S> active, const Start<S>& start, const StartAcross<S>& across) {
    const int number = start.light * world.bins + bin;
    Mask<S> mask = active;
    if (across.shadows) {
        mask = mask & across.shadowed([bin](const auto& column) { return S(column[bin]); });
    } else {
        const LightCone<Element<S>>& cone = world.few.cones[number];
        mask = mask & (dot(splat<S>(cone.axis), ray.direction) <= S(-cone.cosine));
        if (!start.ends_early) mask = mask & (distance > S(cone.distance));
    }
    if (bin == start.bin && (world.few.convex >> bin & 1)) mask = mask & !start.outside;
    return mask;
}

/// Attenuates light by all bodies outside the hot loops.
template <class S>
[[gnu::noinline]] void occlude_beyond_loops(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                            Mask<S> active, const Start<S>& start, BodySet set,
                                            Transmission<S>& light) {
    bool dark = false;
    const StartAcross<S> across = start_across(world, ray, start);
    const TraversalRay<S> line = traversal_ray(ray);
    S near;
    each_cold_range(world, set, [&](const ItemRange& items, int bin) {
        Mask<S> mask = active & (light.limit > S(0));
        if (world.bin_per_item) mask = reached(world, bin, ray, distance, mask, start, across);
        if (world.bin_per_item && any(mask)) mask = mask & crosses_body(world, bin, line, distance, near);
        if (none(mask)) return false;
        return dark = calls<S>(items.form).occlude(world, items.first, items.count, ray, distance, mask, light);
    });
    if (!world.nodes || dark) return;
    Mask<S> left = light.limit > S(0);
    if (world.light_buffers && world.light_buffers[start.light].faces && !start.ends_early) {
        left = LightBufferCalls<S>::occlude(world, start.light, ray, distance, light);
        if (none(left)) return;
    }
    occlude_in_hierarchy(world, ray, line, distance, left, light);
}

/// Tests the hot items more closely for rays that rounding seems to have put inside an opaque body; dims their light.
template <class S>
[[gnu::noinline]] void occlude_again(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                     Mask<S> suspects, const Start<S>& start, BodySet set, Transmission<S>& light) {
    const S one(1);
    Transmission<S> left{{one, one, one}, select(suspects, distance, S(-1))};
    const StartAcross<S> across = start_across(world, ray, start);
    each_hot_item(world, set, [&](const auto& group, int i) {
        const Mask<S> mask =
            world.bin_per_item ? reached(world, group.first_bin + i, ray, distance, suspects, start, across) : suspects;
        return FormFunctions<FormOf<decltype(group)>, S>::occlude(world, i, 1, ray, distance, mask, left);
    });
    light.share = select(suspects, left.share, light.share), light.limit = select(suspects, left.limit, light.limit);
}

/// Returns the share of light that is transmitted by all bodies in its way, and notes what the rays meet if `noting`:
/// the code for other rays is apart, so that it is not slower.
template <bool noting = false, class S>
[[gnu::noinline]] Vec3<S> visibility_of_all(const World<Element<S>>& world, const Ray<S>& ray, const S& distance,
                                            Mask<S> active, const Start<S>& start, ShadowNotes<S>* notes = nullptr) {
    const S one(1);
    Transmission<S> light{{one, one, one}, select(active, distance, S(-1)), noting ? notes : nullptr};
    BodySet set = world.bin_per_item ? world.few.occluders[start.light * world.bins + start.bin] & start.only : 0;
    bool dark = false;
    const StartAcross<S> across = start_across(world, ray, start);
    if (across.shadows) set &= across.bodies(active, world.bins);
    Mask<S> suspects = first_lanes<S>(0);
    const auto note = [&](const Span<S>&, Mask<S> exits) __attribute__((always_inline)) {
        suspects = suspects | exits;
        return first_lanes<S>(0);
    };
    each_hot_item(
        world, set, [&](const auto& group, int i) __attribute__((always_inline)) {
            Mask<S> mask = active;
            if (world.bin_per_item) {
                mask = reached(world, group.first_bin + i, ray, distance, active, start, across);
                if (none(mask)) return false;
            }
            const auto& item = group.items[i];
            return dark = occlude_item(world, item, ray, crossings_of(item, ray, mask), distance, mask, light, note);
        });
    if (any(suspects)) [[unlikely]] {
        Transmission<S> copy = light;
        occlude_again(world, Ray<S>(ray), S(distance), suspects, start, set, copy);
        light = copy;
        dark = all(light.limit < S(0));
    }
    if (world.beyond_loops && !dark) {
        Transmission<S> copy = light;
        occlude_beyond_loops(world, ray, distance, active, start, set, copy);
        light = copy;
    }
    if constexpr (noting) notes->closed = (light.limit < S(0)) & !notes->opened;
    return select(light.limit < S(0), Vec3<S>(S(0), S(0), S(0)), light.share);
}

/// Returns the rays that lose light.
template <class S>
Mask<S> dimmed(const Vec3<S>& share) {
    return Mask<S>((share.x < S(1)) | (share.y < S(1)) | (share.z < S(1)));
}

/// Finds the light of these rays once more without the bodies that are passed over, if there are any.
template <class S>
[[gnu::noinline]] void look_past(const World<Element<S>>& world, const Ray<S>& ray, const S& distance, Mask<S> lanes,
                                 const Start<S>& start, Vec3<S>& share) {
    if (none(lanes)) return;
    const S way(world.passed_in_shadows);
    Start<S> near = start;
    near.ends_early = true;
    const Mask<S> close = lanes & dimmed(visibility_of_all(world, ray, min(distance, way), lanes, near));
    if (none(close)) return;
    Ray<S> behind{ray.origin, ray.direction, S(-1)};
    for (int c = 0; c < 3; ++c) behind.origin[c] = fma(way, ray.direction[c], ray.origin[c]);
    share = select(close, visibility_of_all(world, behind, max(distance - way, S(0)), close, start), share);
}

/// Returns the shadow rays that end before their light.
template <class S>
STRAHL_INLINE Mask<S> ends_before(const World<Element<S>>& world, const S& distance) {
    return (distance > S(world.farthest)) & (distance < S(std::numeric_limits<Element<S>>::infinity()));
}

/// Returns up to where bodies are in the way of a light: not quite to the light, so that one on a surface shines away
/// from it, as in POV-Ray, whichever side rounding leaves it on; and as far as rays see anything, unless the light is
/// infinitely far away.
template <class S>
STRAHL_INLINE S way_before_light(const World<Element<S>>& world, const Ray<S>& ray, const S& distance) {
    const S share(world.around_lights);
    const S way = (S(1) - share) * distance - share * (abs(ray.origin.x) + abs(ray.origin.y) + abs(ray.origin.z));
    return select(ends_before(world, distance), S(world.farthest), way);
}

/// Returns the share of light that is transmitted, by shadow rays of other ways than the whole at once
/// (kernel/faded_light.h).
template <class S>
Vec3<S> visibility_by_parts(const World<Element<S>>& world, const Ray<S>& ray, const S& distance, Mask<S> active,
                            const Start<S>& start);

/// Returns the share of light that is transmitted, see Visibility.
template <class S>
STRAHL_INLINE Vec3<S> visibility(const World<Element<S>>& world, const Ray<S>& ray, const S& distance, Mask<S> active,
                                 const Start<S>& start) {
    if (world.shadow_rays == ShadowRays::whole) [[likely]]
        return visibility_of_all(world, ray, distance, active, start);
    return visibility_by_parts(world, ray, distance, active, start);
}

}  // namespace strahl::inline STRAHL_LEVEL
