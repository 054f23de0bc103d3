// Queries with error bounds on composites: what rays may meet of them, and what light they transmit.
#pragma once
#include "num/uninitialized.h"
#include "trace/proof/item_bounds.h"
#include "trace/proof/known_forms.h"

namespace strahl::inline STRAHL_LEVEL {

inline constexpr int composite_form = place_of<CompositeForm>(Forms{});

/// A leaf of a composite along a pack of rays: bounds of where they enter and leave it, where they do as computed, and
/// on which surfaces.
template <class S>
struct KnownLeaf {
    SpanBounds<S> span;
    S t[2], surface[2];
};

/// Bounds the span in a half-space, a body with one face, which rays enter or leave. A ray nearly parallel to the plane
/// does so far away, if at all, and is on one side until then.
template <class S, class K>
STRAHL_INLINE void cross_leaf(const PlaneKernel<K>& plane, const Ray<S>& ray, const Doubt<S>& doubt, const S& start,
                              const Slack<Element<S>>& slack, KnownLeaf<S>& leaf) {
    constexpr auto inf = SpanBounds<S>::inf;
    const SpanBounds<S> met = span_bounds(plane, ray, doubt, S(-1), slack);
    const Vec3<S> n = splat<S>(plane.normal);
    const S towards = dot(n, ray.direction), over = S(plane.distance) - dot(n, ray.origin);
    const Mask<S> slanted = met.sure, here = start == S(0), enters = towards < S(0), known = slanted | !here;
    const Mask<S> apart = (met.near_low > S(0)) & !(slanted | here), inside = apart & (over > S(0));
    const Mask<S> outside = apart & !inside;
    SpanBounds<S>& span = leaf.span;
    const Mask<S> in = (slanted & enters) | outside, out = inside | (slanted & !enters);
    const S low = select(here, S(-inf), met.near_low), high = select(here, S(-inf), met.near_high);
    span.near_low = select(in & known, low, S(-inf));
    span.near_high = select(in & known, high, select(out & known, S(-inf), S(inf)));
    span.far_low = select(out & known, select(here, S(-inf), met.near_low), S(-inf));
    span.far_low = select(in & known, S(inf), span.far_low);
    span.far_high = select(out & known, select(here, S(0), met.near_high), S(inf));
    span.maybe = first_lanes<S>(width<S>), span.sure = slanted | inside;
    leaf.t[0] = leaf.t[1] = over / towards;
}
template <class S, class K>
STRAHL_INLINE void cross_leaf(const K& kernel, const Ray<S>& ray, const Doubt<S>& doubt, const S& start,
                              const Slack<Element<S>>& slack, KnownLeaf<S>& leaf) {
    leaf.span = span_bounds(kernel, ray, doubt, start, slack);
    if (none(leaf.span.maybe)) return;
    const Span<S> crossed = kernel.span(ray, start);
    leaf.t[0] = crossed.near, leaf.t[1] = crossed.far;
    leaf.surface[0] = leaf.surface[0] + crossed.near_face, leaf.surface[1] = leaf.surface[1] + crossed.far_face;
}
/// Bounds the first span in a torus. Nothing is known of rays that start inside, since they may come back.
template <class S, class K>
requires requires(const K& torus, const Ray<S>& ray) { torus.crossings(ray, S(0)); }
STRAHL_INLINE void cross_leaf(const K& torus, const Ray<S>& ray, const Doubt<S>& doubt, const S& start,
                              const Slack<Element<S>>& slack, KnownLeaf<S>& leaf) {
    constexpr auto inf = SpanBounds<S>::inf;
    leaf.span = span_bounds(torus, ray, doubt, start, slack);
    if (none(leaf.span.maybe)) return;
    const Mask<S> starts_outside = leaf.span.near_low >= S(0);
    leaf.span.near_high = select(starts_outside, leaf.span.near_high, S(inf));
    leaf.span.far_low = select(starts_outside, leaf.span.far_low, S(-inf));
    leaf.span.far_high = S(inf);
    leaf.span.sure = leaf.span.sure & starts_outside;
    leaf.t[0] = leaf.t[1] = first_crossing(torus.crossings(ray, start));
}
template <class S, class Item>
[[gnu::noinline]] void cross_leaf_item(const Item& item, const DoubtfulRay<S>& own, const Slack<Element<S>>& slack,
                                       KnownLeaf<S>& leaf) {
    const S surface(item.surface);
    leaf.surface[0] = leaf.surface[1] = surface;
    cross_leaf(item.shape, own.ray, own.doubt, S(own.ray.source - surface), slack, leaf);
}

/// A composite of leaves whose errors are known, along a pack of rays. Where a leaf ends, the composite certainly
/// begins or ends, certainly goes on, or is undecided. A ray that starts on one leaf does not count as starting on
/// another: if that has a face in the same place, its end there is undecided.
template <class S>
class KnownComposite {
    using T = Element<S>;

  public:
    [[gnu::noinline]] KnownComposite(const World<T>& world, const CompositeInfo& composite, const DoubtfulRay<S>& own,
                                     const Slack<T>& slack)
        : world(world), composite(composite) {
        known = !composite.keeps;
        for (int i = 0; known && i < composite.leaves; ++i) {
            const CompositeLeaf& leaf = this->leaf(i);
            known = !leaf.nodes && if_known(world, leaf.form, [&](const auto& group) {
                using Kind = typename std::remove_cvref_t<decltype(group)>::Form::Kind;
                if constexpr (Kind::closed) cross_leaf_item(group.items[leaf.item], own, slack, leaves[i]);
            });
        }
    }

