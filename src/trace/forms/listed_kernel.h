// Ray queries on bodies that list where rays cross them: those with contours, blobs, sweeps and Julia sets.
#pragma once
#include <bit>

#include "trace/forms/form_kernel.h"

namespace strahl::inline STRAHL_LEVEL {

template <class OwnForm, class S>
requires lists_crossings<typename OwnForm::Kind>
struct FormFunctions<OwnForm, S> : SingleByPack<FormFunctions<OwnForm, S>, S> {
    using T = Element<S>;
    static void intersect(const World<T>& world, int first, int count, const Ray<S>& ray, Mask<S> mask,
                          Nearest<S>& best) {
        const S over(passed_over(world));
        for (int i = first; i < first + count; ++i)
            each_crossing(world, i, enough(world), ray, S(0), mask, [&](Mask<S> lanes, const S& t, const S& surface) {
                const Mask<S> better = lanes & (t > over) & closer(t, surface, best.t, best.surface);
                best.t = select(better, t, best.t);
                best.surface = select(better, surface, best.surface);
            });
    }
    static bool occlude(const World<T>& world, int first, int count, const Ray<S>& ray, const S& distance, Mask<S> mask,
                        Transmission<S>& light) {
        const S over(passed_over(world));
        for (int i = first; i < first + count; ++i) {
            const auto& item = items(world)[i];
            const bool clear = transparent(world, item), painted = patterned(world, static_cast<int>(item.material));
            each_crossing(world, i, clear ? BlobData::unlimited : enough(world), ray, clear ? S(0) : distance, mask,
                          [&](Mask<S> lanes, const S& t, const S& surface) {
                              lanes = lanes & (t > over) & (t < distance);
                              if (none(lanes)) return;
                              if (!clear) return darken(light, lanes, julia ? S(0) : t);
                              // Steps through a Julia set begin where a ray does: from the next surface on it may
                              // cross it elsewhere.
                              if (light.notes && julia) light.notes->incomplete = true;
                              if (light.notes) light.notes->add_clear(lanes, t);
                              if (painted)
                                  return FinishCalls<S>::filter(world, static_cast<int>(item.material), surface, ray, t,
                                                                lanes, light.share);
                              const Vec3<T>& kept = filter(world, item);
                              for (int c = 0; c < 3; ++c)
                                  light.share[c] =
                                      select(lanes, min(light.share[c] * S(kept[c]), S(largest_gain)), light.share[c]);
                          });
            if (all(light.limit < S(0))) return true;
        }
        return false;
    }
    /// Does what it does for other forms, but the faces are known.
    static void surfaces_at(const World<T>& world, const int* numbers, const Ray<S>& ray, const S& t, const S& faces,
                            SurfaceHit<S>& hit, int* materials) {
        for (int k = 0; k < width<S>; ++k) materials[k] = static_cast<int>(items(world)[numbers[k]].material);
        if constexpr (has_contours<typename OwnForm::Kind>) {
            const auto own = gather_items<Item<OwnForm, S>, S>(items(world), numbers);
            const S first = own.shape.first;
            hit = {own.shape.at(pieces_of(world.contour_pieces, first, faces), ray, t, faces), own.surface + faces,
                   own.surface};
        } else if constexpr (julia || std::is_same_v<typename OwnForm::Kind, Blob>) {
            for (unsigned left = bits(S(0) == S(0)); left;) {
                const int number = numbers[std::countr_zero(left)];
                unsigned own = 0;
                for (int k = 0; k < width<S>; ++k) own |= unsigned(numbers[k] == number) << k;
                left &= ~own;
                const auto& item = items(world)[number];
                const Mask<S> lanes = mask_of<S>(own);
                const SurfacePoint<S> point = item.shape.at(first_piece(world, item), ray, t);
                hit.point = {select(lanes, point.position, hit.point.position),
                             select(lanes, point.normal, hit.point.normal)};
                hit.surface = hit.body = select(lanes, S(item.surface), hit.surface);
            }
        } else {
            T found[7][width<S>];
            for (int k = 0; k < width<S>; ++k) {
                const auto& item = items(world)[numbers[k]];
                const auto pick = [k](const Vec3<S>& v) { return Vec3<T>(lane(v.x, k), lane(v.y, k), lane(v.z, k)); };
                const Ray<T> one{pick(ray.origin), pick(ray.direction), T(-1)};
                const SurfacePoint<T> point = item.shape.at(first_piece(world, item), one, lane(t, k));
                for (int c = 0; c < 3; ++c) found[c][k] = point.position[c], found[3 + c][k] = point.normal[c];
                found[6][k] = item.surface;
            }
            for (int c = 0; c < 3; ++c)
                hit.point.position[c] = load_lanes<S>(found[c]), hit.point.normal[c] = load_lanes<S>(found[3 + c]);
            hit.surface = hit.body = load_lanes<S>(found[6]);
        }
    }
    /// Finds the span of rays in a convex leaf of a composite.
    static void ends(const World<T>& world, int item, const Ray<S>& ray, LeafEnds<S>& ends) {
        constexpr T inf = std::numeric_limits<T>::infinity();
        const S first_face(items(world)[item].surface);
        ends.pairs = 1, ends.near[0] = S(inf), ends.far[0] = S(-inf), ends.near_face = ends.far_face = S(0);
        each_crossing(world, item, BlobData::unlimited, ray, S(0), all_lanes<S>(),
                      [&](Mask<S> lanes, const S& t, const S& surface) {
                          const Mask<S> near = lanes & (t < ends.near[0]), far = lanes & (t > ends.far[0]);
                          ends.near[0] = select(near, t, ends.near[0]), ends.far[0] = select(far, t, ends.far[0]);
                          ends.near_face = select(near, surface - first_face, ends.near_face);
                          ends.far_face = select(far, surface - first_face, ends.far_face);
                      });
    }
    static void list_crossings(const World<T>& world, const CompositeLeaf& leaf, const Ray<S>& ray, Mask<S> mask,
                               const S& place, const S&, Mask<S>, MeshCrossings<S>& found) {
        each_crossing(world, leaf.item, BlobData::unlimited, ray, S(0), mask,
                      [&](Mask<S> lanes, const S& t, const S& surface) {
                          for (unsigned left = bits(lanes & (t > place)); left; left &= left - 1) {
                              const int k = std::countr_zero(left);
                              found.add(k, lane(t, k), lane(surface, k));
                          }
                      });
    }

