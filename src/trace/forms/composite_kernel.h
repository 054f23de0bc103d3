// Crossings of rays with composites. Nothing is sorted: a walk along the ray goes from end to end of the leaves; the
// surface is where the whole changes between inside and outside.
#pragma once
#include "num/uninitialized.h"
#include "trace/forms/mesh_walk_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

/// The leaves of a composite along a pack of rays.
template <class S>
class CompositeWalk {
    using T = Element<S>;

  public:
    [[gnu::noinline]] CompositeWalk(const World<T>& world, const CompositeInfo& composite, const Ray<S>& ray,
                                    Mask<S> lanes)
        : world(world), composite(composite), ray(ray) {
        start_key = S(T(-1));
        if (any((ray.source >= S(static_cast<T>(composite.surface))) &
                (ray.source < S(static_cast<T>(composite.surface + composite.surfaces)))))
            start_key = keys_of(ray.source);
        for (int i = 0; i < composite.planes; ++i) {
            const CompositePlane<T>& plane = world.composites.planes[composite.first_plane + i];
            const Vec3<S> n = splat<S>(plane.normal);
            const S t = (S(plane.distance) - dot(n, ray.origin)) / dot(n, ray.direction);
            planes[i] = select(start_key == S(static_cast<T>(i)), S(0), t);
        }
        for (int i = 0; i < composite.leaves; ++i) cross(i, lanes);
    }

    /// Returns the lanes in which the inside of the composite is there, just after `t`; with `other`, as if that leaf
    /// were the opposite of what it is.
    [[gnu::noinline]] Mask<S> inside_after(const S& t, int other = -1) const {
        Room<Mask<S>, most_leaves> stack;
        int height = 0, leaf = 0;
        for (int i = 0; i < composite.steps; ++i) switch (world.composites.steps[composite.first_step + i]) {
                case CompositeStep::leaf:
                    stack[height] = inside_leaf(leaf, t);
                    if (leaf++ == other) stack[height] = !stack[height];
                    ++height;
                    break;
                case CompositeStep::unite:
                    --height, stack[height - 1] = stack[height - 1] | stack[height];
                    break;
                case CompositeStep::intersect:
                    --height, stack[height - 1] = stack[height - 1] & stack[height];
                    break;
                case CompositeStep::subtract:
                    --height, stack[height - 1] = stack[height - 1] & !stack[height];
                    break;
            }
        return stack[0];
    }
    /// Returns the next end of any leaf beyond `t`; infinite if there is none.
    [[gnu::noinline]] S next(const S& t) const {
        S best(std::numeric_limits<T>::infinity());
        const auto look = [&](const S& end) { best = select((end > t) & (end < best), end, best); };
        for (int i = 0; i < composite.leaves; ++i)
            for (int k = 0; k < ends[i].pairs; ++k) look(ends[i].near[k]), look(ends[i].far[k]);
        return best;
    }
    /// Calls visit(leaf, lanes, faces) for the leaves that make the whole change at `t`. If several end there, this is
    /// the first declared one without which the whole would not change, or the first one if it would change without any
    /// of them.
    template <class Visit>
    void ends_at(const S& t, Mask<S> lanes, const Visit& visit) const {
        S found(0);
        for (int i = 0; i < composite.leaves; ++i) found = found + select(ends_of(i, t), S(1), S(0));
        const Mask<S> several = lanes & (found > S(1));
        if (any(several)) [[unlikely]] {
            const Mask<S> inside = inside_after(t);
            Mask<S> left = several;
            for (int i = 0; i < composite.leaves && any(left); ++i) {
                const Mask<S> own = left & ends_of(i, t);
                if (none(own)) continue;
                const Mask<S> without = inside_after(t, i), decides = own & ((inside & !without) | (without & !inside));
                show(i, t, decides, visit);
                left = left & !decides;
            }
            lanes = (lanes & !several) | left;
        }
        for (int i = 0; i < composite.leaves && any(lanes); ++i) {
            const Mask<S> own = lanes & ends_of(i, t);
            show(i, t, own, visit);
            lanes = lanes & !own;
        }
    }
    /// Walks along the rays and calls crossed(t, lanes) where they enter or leave the composite, until no lanes are
    /// left: crossed returns the lanes that go on. `limit(t)` returns the lanes in which anything beyond can matter.
    template <class Crossed, class Limit>
    void go(Mask<S> lanes, const Crossed& crossed, const Limit& limit) {
        S t(0);
        Mask<S> inside = inside_after(t);
        while (any(lanes)) {
            for (int i = 0; has_meshes && i < composite.leaves; ++i)
                if (leaf(i).nodes) pass_mesh(i, t);
            t = next(t);
            lanes = lanes & (t < S(std::numeric_limits<T>::infinity())) & limit(t);
            const Mask<S> after = inside_after(t), changes = lanes & ((inside & !after) | (after & !inside));
            inside = after;
            if (any(changes)) lanes = lanes & crossed(t, changes);
        }
    }