    /// Calls visit(leaf, lanes, low, high, t, surface, certain) for each end of a leaf ahead where the composite may
    /// begin or end: in `lanes`, between `low` and `high`. In the lanes of `certain` it certainly does.
    template <class Visit>
    void each_end(Mask<S> active, const Visit& visit) const {
        for (int i = 0; i < composite.leaves; ++i) {
            const SpanBounds<S>& span = leaves[i].span;
            for (int k = 0; k < 2; ++k) {
                const S &low = k == 0 ? span.near_low : span.far_low, &high = k == 0 ? span.near_high : span.far_high;
                const Mask<S> ahead = active & span.maybe & !(high <= S(0)) & !(low == S(SpanBounds<S>::inf));
                if (none(ahead)) continue;
                Mask<S> certain, lanes = ahead;
                find_change(i, max(low, S(0)), high, lanes, certain);
                if (any(lanes))
                    visit(leaf(i), lanes, low, high, leaves[i].t[k], leaves[i].surface[k],
                          Mask<S>(lanes & certain & span.sure & (low > S(0))));
            }
        }
    }

    bool known = true;

  private:
    const CompositeLeaf& leaf(int i) const { return world.composites.leaves[composite.first_leaf + i]; }

    /// Says on which side of a body a place is: certainly inside, certainly outside, or undecided.
    struct Side {
        Mask<S> in, out;
    };
    Side side_of(int i, const S& low, const S& high) const {
        const SpanBounds<S>& span = leaves[i].span;
        return {Mask<S>(span.sure & (span.near_high < low) & (span.far_low > high)),
                Mask<S>((!span.maybe) | (span.near_low > high) | (span.far_high < low))};
    }
    static Side combine(CompositeStep step, const Side& a, const Side& b) {
        if (unites(step)) return {Mask<S>(a.in | b.in), Mask<S>(a.out & b.out)};
        if (step == CompositeStep::intersect) return {Mask<S>(a.in & b.in), Mask<S>(a.out | b.out)};
        return {Mask<S>(a.in & b.out), Mask<S>(a.out | b.in)};
    }
    /// Decides whether the composite begins or ends where leaf i does, between `low` and `high`; other leaves may end
    /// there too. The whole is evaluated with the leaf and without it. If it is certainly the same the composite goes
    /// on, and the lane is taken from `lanes`; if it certainly differs the composite begins or ends, whatever other
    /// leaves do: `certain`.
    [[gnu::noinline]] void find_change(int i, const S& low, const S& high, Mask<S>& lanes, Mask<S>& certain) const {
        const Mask<S> nowhere = first_lanes<S>(0), everywhere = first_lanes<S>(width<S>);
        Room<Side, most_leaves> with, without;
        int height = 0, next = 0;
        for (int n = 0; n < composite.steps; ++n) {
            const CompositeStep step = world.composites.steps[composite.first_step + n];
            if (step == CompositeStep::leaf) {
                with[height] = without[height] = side_of(next, low, high);
                if (next++ == i) with[height] = {everywhere, nowhere}, without[height] = {nowhere, everywhere};
                ++height;
                continue;
            }
            --height;
            with[height - 1] = combine(step, with[height - 1], with[height]);
            without[height - 1] = combine(step, without[height - 1], without[height]);
        }
        certain = (with[0].in & without[0].out) | (with[0].out & without[0].in);
        lanes = lanes & !((with[0].in & without[0].in) | (with[0].out & without[0].out));
    }

    const World<T>& world;
    const CompositeInfo& composite;
    Room<KnownLeaf<S>, most_leaves> leaves;
};

/// Adds what may be met of these items, if they are composites of known leaves. Returns false if they are not.
template <class S>
[[gnu::noinline]] bool add_composites(const World<Element<S>>& world, int form, int first, int count,
                                      const DoubtfulRay<S>& own, Mask<S> mask, const Slack<Element<S>>& slack,
                                      Candidates<S>& found) {
    if (form != composite_form) return false;
    for (int i = first; i < first + count; ++i) {
        const KnownComposite<S> composite(world, composite_of(world, i), own, slack);
        if (!composite.known) return false;
        composite.each_end(mask, [&](const CompositeLeaf&, Mask<S> lanes, const S& low, const S& high, const S& t,
                                     const S& surface, Mask<S> certain) {
            found.add(lanes, low, select(certain, high, S(Candidates<S>::inf)), t, surface, S(-1));
        });
    }
    return true;
}

/// Attenuates light by such items. Returns false if they are not known, as above.
template <class S>
[[gnu::noinline]] bool pass_composites(const World<Element<S>>& world, int form, int first, int count,
                                       const DoubtfulRay<S>& own, Mask<S> mask, const S& distance, const S& off,
                                       const Slack<Element<S>>& slack, LightBounds<S>& light) {
    if (form != composite_form) return false;
    for (int i = first; i < first + count; ++i) {
        const KnownComposite<S> composite(world, composite_of(world, i), own, slack);
        if (!composite.known) return false;
        composite.each_end(mask & !light.dark, [&](const CompositeLeaf& leaf, Mask<S> lanes, const S& low,
                                                   const S& high, const S&, const S&, Mask<S> certain) {
            const Mask<S> before = lanes & !(low >= distance + off), surely = certain & (high < distance - off);
            lose_light(world, leaf.material, Mask<S>(before & surely), Mask<S>(before & !surely), light);
        });
    }
    return true;
}

}  // namespace strahl::inline STRAHL_LEVEL
