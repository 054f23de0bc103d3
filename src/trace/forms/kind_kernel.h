// The code of a kind's forms. For each SIMD level kernels.cmake makes one file that instantiates this for all kinds:
// reading the headers takes half as long as compiling a kind, so each level reads them once.
#pragma once
#include "trace/forms/form_kernel.h"
#include "trace/hierarchy/traverse.h"
#include "trace/patterns/triangle_of.h"

namespace strahl::inline STRAHL_LEVEL {

/// Does a form belong to meshes?
template <class Form>
inline constexpr bool of_triangles = Form::compact && !Form::hot;

/// Returns what all triangles need to know of rays, which is found once for the items of a leaf; nothing for others.
template <class Form, class S>
STRAHL_INLINE auto line_of(const Ray<S>& ray) {
    if constexpr (of_triangles<Form>)
        return LineFrame<S>(ray.direction);
    else
        return nullptr;
}
/// Returns an item's crossings: by inlined code if the form is compact, else by a call.
template <class Form, class S, class Item>
STRAHL_INLINE auto cross(const Item& item, const Ray<S>& ray, const auto& line, Mask<S> lanes,
                         CrossingsOf<S, Item> (*call)(const Item&, const Ray<S>&, Mask<S>)) {
    if constexpr (of_triangles<Form>)
        return item.shape.span(line, ray, ray.source - S(item.surface));
    else if constexpr (Form::compact)
        return crossings_of(item, ray, lanes);
    else
        return call(item, ray, lanes);
}
template <class Form, class S>
[[gnu::noinline]] auto FormFunctions<Form, S>::cross_one(const Item<Form, T>& item, const Ray<S>& ray, Mask<S> lanes)
    -> Crossed {
    return crossings_of(item, ray, lanes);
}
template <class Form, class S>
[[gnu::noinline]] auto FormFunctions<Form, S>::cross_each(const Item<Form, S>& items, const Ray<S>& ray, Mask<S> lanes)
    -> Crossed {
    return crossings_of(items, ray, lanes);
}
template <class Form, class S>
[[gnu::noinline]] void FormFunctions<Form, S>::hit_each(const Item<Form, S>& items, const Ray<S>& ray, const S& t,
                                                        const S& faces, SurfaceHit<S>& hit) {
    hit = surface_hit(items, ray, t, cross_each, &faces);
}

/// Replaces the crossing of triangles beside the one that a ray starts on, see crossing_beside.
template <class Form, class S>
[[gnu::noinline]] void FormFunctions<Form, S>::settle(const World<T>& world, const Item<Form, T>* items, int step,
                                                      const Ray<S>& ray, Mask<S> near, Span<S>& span) {
    for (unsigned left = bits(near); left; left &= left - 1) {
        const int k = std::countr_zero(left);
        const TriangleKernel<T>* const start = triangle_of(world, static_cast<int>(lane(ray.source, k)));
        const TriangleKernel<T>& other = flat(items[k * step].shape);
        if (!start || !share_a_corner(*start, other)) continue;
        const auto pick = [k](const Vec3<S>& v) { return Vec3<T>(lane(v.x, k), lane(v.y, k), lane(v.z, k)); };
        const Ray<T> one{pick(ray.origin), pick(ray.direction), lane(ray.source, k)};
        span.far = with_lane(span.far, k, crossing_beside(*start, other, one));
    }
}
/// Looks closely at triangles beside the one that a ray starts on. Lanes that hold no item must not be in `lanes`.
template <class Form, class S>
STRAHL_INLINE void FormFunctions<Form, S>::settle_start(const World<T>& world, int first, int step, const auto& item,
                                                        const Ray<S>& ray, Mask<S> lanes, auto& crossed) {
    if constexpr (requires { item.shape.starts_near(ray, crossed.far, crossed.far); }) {
        lanes = lanes & crossed.hit & (ray.source >= S(0));
        if (none(lanes)) return;
        const Mask<S> near = lanes & item.shape.starts_near(ray, crossed.far, S(world.rounding));
        if (any(near)) [[unlikely]]
            settle(world, &world.groups.template get<Form>().items[first], step, ray, near, crossed);
    }
}

template <class Form, class S>
[[gnu::noinline]] Mask<S> FormFunctions<Form, S>::holds_eye(const World<T>& world, int item, const Ray<S>& ray) {
    // Camera rays may start elsewhere: those of an orthographic camera do.
    const Ray<S> from_eye{select(ray.source < S(0), ray.origin, splat<S>(world.eye)), ray.direction, S(-1)};
    const Span<S> span = cross<Form>(world.groups.template get<Form>().items[item], from_eye, line_of<Form>(from_eye),
                                     all_lanes<S>(), cross_one);
    return span.hit & (span.near <= S(0)) & (span.far > S(0));
}
/// Returns which rays only seem to start in an opaque convex body, because of rounding: rays get into such a body only
/// with the eye. If the start is nearer to where the ray leaves than to where it entered, it is on another surface, in
/// the same place but for rounding and outside, and the ray goes away from the body.
template <class Form, class S>
STRAHL_INLINE Mask<S> FormFunctions<Form, S>::outside(const World<T>& world, int item, const Ray<S>& ray,
                                                      const Span<S>& span, Mask<S> inside) {
    if (none(inside)) [[likely]]
        return inside;
    const Mask<S> leaving = inside & (span.near + span.far < S(0));
    if (none(leaving)) return leaving;
    return leaving & !holds_eye(world, item, ray);
}
/// Returns what `outside` does for items side by side, one in each lane, which may be transparent.
template <class Form, class S>
STRAHL_INLINE Mask<S> FormFunctions<Form, S>::outside_each(const World<T>& world, int first, const Ray<S>& ray,
                                                           const Span<S>& span, Mask<S> inside) {
    if (none(inside)) [[likely]]
        return inside;
    const Mask<S> leaving = inside & (span.near + span.far < S(0));
    if (none(leaving)) return leaving;
    T outside[width<S>] = {};
    for (unsigned left = bits(leaving); left; left &= left - 1) {
        const int k = std::countr_zero(left);
        const auto& item = world.groups.template get<Form>().items[first + k];
        if (!transparent(world, item) && none(holds_eye(world, first + k, ray))) outside[k] = 1;
    }
    return load_lanes<S>(outside) > S(0);
}

template <class Form, class S>
void FormFunctions<Form, S>::intersect(const World<T>& world, int first, int count, const Ray<S>& ray, Mask<S> mask,
                                       Nearest<S>& best) {
    const auto& group = world.groups.template get<Form>();
    const auto line = line_of<Form>(ray);
    for (int i = first; i < first + count; ++i) {
        const auto& item = group.items[i];
        auto crossed = cross<Form>(item, ray, line, mask, cross_one);
        settle_start(world, i, 0, item, ray, mask, crossed);
        intersect_item(world, item, crossed, mask, best,
                       [&](const auto& span, Mask<S> exits) { return outside(world, i, ray, span, exits); });
    }
}

template <class Form, class S>
void FormFunctions<Form, S>::intersect_single(const World<T>& world, int first, int count, SingleRay<S>& single) {
    const auto& group = world.groups.template get<Form>();
    const Ray<S>& ray = single.ray;
    const auto line = line_of<Form>(ray);
    for (int i = first; i < first + count; i += width<S>) {
        const auto item = load_of_leaf<S>(group, first, count, i);
        const S surface = item.surface;
        const Mask<S> items = first_lanes<S>(first + count - i);
        auto span = cross<Form>(item, ray, line, items, cross_each);
        settle_start(world, i, 1, item, ray, items, span);
        const S t = first_crossing(span);
        Mask<S> better = span.hit & (t > S(0)) & items;
        better = better & closer(t, surface, S(single.t), S(single.surface));
        if constexpr (Item<Form, T>::has_exits)
            better = better & !outside_each(world, i, ray, span, better & !(span.near > S(0)));
        while (any(better)) {
            const int k = strahl::first(better);
            single.t = lane(t, k), single.surface = lane(surface, k);
            better = better & closer(t, surface, S(single.t), S(single.surface));
        }
    }
}

template <class Form, class S>
bool FormFunctions<Form, S>::occlude(const World<T>& world, int first, int count, const Ray<S>& ray, const S& distance,
                                     Mask<S> mask, Transmission<S>& light) {
    const auto& group = world.groups.template get<Form>();
    const auto line = line_of<Form>(ray);
    for (int i = first; i < first + count; ++i) {
        const auto& item = group.items[i];
        auto crossed = cross<Form>(item, ray, line, mask, cross_one);
        settle_start(world, i, 0, item, ray, mask, crossed);
        if (occlude_item(world, item, ray, crossed, distance, mask, light,
                         [&](const auto& span, Mask<S> exits) { return outside(world, i, ray, span, exits); }))
            return true;
    }
    return false;
}

/// Notes what a shadow ray meets: the crossings in lane n of these, of a body that lets light through or does not.
template <class Form, class S>
void FormFunctions<Form, S>::note(SingleRay<S>& single, const auto& crossings, const auto& span, int n, bool clear) {
    const Mask<S> own = single.own_lane();
    if constexpr (!Form::Kind::closed)
        if (!clear) single.notes->opened = single.notes->opened | own;
    for (std::size_t k = 0; k < (clear ? crossings.size() : surely<Item<Form, T>>(crossings.size())); ++k) {
        if (!(crossings[k] >> n & 1)) continue;
        const S t(lane(crossing(span, static_cast<int>(k)), n));
        clear ? single.notes->add_clear(own, t) : single.notes->add_opaque(own, t);
    }
}
template <class Form, class S>
bool FormFunctions<Form, S>::occlude_single(const World<T>& world, int first, int count, SingleRay<S>& single) {
    const auto& group = world.groups.template get<Form>();
    const Ray<S>& ray = single.ray;
    const auto line = line_of<Form>(ray);
    const S distance(single.t);
    for (int i = first; i < first + count; i += width<S>) {
        const auto item = load_of_leaf<S>(group, first, count, i);
        const Mask<S> items = first_lanes<S>(first + count - i);
        auto span = cross<Form>(item, ray, line, items, cross_each);
        settle_start(world, i, 1, item, ray, items, span);
        auto crossed_by = crossed(span, span.hit & items, distance);
        if constexpr (Item<Form, T>::has_exits)
            crossed_by[1] = crossed_by[1] & !outside_each(world, i, ray, span, crossed_by[1] & !(span.near > S(0)));
        std::array<unsigned, crossed_by.size()> crossings;
        unsigned all = 0;
        for (std::size_t k = 0; k < crossings.size(); ++k) all |= crossings[k] = bits(crossed_by[k]);
        for (unsigned hits = all; hits; hits &= hits - 1) {
            const int n = std::countr_zero(hits);
            const bool clear = transparent(world, group.items[i + n]);
            if (single.notes) note(single, crossings, span, n, clear);
            if (!clear) return true;
            const int material = static_cast<int>(group.items[i + n].material);
            if (patterned(world, material)) [[unlikely]] {
                const Mask<S> own = first_lanes<S>(n + 1) & !first_lanes<S>(n);
                const S surface(group.items[i + n].surface);
                Vec3<S> share = splat<S>(single.share);
                for (std::size_t k = 0; k < crossings.size(); ++k)
                    FinishCalls<S>::filter(world, material, surface, ray, crossing(span, static_cast<int>(k)),
                                           own & crossed_by[k], share);
                for (int c = 0; c < 3; ++c) single.share[c] = lane(share[c], n);
                continue;
            }
            const Vec3<T> f = filter(world, group.items[i + n]);
            for (int c = 0; c < 3; ++c) {
                T kept = 1;
                for (const unsigned crossing : crossings) kept *= crossing >> n & 1 ? f[c] : T(1);
                single.share[c] = min(single.share[c] * kept, T(largest_gain));
            }
        }
    }
    return false;
}

template <class Form, class S>
void FormFunctions<Form, S>::surface_at(const World<T>& world, int item, const Ray<S>& ray, const S& t,
                                        SurfaceHit<S>& found) {
    hit_each(splat_item<Item<Form, S>, S>(world.groups.template get<Form>().items[item]), ray, t, S(-1), found);
}

template <class Form, class S>
void FormFunctions<Form, S>::surfaces_at(const World<T>& world, const int* items, const Ray<S>& ray, const S& t,
                                         const S& faces, SurfaceHit<S>& found, int* materials) {
    const auto& group = world.groups.template get<Form>();
    for (int k = 0; k < width<S>; ++k) materials[k] = static_cast<int>(group.items[items[k]].material);
    const auto own = gather_items<Item<Form, S>, S>(group.items, items);
    if constexpr (Form::hot)
        found = surface_hit(own, ray, t, crossings_of<S, Item<Form, S>>, &faces);
    else
        hit_each(own, ray, t, faces, found);
}

template <class Form, class S>
Span<S> FormFunctions<Form, S>::span(const World<T>& world, int item, const Ray<S>& ray) {
    static_assert(Form::Kind::convex);
    return cross_one(world.groups.template get<Form>().items[item], ray, all_lanes<S>());
}

template <class S>
STRAHL_INLINE void tell_ends(const Span<S>& span, LeafEnds<S>& ends) {
    constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
    ends.pairs = 1;
    ends.near[0] = select(span.hit, span.near, S(inf)), ends.far[0] = select(span.hit, span.far, S(-inf));
    ends.near_face = span.near_face, ends.far_face = span.far_face;
}
template <class S>
STRAHL_INLINE void tell_ends(const Crossings<S, 4>& crossings, LeafEnds<S>& ends) {
    constexpr auto inf = std::numeric_limits<Element<S>>::infinity();
    ends.pairs = 2;
    for (int k = 0; k < 2; ++k) {
        ends.near[k] = select(crossings.hit, crossings.t[2 * k], S(inf));
        ends.far[k] = select(crossings.hit, crossings.t[2 * k + 1], S(-inf));
    }
    ends.near_face = ends.far_face = S(0);
}
template <class Form, class S>
void FormFunctions<Form, S>::ends(const World<T>& world, int item, const Ray<S>& ray, LeafEnds<S>& ends) {
    const auto& own = world.groups.template get<Form>().items[item];
    tell_ends(cross<Form>(own, ray, line_of<Form>(ray), all_lanes<S>(), cross_one), ends);
}

template <class Form, class S>
void FormFunctions<Form, S>::list_crossings(const World<T>& world, const CompositeLeaf& mesh, const Ray<S>& ray,
                                            Mask<S> lanes, const S& place, const S& limit, Mask<S> all,
                                            MeshCrossings<S>& found) {
    const auto& group = world.groups.template get<Form>();
    const TraversalRay<S> line = traversal_ray(ray);
    for (unsigned left = bits(lanes); left; left &= left - 1) {
        const int k = std::countr_zero(left);
        const bool every = bits(all) >> k & 1;
        const T most = every ? std::numeric_limits<T>::infinity() : lane(limit, k);
        T end = most;
        const Ray<S> one = lane_of(ray, k);
        const auto line_of_one = line_of<Form>(one);
        const S from(lane(place, k));
        visit_leaves(mesh.nodes, lane_of(line, k), end, [&](int first, int count) {
            for (int i = first; i < first + count; i += width<S>) {
                const auto item = load_of_leaf<S>(group, first, count, i);
                const Mask<S> items = first_lanes<S>(first + count - i);
                auto crossed = cross<Form>(item, one, line_of_one, items, cross_each);
                settle_start(world, i, 1, item, one, items, crossed);
                unsigned hits = bits(items & crossed.hit & (crossed.far > from));
                if (!hits) continue;
                for (; hits; hits &= hits - 1) {
                    const int n = std::countr_zero(hits);
                    found.add(k, lane(crossed.far, n), lane(S(item.surface), n));
                }
                if (!every) end = std::min(most, found.t[found.most - 1][k]);
            }
        });
    }
}

/// Composites have the first four only: hits are on leaves, and shaded as those of their forms. Bodies that list
/// crossings, and shared meshes, are never alone in a bin, so that what is asked of one is not needed.
template <class Form, class S>
constexpr FormCalls<S> calls_of() {
    using Own = FormFunctions<Form, S>;
    FormCalls<S> calls{&Own::intersect, &Own::intersect_single, &Own::occlude, &Own::occlude_single};
    constexpr bool composite = std::is_same_v<typename Form::Kind, Union>, lists = lists_crossings<typename Form::Kind>;
    if constexpr (!composite) calls.surfaces_at = &Own::surfaces_at;
    if constexpr (lists || of_triangles<Form>) calls.list_crossings = &Own::list_crossings;
    if constexpr (std::is_same_v<typename Form::Kind, Prism>) calls.ends = &Own::ends;
    if constexpr (!composite && !lists && !std::is_same_v<Form, SharedMeshForm>) {
        if constexpr (Form::Kind::closed && Form::Kind::bounded) calls.ends = &Own::ends;
        if constexpr (!Form::hot) calls.surface_at = &Own::surface_at;
        if constexpr (!Form::hot && Form::Kind::convex) calls.span = &Own::span;
    }
    return calls;
}
template <class S, class... F>
constexpr std::array<FormCalls<S>, sizeof...(F)> calls_of_all(FormList<F...>) {
    return {{calls_of<F, S>()...}};
}
template <class Kind, class S>
const std::array<FormCalls<S>, KindCalls<Kind, S>::forms> KindCalls<Kind, S>::calls =
    calls_of_all<S>(FormsOfKind<Kind>{});

}  // namespace strahl::inline STRAHL_LEVEL