  private:
    /// Returns the lanes in which a leaf ends there.
    Mask<S> ends_of(int i, const S& t) const {
        Mask<S> any = (ends[i].near[0] == t) | (ends[i].far[0] == t);
        if (ends[i].pairs > 1) any = any | (ends[i].near[1] == t) | (ends[i].far[1] == t);
        return any;
    }
    template <class Visit>
    void show(int i, const S& t, Mask<S> lanes, const Visit& visit) const {
        if (none(lanes)) return;
        Mask<S> near = ends[i].near[0] == t;
        if (ends[i].pairs > 1) near = near | (ends[i].near[1] == t);
        visit(leaf(i), lanes, select(near, ends[i].near_face, ends[i].far_face));
    }
    const CompositeLeaf& leaf(int i) const { return world.composites.leaves[composite.first_leaf + i]; }

    /// Returns the keys of the faces that rays start on, -1 for others.
    [[gnu::noinline]] S keys_of(const S& source) const {
        alignas(64) T keys[width<S>];
        for (int k = 0; k < width<S>; ++k) {
            const int own = static_cast<int>(lane(source, k)) - composite.surface;
            const bool here = own >= 0 && own < composite.surfaces;
            keys[k] = here ? static_cast<T>(world.composites.face_keys[composite.first_key + own]) : T(-1);
        }
        return load_lanes<S>(keys);
    }
    Mask<S> inside_leaf(int i, const S& t) const {
        Mask<S> inside = (ends[i].near[0] <= t) & (t < ends[i].far[0]);
        if (ends[i].pairs > 1) inside = inside | ((ends[i].near[1] <= t) & (t < ends[i].far[1]));
        return inside;
    }
    /// Finds the spans of rays in leaf i. Faces in the same place share a key, and so are crossed at the same t: planes
    /// by being one, others by their own equal formulas. A ray that starts on one of them starts on all.
    void cross(int i, Mask<S> lanes) {
        const CompositeLeaf& own = leaf(i);
        const std::int32_t* const keys =
            world.composites.face_keys + composite.first_key + (own.surface - composite.surface);
        LeafEnds<S>& end = ends[i];
        if (own.half_space != 0) return cross_half_space(own, keys[0], planes[keys[0]], end);
        if (own.nodes) return cross_mesh(own, lanes, end);
        S start(T(-1));
        for (int face = 0; face < own.faces; ++face)
            start = select(start_key == S(static_cast<T>(keys[face])), S(static_cast<T>(face)), start);
        const Ray<S> from{ray.origin, ray.direction, S(static_cast<T>(own.surface)) + start};
        calls<S>(own.form).ends(world, own.item, from, end);
        const Mask<S> met = end.near[0] <= end.far[0];
        for (int face = 0; face < own.faces; ++face) {
            if (keys[face] >= most_planes) continue;
            const S number(static_cast<T>(face)), &t = planes[keys[face]];
            end.near[0] = select(met & (end.near_face == number), t, end.near[0]);
            end.far[0] = select(met & (end.far_face == number), t, end.far[0]);
        }
    }
    void cross_half_space(const CompositeLeaf& own, int key, const S& t, LeafEnds<S>& end) const {
        const S zero(0), inf(std::numeric_limits<T>::infinity()), turn(static_cast<T>(own.half_space));
        const CompositePlane<T>& plane = world.composites.planes[composite.first_plane + key];
        const Vec3<S> n = splat<S>(plane.normal);
        const S towards = turn * dot(n, ray.direction), height = turn * (dot(n, ray.origin) - S(plane.distance));
        const Mask<S> enters = towards<zero, leaves = towards> zero, along = !(enters | leaves);
        end.pairs = 1;
        end.near[0] = select(enters, t, select(along & !(height < zero), inf, -inf));
        end.far[0] = select(leaves, t, inf);
        end.near_face = end.far_face = zero;
    }

