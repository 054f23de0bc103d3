// Crossings of rays with composites. Nothing is sorted: a walk along the ray goes from end to end of the leaves; the
// surface is where the whole changes between inside and outside.
#pragma once
#include "num/uninitialized.h"
#include "trace/forms/form_kernel.h"
#include "trace/hierarchy/traverse.h"

namespace strahl::inline STRAHL_LEVEL {

/// The leaves of a composite along a pack of rays, up to a limit: those that matter to any of them there.
template <class S>
class CompositeWalk {
    using T = Element<S>;
    static constexpr T inf = std::numeric_limits<T>::infinity();

  public:
    [[gnu::noinline]] CompositeWalk(const World<T>& world, const CompositeInfo& composite, const Ray<S>& ray,
                                    Mask<S> lanes, const S& limit)
        : world(world),
          composite(composite),
          ray(ray),
          from(ray),
          whole{select(lanes, S(0), S(inf)), select(lanes, limit, S(-inf))} {
        start_key = S(T(-1));
        const Mask<S> start = (ray.source >= S(static_cast<T>(composite.surface))) &
                              (ray.source < S(static_cast<T>(composite.surface + composite.surfaces)));
        starts_here = any(start);
        if (starts_here && composite.shares_faces) find_start_keys(start);
        find_leaves();
    }

    /// Returns the lanes in which the inside of the composite is there, just after `t`.
    STRAHL_INLINE Mask<S> inside_after(const S& t) const {
        return combined([&](int i) { return inside_leaf(i, t); });
    }
    /// Returns inside_after(t) with leaf `other` turned inside out, and leaves from `passed` on as just before `t`.
    [[gnu::noinline]] Mask<S> inside_if(const S& t, int other, int passed = most_leaves) const {
        return combined([&](int i) {
            const Mask<S> inside = i < passed ? inside_leaf(i, t) : inside_leaf_before(i, t);
            return i == other ? !inside : inside;
        });
    }
    /// Returns the next end of any leaf beyond `t`; infinite if there is none.
    STRAHL_INLINE S next(const S& t) const {
        S best(inf);
        const auto look = [&](const S& end) { best = select(end > t, min(end, best), best); };
        each_leaf([&](int i) {
            for (int k = 0; k < ends[i].pairs; ++k) look(ends[i].near[k]), look(ends[i].far[k]);
        });
        return best;
    }
    /// Returns the surfaces at which the whole changes at `t`, in these lanes. If several leaves end there, it is that
    /// of the first declared leaf without which the whole would not change. If it would change without any of them, it
    /// is that of the leaf at which it changes when they end in the order declared: never one that does not matter.
    S surface_at(const S& t, Mask<S> lanes) const {
        S surface(T(-1));
        Mask<S> found = first_lanes<S>(0), several = found;
        const auto show = [&](int i, Mask<S> shown) {
            surface = select(shown, S(static_cast<T>(leaf(i).surface)) + face_at(i, t), surface);
        };
        each_leaf([&](int i) {
            const Mask<S> own = lanes & ends_of(i, t);
            several = several | (found & own), found = found | own;
            show(i, own);
        });
        if (any(several)) [[unlikely]] {
            const Mask<S> inside = inside_after(t);
            const auto show_first = [&](const auto& decides) {
                each_leaf([&](int i) {
                    const Mask<S> own = several & ends_of(i, t);
                    if (none(own)) return;
                    const Mask<S> shown = own & decides(i);
                    show(i, shown);
                    several = several & !shown;
                });
            };
            show_first([&](int i) { return differ(inside, inside_if(t, i)); });
            show_first([&](int i) { return !differ(inside, inside_if(t, -1, i + 1)); });
            if (composite.keeps) show_first([&](int i) { return leaf(i).kept ? shows(i, t) : first_lanes<S>(0); });
        }
        return surface;
    }
    /// Calls visit(leaf, lanes) for the leaves that surfaces are of.
    template <class Visit>
    void each_leaf_of(const S& surface, Mask<S> lanes, const Visit& visit) const {
        each_leaf([&](int i) {
            const S face = surface - S(static_cast<T>(leaf(i).surface));
            const Mask<S> own = lanes & (face >= S(0)) & (face < S(static_cast<T>(leaf(i).faces)));
            if (any(own)) visit(leaf(i), own);
        });
    }
    /// Walks along the rays and calls crossed(t, lanes) where they enter or leave the composite, until no lanes are
    /// left: crossed returns the lanes that go on.
    template <class Crossed>
    void go(const Crossed& crossed) {
        Mask<S> lanes = whole.lanes();
        if (step_count == 0 || none(lanes)) return;
        S t(0);
        Mask<S> inside = inside_after(t);
        while (any(lanes)) {
            S ahead = next(t);
            if (list_count > 0)
                each_leaf([&](int i) {
                    if (leaf(i).listed && look_ahead(i, lanes, t, ahead)) ahead = next(t);
                });
            t = ahead;
            lanes = lanes & (t < S(inf)) & (t <= whole.high);
            const Mask<S> after = inside_after(t);
            Mask<S> changes = lanes & differ(inside, after);
            if (composite.keeps) [[unlikely]]
                changes = changes | (lanes & keeps_at(t));
            inside = after;
            if (any(changes)) lanes = lanes & crossed(t, changes);
        }
    }