  private:
    static constexpr bool julia = std::is_same_v<typename OwnForm::Kind, JuliaFractal>;

    /// Returns up to which distance from where rays start crossings are not there for them. It is longer for blobs than
    /// for other bodies, as in POV-Ray; parts of composites need all crossings.
    static T passed_over(const World<T>& world) {
        return std::is_same_v<typename OwnForm::Kind, Blob> ? 100 * world.passed_over : T(0);
    }
    /// Returns how many crossings are needed to find the nearest one that is there.
    static int enough(const World<T>& world) { return passed_over(world) > T(0) ? BlobData::unlimited : 1; }
    static const Item<OwnForm, T>* items(const World<T>& world) { return world.groups.template get<OwnForm>().items; }
    static auto first_piece(const World<T>& world, const Item<OwnForm, T>& item) {
        if constexpr (has_contours<typename OwnForm::Kind>)
            return world.contour_pieces + static_cast<int>(item.shape.first);
        else if constexpr (std::is_same_v<typename OwnForm::Kind, Blob>)
            return world.lump_pieces + static_cast<int>(item.shape.first);
        else if constexpr (std::is_same_v<typename OwnForm::Kind, SphereSweep>)
            return world.sweep_pieces + static_cast<int>(item.shape.first);
        else
            return static_cast<const void*>(nullptr);
    }
    /// Returns the pieces of faces, of bodies with these first pieces; for caps the first piece.
    static ContourPiece<S> pieces_of(const ContourPiece<T>* pieces, const S& first, const S& face) {
        constexpr int caps = OwnForm::template Kernel<T>::caps;
        alignas(64) T numbers[width<S>];
        store_lanes(numbers, first + max(face - S(T(caps)), S(0)));
        int index[width<S>];
        for (int k = 0; k < width<S>; ++k) index[k] = static_cast<int>(numbers[k]);
        return gather_items<ContourPiece<S>, S>(pieces, index);
    }
    /// Calls visit(lanes, t, surface) for each crossing of rays with an item, or at least the nearest `enough` of them.
    /// For what is nearer than `anywhere` t need not be exact.
    template <class Visit>
    static void each_crossing(const World<T>& world, int i, int enough, const Ray<S>& ray, const S& anywhere,
                              Mask<S> mask, const Visit& visit) {
        const auto& item = items(world)[i];
        const auto* const pieces = first_piece(world, item);
        const S surface(item.surface), start = ray.source - surface;
        const auto visit_face = [&](Mask<S> lanes, const S& t, const S& face) { visit(lanes, t, S(surface + face)); };
        if constexpr (julia) {
            item.shape.each_crossing(pieces, enough, ray, start, mask, visit_face, anywhere);
        } else if constexpr (requires { OwnForm::template Kernel<T>::in_double; }) {
            using V = Doubles<S>;
            for (int part = 0; part < width<S> / width<V>; ++part) {
                const int first = part * width<V>;
                const Mask<V> own = mask_of<V>(bits(mask) >> first);
                if (none(own)) continue;
                const auto visit_lanes = [&](Mask<V> lanes, const V& t, const V& face) {
                    visit_face(mask_of<S>(bits(lanes) << first), lanes_of<S>(t, part), lanes_of<S>(face, part));
                };
                item.shape.each_crossing(pieces, enough,
                                         Ray<V>{doubles_of(ray.origin, part), doubles_of(ray.direction, part), V(0)},
                                         doubles_of(start, part), own, visit_lanes);
            }
        } else if constexpr (!has_contours<typename OwnForm::Kind>) {
            item.shape.each_crossing(pieces, enough, ray, start, mask, visit_face);
        } else {
            const S last(T(item.shape.face_count() - 1));
            const auto piece_of = [&](const S& face) { return pieces_of(pieces, S(0), S(min(face, last))); };
            item.shape.each_crossing(pieces, piece_of, ray, start, mask, visit_face);
        }
    }
};

}  // namespace strahl::inline STRAHL_LEVEL