    /// Finds the next crossing of a mesh. Rays that start on a triangle in the place of one of the mesh's own count as
    /// starting on that.
    MeshCrossing<S> next_of_mesh(const CompositeLeaf& own, Mask<S> lanes, const S& place, bool all) const {
        const S start = start_key - S(static_cast<T>(own.first_key)), surface(static_cast<T>(own.surface));
        const Mask<S> starts_here = (start >= S(0)) & (start < S(static_cast<T>(own.faces)));
        const Ray<S> from{ray.origin, ray.direction, select(starts_here, surface + start, ray.source)};
        return next_mesh_crossing(world, own, from, lanes, place, all);
    }
    /// Returns the distance of a crossing: if the triangle lies in a plane that other faces share, that of the plane.
    [[gnu::noinline]] S place_of(const CompositeLeaf& own, const MeshCrossing<S>& found) const {
        if (!own.in_planes) return found.t;
        S t = found.t;
        const std::int32_t* const keys =
            world.composites.face_keys + composite.first_key + (own.surface - composite.surface);
        for (unsigned left = bits(found.surface >= S(0)); left; left &= left - 1) {
            const int k = std::countr_zero(left), key = keys[static_cast<int>(lane(found.surface, k))];
            if (key >= most_planes) continue;
            const T place = lane(planes[key], k);
            if (std::abs(place) < std::numeric_limits<T>::infinity()) t = with_lane(t, k, place);
        }
        return t;
    }
    /// Finds the span of rays in a mesh that they are in, or that comes next. Its end for the mesh alone is far[1]:
    /// from there the next span is looked for.
    void cross_mesh(const CompositeLeaf& own, Mask<S> lanes, LeafEnds<S>& end) {
        const S zero(0), inf(std::numeric_limits<T>::infinity());
        const MeshCrossing<S> first = next_of_mesh(own, lanes, zero, true);
        const Mask<S> inside = first.odd_in_all;
        const MeshCrossing<S> second = next_of_mesh(own, lanes & !inside & (first.t < inf), first.t, false);
        const S begins = place_of(own, first), ends_there = place_of(own, second);
        end.pairs = 1;
        end.near[0] = select(inside, -inf, begins), end.near_face = first.surface;
        end.far[0] = select(inside, begins, ends_there), end.far[1] = select(inside, first.t, second.t);
        end.far_face = select(inside, first.surface, second.surface);
        has_meshes = true;
    }
    /// Goes on to the mesh's next span where this one lies behind.
    void pass_mesh(int i, const S& t) {
        LeafEnds<S>& end = ends[i];
        const S inf(std::numeric_limits<T>::infinity());
        const Mask<S> passed = (end.far[0] <= t) & (end.far[0] < inf);
        if (none(passed)) return;
        const MeshCrossing<S> first = next_of_mesh(leaf(i), passed, end.far[1], false);
        const MeshCrossing<S> second = next_of_mesh(leaf(i), passed & (first.t < inf), first.t, false);
        end.near[0] = select(passed, place_of(leaf(i), first), end.near[0]);
        end.far[0] = select(passed, place_of(leaf(i), second), end.far[0]);
        end.far[1] = select(passed, second.t, end.far[1]);
        end.near_face = select(passed, first.surface, end.near_face);
        end.far_face = select(passed, second.surface, end.far_face);
    }