  private:
    /// A stretch of each ray, outside of which a body is not there.
    struct Reach {
        S low, high;
        /// Returns the lanes in which it is not empty. What ends where rays start, as a body does that they leave, is
        /// not there for them.
        Mask<S> lanes() const { return (low <= high) & (low < S(inf)) & (high > S(0)); }
    };
    struct WalkStep {
        CompositeStep step;
        std::int16_t leaf;  // the one it takes, alone or as its second operand; -1 if that is another step's result
    };

    static Mask<S> differ(const Mask<S>& a, const Mask<S>& b) { return (a & !b) | (b & !a); }
    /// Calls visit(leaf) for the leaves that matter, in the order declared.
    template <class Visit>
    STRAHL_INLINE void each_leaf(const Visit& visit) const {
        for (int n = 0; n < leaf_count; ++n) visit(leaves[n]);
    }
    /// Combines the leaves to the whole: inside(i) returns the lanes in which leaf i is.
    template <class Inside>
    STRAHL_INLINE Mask<S> combined(const Inside& inside) const {
        Room<Mask<S>, most_leaves> stack;
        Mask<S> top = inside(steps[0].leaf);
        for (int i = 1, height = 0; i < step_count; ++i) {
            const auto [step, leaf] = steps[i];
            Mask<S> second = top;
            if (step == CompositeStep::leaf)
                stack[height++] = top;
            else if (leaf < 0)
                top = stack[--height];
            if (leaf >= 0) second = inside(leaf);
            switch (step) {
                case CompositeStep::leaf:
                    top = second;
                    break;
                case CompositeStep::unite:
                case CompositeStep::keep:
                    top = top | second;
                    break;
                case CompositeStep::intersect:
                    top = top & second;
                    break;
                case CompositeStep::subtract:
                    top = top & !second;
                    break;
            }
        }
        return top;
    }
    /// Returns the lanes in which a leaf ends at `t` and its surface is seen there because a union keeps it.
    [[gnu::noinline]] Mask<S> keeps_at(const S& t) const {
        Mask<S> seen = first_lanes<S>(0);
        each_leaf([&](int i) {
            if (!leaf(i).kept) return;
            const Mask<S> own = ends_of(i, t);
            if (any(own)) seen = seen | (own & shows(i, t));
        });
        return seen;
    }
    /// Returns the lanes in which the surface of leaf `own` is seen at `t` as in POV-Ray: where other parts of its
    /// intersections are inside, and those of its unions are not, unless they keep surfaces.
    [[gnu::noinline]] Mask<S> shows(int own, const S& t) const {
        struct KeptPart {
            Mask<S> inside;  // lanes where the surface is seen,
            bool own;        // if the leaf belongs to this part
        };
        const auto part_of = [&](int i) {
            return KeptPart{i == own ? first_lanes<S>(width<S>) : inside_leaf(i, t), i == own};
        };
        Room<KeptPart, most_leaves> stack;
        int height = 0;
        for (int i = 0; i < step_count; ++i) {
            const auto [step, leaf] = steps[i];
            if (leaf >= 0) stack[height++] = part_of(leaf);
            if (step == CompositeStep::leaf || i == 0) continue;
            const KeptPart second = stack[--height];
            KeptPart& first = stack[height - 1];
            const bool either = first.own || second.own;
            const Mask<S> seen = first.own ? first.inside : second.inside,
                          other = first.own ? second.inside : first.inside;
            if (step == CompositeStep::keep)
                first.inside = either ? seen : first.inside | second.inside;
            else if (step == CompositeStep::unite)
                first.inside = either ? seen & !other : first.inside | second.inside;
            else if (step == CompositeStep::intersect || second.own)
                first.inside = first.inside & second.inside;
            else
                first.inside = first.inside & !second.inside;
            first.own = either;
        }
        return stack[0].inside;
    }
    /// Finds the leaves that matter to any ray within its stretch, and the steps that combine them. What can only cut
    /// is not looked for where there is nothing to be cut.
    void find_leaves() {
        struct Operand {
            Reach stretch;
            int within;         // the part that it is to cut, -1 if there is none
            int steps, leaves;  // how many there were before it: if as many as now, it is nowhere
        };
        Room<Operand, most_leaves> operands;
        int height = 0, next = 0;
        const auto remove = [&](const Operand& part) { step_count = part.steps, leaf_count = part.leaves; };
        for (int i = 0; i < composite.steps; ++i) {
            const CompositeStep step = world.composites.steps[composite.first_step + i];
            Operand& second = operands[step == CompositeStep::leaf ? height : height - 1];
            if (step == CompositeStep::leaf) {
                const CompositeLeaf& own = leaf(next);
                if (own.until > 0 && operands[height - 1].steps == step_count) {
                    i = own.until, next += own.leaves;
                    continue;
                }
                second.within = own.until > 0 ? height - 1 : height > 0 ? operands[height - 1].within : -1;
                second.steps = step_count, second.leaves = leaf_count;
                second.stretch = second.within < 0 ? whole : operands[second.within].stretch;
                if (cross(next, second.stretch)) {
                    leaves[leaf_count++] = static_cast<std::int16_t>(next);
                    steps[step_count++] = {step, static_cast<std::int16_t>(next)};
                }
                ++next, ++height;
                continue;
            }
            --height;
            Operand& first = operands[height - 1];
            Reach &all = first.stretch, &own = second.stretch;
            const bool nowhere = second.steps == step_count;
            const auto combine = [&] {
                if (second.steps + 1 == step_count)
                    steps[second.steps].step = step;  // a leaf
                else
                    steps[step_count++] = {step, -1};
            };
            if (unites(step)) {
                if (nowhere) continue;
                if (first.steps == second.steps)
                    all = own;
                else
                    all = {min(all.low, own.low), max(all.high, own.high)}, combine();
            } else if (step == CompositeStep::subtract) {
                if (!nowhere) combine();
            } else {
                all = {max(all.low, own.low), min(all.high, own.high)};
                if (nowhere || none(all.lanes()))
                    remove(first);
                else
                    combine();
            }
        }
        whole = operands[0].stretch;
    }
    /// Returns the lanes in which a leaf ends there.
    Mask<S> ends_of(int i, const S& t) const {
        Mask<S> any = (ends[i].near[0] == t) | (ends[i].far[0] == t);
        if (ends[i].pairs > 1) any = any | (ends[i].near[1] == t) | (ends[i].far[1] == t);
        return any;
    }
    /// Returns the face of a leaf that ends there.
    S face_at(int i, const S& t) const {
        Mask<S> near = ends[i].near[0] == t;
        if (ends[i].pairs > 1) near = near | (ends[i].near[1] == t);
        return select(near, ends[i].near_face, ends[i].far_face);
    }
    const CompositePlane<T>& plane(int key) const { return world.composites.planes[composite.first_plane + key]; }
    /// Returns where rays cross a plane: at 0 if they start on it.
    S cross_plane(int key) const {
        const Vec3<S> n = splat<S>(plane(key).normal);
        const S t = (S(plane(key).distance) - dot(n, ray.origin)) / dot(n, ray.direction);
        return select(start_key == S(static_cast<T>(key)), S(0), t);
    }
    const CompositeLeaf& leaf(int i) const { return world.composites.leaves[composite.first_leaf + i]; }

