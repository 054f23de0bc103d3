// The interface of a form's items, called through a table: compiled once per form, precision and SIMD level.
#pragma once
#include <algorithm>
#include <array>
#include <utility>

#include "trace/forms/items_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// One ray, the same in all lanes, whose items are tested side by side. `t` and `surface` are those of the nearest hit
/// so far; or, for shadow rays, `t` is the distance of the light and `share` what is left of it. What they meet is
/// noted in this lane of `notes`, if there are any.
template <class S>
struct SingleRay {
    using T = Element<S>;
    Ray<S> ray;
    T t;
    T surface = -1;
    Vec3<T> share{1};
    ShadowNotes<S>* notes = nullptr;
    int lane = 0;

    Mask<S> own_lane() const { return mask_of<S>(1u << lane); }
};

/// The spans of rays in a leaf of a composite, from near to far: one or two. An empty one is from infinity to
/// -infinity.
template <class S>
struct LeafEnds {
    S near[2], far[2], near_face, far_face;
    int pairs;
    int list;  // number of the list, for a leaf whose crossings are listed
};

/// Lists where rays cross the triangles of a mesh, or a body whose crossings are listed, beyond some distance: the
/// nearest places, ascending, at infinity if there are fewer, each with the least number of the surfaces there.
template <class S>
struct MeshCrossings {
    using T = Element<S>;
    static constexpr int most = 8;
    alignas(64) T t[most][width<S>], surface[most][width<S>];
    unsigned odd[most];   // by lane, whether the number of triangles there is odd
    unsigned odd_in_all;  // by lane, the same for all triangles tested, however far

    /// Forgets all.
    void clear() {
        for (int k = 0; k < most; ++k) store_lanes(t[k], S(std::numeric_limits<T>::infinity())), odd[k] = 0;
        odd_in_all = 0;
    }
    /// Forgets what the lanes of the mask hold.
    void clear(Mask<S> lanes) {
        for (int k = 0; k < most; ++k) {
            store_lanes(t[k], select(lanes, S(std::numeric_limits<T>::infinity()), load_lanes<S>(t[k])));
            odd[k] &= ~bits(lanes);
        }
        odd_in_all &= ~bits(lanes);
    }
    /// Adds a crossing of the ray of a lane.
    void add(int lane, T place, T own) {
        odd_in_all ^= 1u << lane;
        unsigned own_odd = 1u << lane;
        for (int k = 0; k < most; ++k) {  // what is further off moves on
            const T here = t[k][lane];
            if (here < place) continue;
            if (here == place) {
                surface[k][lane] = std::min(own, surface[k][lane]), odd[k] ^= own_odd;
                return;
            }
            const unsigned odd_here = odd[k] & 1u << lane;
            odd[k] ^= odd_here ^ own_odd, own_odd = odd_here;
            t[k][lane] = place, place = here;
            std::swap(surface[k][lane], own);
            if (!(place < std::numeric_limits<T>::infinity())) return;
        }
    }
};

/// Returns the ray of one lane in all lanes.
template <class S>
STRAHL_INLINE Ray<S> lane_of(const Ray<S>& ray, int k) {
    const auto pick = [k](const Vec3<S>& v) { return Vec3<S>(S(lane(v.x, k)), S(lane(v.y, k)), S(lane(v.z, k))); };
    return {pick(ray.origin), pick(ray.direction), S(lane(ray.source, k))};
}

/// Loads item i of a leaf and those after it, one in each lane. `first` and `count` are the leaf's.
template <class S, class Group>
STRAHL_INLINE auto load_of_leaf(const Group& group, int first, int count, int i) {
    constexpr std::size_t fields = sizeof(group.items[0]) / sizeof(group.columns[0]);
    return load_items<typename Group::template ItemOf<S>, S>(group.columns + first * fields, count, i - first);
}

template <class Form, class S>
struct FormFunctions {
    using T = Element<S>;
    /// Finds where a pack of rays meets the items, and keeps what is nearer than `best`.
    static void intersect(const World<T>& world, int first, int count, const Ray<S>& ray, Mask<S> mask,
                          Nearest<S>& best);
    /// Does the same for one ray that is in all lanes, with the items of a leaf side by side.
    static void intersect_single(const World<T>& world, int first, int count, SingleRay<S>& single);
    /// Attenuates light by the items. Returns true if none is left in any lane.
    static bool occlude(const World<T>& world, int first, int count, const Ray<S>& ray, const S& distance, Mask<S> mask,
                        Transmission<S>& light);
    /// Does the same for one ray, items side by side. Returns true if no light is left.
    static bool occlude_single(const World<T>& world, int first, int count, SingleRay<S>& single);
    /// Finds the points at distance `t` where rays first meet items, one in each lane, and the items' materials.
    /// `faces` is -1 where rays meet items by themselves, else the face of the leaf of a composite.
    static void surfaces_at(const World<T>& world, const int* items, const Ray<S>& ray, const S& t, const S& faces,
                            SurfaceHit<S>& hit, int* materials);
    /// Finds the spans of rays in a leaf of a composite.
    static void ends(const World<T>& world, int item, const Ray<S>& ray, LeafEnds<S>& ends);
    /// Lists the nearest places beyond `place` where rays cross a leaf of a composite whose crossings are listed, up to
    /// `limit`; further ones may be missing. In the lanes of `all` every crossing beyond `place` is counted.
    static void list_crossings(const World<T>& world, const CompositeLeaf& leaf, const Ray<S>& ray, Mask<S> lanes,
                               const S& place, const S& limit, Mask<S> all, MeshCrossings<S>& found);
    // The two below are never called for hot forms: see if_hot(). Only convex forms have the second.
    /// Finds the points at distance `t` where rays first meet an item, the same for all.
    static void surface_at(const World<T>& world, int item, const Ray<S>& ray, const S& t, SurfaceHit<S>& hit);
    /// Returns where rays that start on an item leave it.
    static Span<S> span(const World<T>& world, int item, const Ray<S>& ray);