    const World<T>& world;
    const CompositeInfo& composite;
    const Ray<S>& ray;
    bool has_meshes = false;
    S start_key;
    Room<S, most_planes> planes;  // distances at which rays cross them
    Room<LeafEnds<S>, most_leaves> ends;
};

template <class S>
struct FormFunctions<CompositeForm, S> {
    using T = Element<S>;
    static void intersect(const World<T>& world, int first, int count, const Ray<S>& ray, Mask<S> mask,
                          Nearest<S>& best) {
        for (int i = first; i < first + count; ++i) {
            CompositeWalk<S> walk(world, composite_of(world, i), ray, mask);
            walk.go(
                mask,
                [&](const S& t, Mask<S> lanes) {
                    walk.ends_at(t, lanes, [&](const CompositeLeaf& leaf, Mask<S> own, const S& face) {
                        const S surface = S(static_cast<T>(leaf.surface)) + face;
                        const Mask<S> better = own & closer(t, surface, best.t, best.surface);
                        best.t = select(better, t, best.t);
                        best.surface = select(better, surface, best.surface);
                    });
                    return Mask<S>(!lanes);
                },
                [&](const S& t) { return t <= best.t; });
        }
    }
    static void intersect_single(const World<T>& world, int first, int count, SingleRay<S>& single) {
        Nearest<S> best;
        best.t = S(single.t), best.surface = S(single.surface);
        intersect(world, first, count, single.ray, first_lanes<S>(1), best);
        single.t = lane(best.t, 0), single.surface = lane(best.surface, 0);
    }
    static bool occlude(const World<T>& world, int first, int count, const Ray<S>& ray, const S& distance, Mask<S> mask,
                        Transmission<S>& light) {
        for (int i = first; i < first + count; ++i) {
            CompositeWalk<S> walk(world, composite_of(world, i), ray, mask);
            walk.go(
                mask,
                [&](const S& t, Mask<S> lanes) {
                    Mask<S> through = !lanes;
                    walk.ends_at(t, lanes, [&](const CompositeLeaf& leaf, Mask<S> own, const S& face) {
                        const MaterialKernel<T>& material = world.materials[leaf.material];
                        if (!(material.refraction > 0)) {
                            light.limit = select(own, S(-1), light.limit);
                            return;
                        }
                        through = through | own;
                        if (patterned(world, leaf.material)) [[unlikely]]
                            return PatternCalls<S>::filter(world, leaf.material, S(static_cast<T>(leaf.surface)) + face,
                                                           ray, t, own, light.share);
                        for (int c = 0; c < 3; ++c)
                            light.share[c] = select(own, min(light.share[c] * S(material.filter[c]), S(largest_gain)),
                                                    light.share[c]);
                    });
                    return through;
                },
                [&](const S& t) { return t < distance; });
            if (all(light.limit < S(0))) return true;
        }
        return false;
    }
    static bool occlude_single(const World<T>& world, int first, int count, SingleRay<S>& single) {
        Transmission<S> light{splat<S>(single.share), select(first_lanes<S>(1), S(1), S(-1))};
        const bool dark = occlude(world, first, count, single.ray, S(single.t), first_lanes<S>(1), light);
        for (int c = 0; c < 3; ++c) single.share[c] = lane(light.share[c], 0);
        return dark;
    }
};

/// Composites have no other calls: hits are on leaves, and shaded as those of their forms.
template <class S>
const std::array<FormCalls<S>, 1> KindCalls<Union, S>::calls{
    {{&FormFunctions<CompositeForm, S>::intersect, &FormFunctions<CompositeForm, S>::intersect_single,
      &FormFunctions<CompositeForm, S>::occlude, &FormFunctions<CompositeForm, S>::occlude_single}}};

}  // namespace strahl::inline STRAHL_LEVEL