    /// Sets the keys of the faces that rays start on, in the lanes of the mask.
    [[gnu::noinline]] void find_start_keys(Mask<S> lanes) {
        while (any(lanes)) {
            const T source = lane(ray.source, first(lanes));
            const Mask<S> own = lanes & (ray.source == S(source));
            const int key =
                world.composites.face_keys[composite.first_key + static_cast<int>(source) - composite.surface];
            start_key = select(own, S(static_cast<T>(key)), start_key);
            lanes = lanes & !own;
        }
    }
    Mask<S> inside_leaf(int i, const S& t) const {
        Mask<S> inside = (ends[i].near[0] <= t) & (t < ends[i].far[0]);
        if (ends[i].pairs > 1) inside = inside | ((ends[i].near[1] <= t) & (t < ends[i].far[1]));
        return inside;
    }
    Mask<S> inside_leaf_before(int i, const S& t) const {
        Mask<S> inside = (ends[i].near[0] < t) & (t <= ends[i].far[0]);
        if (ends[i].pairs > 1) inside = inside | ((ends[i].near[1] < t) & (t <= ends[i].far[1]));
        return inside;
    }
    /// Finds the spans of rays in leaf i, and shortens the stretch to them. Returns whether it is anywhere then.
    STRAHL_INLINE bool cross(int i, Reach& stretch) {
        const CompositeLeaf& own = leaf(i);
        if (!own.listed && none(reached(world.composites.balls[composite.first_leaf + i], stretch))) return false;
        cross_leaf(own, stretch, ends[i]);
        return any(stretch.lanes());
    }
    /// Does what `cross` does, for a leaf that rays may meet. Faces in the same place share a key and are crossed at
    /// one t: planes are one plane, others have equal formulas. A ray that starts on one of them starts on all.
    [[gnu::noinline]] void cross_leaf(const CompositeLeaf& own, Reach& stretch, LeafEnds<S>& end) {
        if (own.listed) return cross_mesh(own, stretch, end);
        const std::int32_t* const keys =
            world.composites.face_keys + composite.first_key + (own.surface - composite.surface);
        if (own.half_space != 0)
            cross_half_space(own, keys[0], end);
        else
            cross_body(own, keys, end);
        stretch = {max(stretch.low, end.near[0]), min(stretch.high, end.far[end.pairs - 1])};
    }
    /// Returns the lanes whose rays may meet a ball within their stretch. How far they pass from its centre is off by
    /// some rounding errors of its distance.
    STRAHL_INLINE Mask<S> reached(const CompositeBall<T>& ball, const Reach& stretch) const {
        const Vec3<S> away = splat<S>(ball.centre) - ray.origin;
        const S along = dot(away, ray.direction), square(ball.square);
        const S far = dot(away, away) * S(1 - 64 * std::numeric_limits<T>::epsilon());
        return stretch.lanes() & !((far > square) & ((along < S(0)) | (far - along * along > square)));
    }
    STRAHL_INLINE void cross_body(const CompositeLeaf& own, const std::int32_t* keys, LeafEnds<S>& end) {
        const S surface(static_cast<T>(own.surface));
        S start(T(-1));
        if (starts_here) {
            // Takes faces of an equal body for its own, but not planes: another body's face there may end before.
            const S same = start_key - S(static_cast<T>(own.first_key)), face = ray.source - surface;
            const S faces(static_cast<T>(own.faces)), zero(0);
            start = select((face >= zero) & (face < faces), face, select((same >= zero) & (same < faces), same, start));
        }
        from.source = surface + start;
        calls<S>(own.form).ends(world, own.item, from, end);
        if (!composite.shares_faces) return;
        const Mask<S> met = end.near[0] <= end.far[0];
        for (int face = 0; face < own.faces; ++face) {
            if (keys[face] >= most_planes) continue;
            const S number(static_cast<T>(face));
            const Mask<S> near = met & (end.near_face == number), far = met & (end.far_face == number);
            if (none(near | far)) continue;
            const S t = cross_plane(keys[face]);
            end.near[0] = select(near, t, end.near[0]);
            end.far[0] = select(far, t, end.far[0]);
        }
    }
    void cross_half_space(const CompositeLeaf& own, int key, LeafEnds<S>& end) const {
        const S zero(0), turn(static_cast<T>(own.half_space)), t = cross_plane(key);
        const Vec3<S> n = splat<S>(plane(key).normal);
        const S towards = turn * dot(n, ray.direction), height = turn * (dot(n, ray.origin) - S(plane(key).distance));
        const Mask<S> enters = towards<zero, leaves = towards> zero, along = !(enters | leaves);
        end.pairs = 1;
        end.near[0] = select(enters, t, select(along & !(height < zero), S(inf), S(-inf)));
        end.far[0] = select(leaves, t, S(inf));
        end.near_face = end.far_face = zero;
    }