  private:
    static Mask<S> outside(const World<T>& world, int item, const Ray<S>& ray, const Span<S>& span, Mask<S> inside);
    static Mask<S> outside_each(const World<T>& world, int first, const Ray<S>& ray, const Span<S>& span,
                                Mask<S> inside);
    /// Returns the lanes in which the eye is in an item, found along the direction of the ray.
    static Mask<S> holds_eye(const World<T>& world, int item, const Ray<S>& ray);
    /// Finds again, closely, where rays cross an item (`step` 0), or one ray items side by side (`step` 1), in lanes
    /// whose rays start near its plane on a triangle beside it.
    static void settle(const World<T>& world, const Item<Form, T>* items, int step, const Ray<S>& ray, Mask<S> near,
                       Span<S>& span);
    static void note(SingleRay<S>& single, const auto& crossings, const auto& span, int n, bool clear);
    static void settle_start(const World<T>& world, int first, int step, const auto& item, const Ray<S>& ray,
                             Mask<S> lanes, auto& crossed);
    // The kernel's own code stands in each of the above if the form is hot, else only in these three.
    using Crossed = CrossingsOf<S, Item<Form, T>>;
    static Crossed cross_one(const Item<Form, T>& item, const Ray<S>& ray, Mask<S> lanes);
    static Crossed cross_each(const Item<Form, S>& items, const Ray<S>& ray, Mask<S> lanes);
    static void hit_each(const Item<Form, S>& items, const Ray<S>& ray, const S& t, const S& faces, SurfaceHit<S>& hit);
};

/// Answers the queries of a single ray by those of a pack, in which it is the only one.
template <class Functions, class S>
struct SingleByPack {
    using T = Element<S>;
    static void intersect_single(const World<T>& world, int first, int count, SingleRay<S>& single) {
        Nearest<S> best;
        best.t = S(single.t), best.surface = S(single.surface);
        Functions::intersect(world, first, count, single.ray, first_lanes<S>(1), best);
        single.t = lane(best.t, 0), single.surface = lane(best.surface, 0);
    }
    static bool occlude_single(const World<T>& world, int first, int count, SingleRay<S>& single) {
        ShadowNotes<S> met(single.notes ? single.notes->near : T(0));
        Transmission<S> light{splat<S>(single.share), select(first_lanes<S>(1), S(1), S(-1)),
                              single.notes ? &met : nullptr};
        const bool dark = Functions::occlude(world, first, count, single.ray, S(single.t), first_lanes<S>(1), light);
        for (int c = 0; c < 3; ++c) single.share[c] = lane(light.share[c], 0);
        if (!single.notes) return dark;
        for (int i = 0; i < met.count; ++i) single.notes->add_clear(single.own_lane(), S(lane(met.t[i], 0)));
        single.notes->incomplete |= met.incomplete;
        if (any(met.opened)) single.notes->opened = single.notes->opened | single.own_lane();
        if (any(met.dark)) single.notes->dark = single.notes->dark | single.own_lane();
        return dark;
    }
};

/// Pointers to these functions, for a form that is known by its number.
template <class S>
struct FormCalls {
    using W = World<Element<S>>;
    void (*intersect)(const W&, int, int, const Ray<S>&, Mask<S>, Nearest<S>&);
    void (*intersect_single)(const W&, int, int, SingleRay<S>&);
    bool (*occlude)(const W&, int, int, const Ray<S>&, const S&, Mask<S>, Transmission<S>&);
    bool (*occlude_single)(const W&, int, int, SingleRay<S>&);
    void (*surfaces_at)(const W&, const int*, const Ray<S>&, const S&, const S&, SurfaceHit<S>&, int*) = nullptr;
    void (*ends)(const W&, int, const Ray<S>&, LeafEnds<S>&) = nullptr;
    void (*list_crossings)(const W&, const CompositeLeaf&, const Ray<S>&, Mask<S>, const S&, const S&, Mask<S>,
                           MeshCrossings<S>&) = nullptr;
    void (*surface_at)(const W&, int, const Ray<S>&, const S&, SurfaceHit<S>&) = nullptr;
    Span<S> (*span)(const W&, int, const Ray<S>&) = nullptr;
};
/// The calls of a kind's forms, compiled apart from the kernel.
template <class Kind, class S>
struct KindCalls {
    static constexpr std::size_t forms = std::tuple_size_v<typename Kind::template Kernels<Element<S>>>;
    static const std::array<FormCalls<S>, forms> calls;
};
template <class S, class Forms>
struct FormTable;
template <class S, class... F>
struct FormTable<S, FormList<F...>> {
    static constexpr const FormCalls<S>* calls[]{KindCalls<typename F::Kind, S>::calls.data() + F::number...};
};
template <class S>
STRAHL_INLINE const FormCalls<S>& calls(int form) {
    return *FormTable<S, Forms>::calls[form];
}
/// Calls visit(group) if the form is hot. Returns true if it is.
template <class T, class Visit>
STRAHL_INLINE bool if_hot(const World<T>& world, int form, const Visit& visit) {
    int number = 0;
    bool hot = false;
    world.groups.each([&](const auto& group) __attribute__((always_inline)) {
        if constexpr (std::remove_cvref_t<decltype(group)>::Form::hot)
            if (number == form) visit(group), hot = true;
        ++number;
    });
    return hot;
}

}  // namespace strahl::inline STRAHL_LEVEL