    /// A place where rays cross a mesh, at infinity if there is none, and the number of the triangle in the mesh.
    struct MeshCrossing {
        S t{inf}, triangle{T(-1)};
    };
    /// Returns the next crossing of a mesh beyond `from`. Crossings of an even number of triangles in one place, at a
    /// fold, do not count. Lists more crossings where that does not suffice. Rays that start on a triangle in the place
    /// of one of the mesh's own count as starting on that.
    [[gnu::noinline]] MeshCrossing next_of_mesh(const CompositeLeaf& own, Mask<S> lanes, const S& from, Mask<S> all,
                                                S& unlisted, MeshCrossings<S>& list) const {
        const S surface(static_cast<T>(own.surface)), limit = own.in_planes ? S(inf) : select(all, S(inf), whole.high);
        MeshCrossing next;
        while (true) {
            for (int k = list.most - 1; k >= 0; --k) {
                const S t = load_lanes<S>(list.t[k]);
                const Mask<S> here = lanes & mask_of<S>(list.odd[k]) & (t > from);
                next.t = select(here, t, next.t);
                next.triangle = select(here, load_lanes<S>(list.surface[k]) - surface, next.triangle);
            }
            lanes = lanes & !(next.t < S(inf)) & (unlisted < limit);
            if (none(lanes)) return next;
            const S start = start_key - S(static_cast<T>(own.first_key));
            const Mask<S> starts_on_it = (start >= S(0)) & (start < S(static_cast<T>(own.faces)));
            const Ray<S> line{ray.origin, ray.direction, select(starts_on_it, surface + start, ray.source)};
            list.clear(lanes);
            calls<S>(own.form).list_crossings(world, own, line, lanes, S(unlisted), limit, Mask<S>(all & lanes), list);
            unlisted = select(lanes, load_lanes<S>(list.t[list.most - 1]), unlisted);
        }
    }
    /// Returns the distance of a crossing: if the triangle lies in a plane that other faces share, that of the plane.
    [[gnu::noinline]] S place_of(const CompositeLeaf& own, const MeshCrossing& found) const {
        if (!own.in_planes) return found.t;
        S t = found.t;
        const std::int32_t* const keys =
            world.composites.face_keys + composite.first_key + (own.surface - composite.surface);
        for (unsigned left = bits(found.triangle >= S(0)); left; left &= left - 1) {
            const int k = std::countr_zero(left), key = keys[static_cast<int>(lane(found.triangle, k))];
            if (key >= most_planes) continue;
            const T place = lane(cross_plane(key), k);
            if (std::abs(place) < inf) t = with_lane(t, k, place);
        }
        return t;
    }
    // The functions below look only for the next end of a mesh's span, and only once the ends of the other leaves lie
    // beyond where it may be: near[1] is the least distance at which it can be; from far[1] on, crossings are not
    // listed yet.

    /// Finds out whether rays start in a mesh: only those that start in its box can.
    [[gnu::noinline]] void cross_mesh(const CompositeLeaf& own, Reach& stretch, LeafEnds<S>& end) {
        Vec3<S> low, high;
        Mask<S> within = stretch.lanes();
        for (int c = 0; c < 3; ++c) {
            low[c] = S(static_cast<T>(own.low[c])), high[c] = S(static_cast<T>(own.high[c]));
            within = within & (ray.origin[c] >= low[c]) & (ray.origin[c] <= high[c]);
        }
        S enters, leaves;
        cross_boxes(low, high, traversal_ray(ray), enters, leaves);
        enters = enters * S(1 - 8 * std::numeric_limits<T>::epsilon());
        const Mask<S> lanes = stretch.lanes() & (max(stretch.low, enters) <= min(stretch.high, leaves));
        stretch.low = select(lanes, max(stretch.low, enters), S(inf));
        if (none(lanes)) return;
        end.list = std::min(list_count++, most_lists - 1);
        lists[end.list].clear();
        end.pairs = 1;
        end.near[0] = end.far[0] = S(inf), end.far[1] = S(0);
        // A triangle in a plane of other faces may be crossed a little further on than that.
        end.near[1] = select(lanes, own.in_planes ? S(0) : enters, S(inf));
        within = within & lanes;
        if (any(within)) cross_next(own, within, within, end);
    }
    /// Looks for the next crossing of a mesh, and in the lanes of `all` for whether rays start inside.
    void cross_next(const CompositeLeaf& own, Mask<S> lanes, Mask<S> all, LeafEnds<S>& end) {
        MeshCrossings<S>& list = lists[end.list];
        if (end.list == most_lists - 1) list.clear(lanes), end.far[1] = select(lanes, end.near[1], end.far[1]);
        const MeshCrossing found = next_of_mesh(own, lanes, end.near[1], all, end.far[1], list);
        const Mask<S> inside = (lanes & (end.near[0] == S(-inf))) | (all & mask_of<S>(list.odd_in_all));
        const S place = place_of(own, found);
        end.near[0] = select(lanes, select(inside, S(-inf), place), end.near[0]);
        end.far[0] = select(inside, place, end.far[0]);
        end.near_face = select(lanes, found.triangle, end.near_face);
        end.far_face = select(lanes, found.triangle, end.far_face);
        end.near[1] = select(lanes, found.t, end.near[1]);
    }
    /// Steps beyond a mesh's end that `t` has passed already. Fetches the mesh's next end if that may come before
    /// `ahead`, the next end of the other leaves; returns true if it did.
    bool look_ahead(int i, Mask<S> lanes, const S& t, const S& ahead) {
        const CompositeLeaf& own = leaf(i);
        LeafEnds<S>& end = ends[i];
        const Mask<S> entered = (end.near[0] <= t) & !(end.near[0] == S(-inf)), left = end.far[0] <= t;
        end.near[0] = select(entered, S(-inf), select(left, S(inf), end.near[0]));
        end.far[0] = select(left, S(inf), end.far[0]);
        const Mask<S> open = ((end.near[0] == S(-inf)) | (end.near[0] == S(inf))) & (end.far[0] == S(inf));
        const S limit = own.in_planes ? S(inf) : whole.high;
        const Mask<S> unknown = lanes & open & (end.near[1] < limit);
        // Follow all rays together as soon as one has to be followed: that costs less than following the others later.
        if (none(own.in_planes ? unknown : unknown & (end.near[1] < ahead))) return false;
        cross_next(own, unknown, first_lanes<S>(0), end);
        return true;
    }

    static constexpr int most_lists = 32;  // the last is for all further meshes, and made anew for each crossing

    const World<T>& world;
    const CompositeInfo& composite;
    const Ray<S>& ray;
    Ray<S> from;  // the same ray, of which a leaf is told on which of its faces it starts
    Reach whole;  // of the composite
    int leaf_count = 0, step_count = 0, list_count = 0;
    bool starts_here;
    S start_key;
    Room<std::int16_t, most_leaves> leaves;  // leaves that the ray may cross
    Room<WalkStep, 2 * most_leaves> steps;
    Room<LeafEnds<S>, most_leaves> ends;
    Room<MeshCrossings<S>, most_lists> lists;
};

template <class S>
struct FormFunctions<CompositeForm, S> : SingleByPack<FormFunctions<CompositeForm, S>, S> {
    using T = Element<S>;
    static void intersect(const World<T>& world, int first, int count, const Ray<S>& ray, Mask<S> mask,
                          Nearest<S>& best) {
        for (int i = first; i < first + count; ++i) {
            CompositeWalk<S> walk(world, composite_of(world, i), ray, mask, best.t);
            walk.go([&](const S& t, Mask<S> lanes) {
                const S surface = walk.surface_at(t, lanes);
                const Mask<S> better = lanes & closer(t, surface, best.t, best.surface);
                best.t = select(better, t, best.t);
                best.surface = select(better, surface, best.surface);
                return Mask<S>(!lanes);
            });
        }
    }
    static bool occlude(const World<T>& world, int first, int count, const Ray<S>& ray, const S& distance, Mask<S> mask,
                        Transmission<S>& light) {
        for (int i = first; i < first + count; ++i) {
            CompositeWalk<S> walk(world, composite_of(world, i), ray, mask, distance);
            walk.go([&](const S& t, Mask<S> lanes) {
                Mask<S> through = !lanes;
                lanes = lanes & (t < distance);
                const S surface = walk.surface_at(t, lanes);
                walk.each_leaf_of(surface, lanes, [&](const CompositeLeaf& leaf, Mask<S> own) {
                    const MaterialKernel<T>& material = world.materials[leaf.material];
                    if (!passes_light(world, leaf.material)) return darken(light, own, t);
                    through = through | own;
                    if (light.notes) light.notes->add_clear(own, t);
                    if (patterned(world, leaf.material)) [[unlikely]]
                        return FinishCalls<S>::filter(world, leaf.material, surface, ray, t, own, light.share);
                    for (int c = 0; c < 3; ++c)
                        light.share[c] =
                            select(own, min(light.share[c] * S(material.filter[c]), S(largest_gain)), light.share[c]);
                });
                return through;
            });
            if (all(light.limit < S(0))) return true;
        }
        return false;
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
