// What the engine asks of a form's items through a table: compiled once per form, precision and instruction set.
#pragma once
#include <array>

#include "trace/items.h"

namespace strahl::inline STRAHL_LEVEL {

/// A point of a surface, and what it belongs to.
template <class S>
struct SurfaceHit {
    SurfacePoint<S> point;
    S body;                  // the number of the item's first surface
    int material[width<S>];  // only of hits on different items
};

/// One ray, and the light on it, while the items of a leaf are looked at side by side.
template <class S>
struct SingleRay {
    Ray<S> ray;  // the same in all lanes
    S distance;
    Vec3<Element<S>> share;
};

template <class Form, class S>
struct FormFunctions {
    using T = Element<S>;
    /// Meets the items with a pack of rays.
    static void intersect(const World<T>& world, int first, int count, const Ray<S>& ray, Mask<S> mask,
                          Nearest<S>& best);
    /// Meets the items, side by side, with one ray that is in all lanes.
    static void intersect_single(const World<T>& world, int first, int count, const Ray<S>& ray, Nearest<S>& best);
    /// Takes from the light what the items take. Is none left in any lane?
    static bool occlude(const World<T>& world, int first, int count, const Ray<S>& ray, const S& distance, Mask<S> mask,
                        Transmission<S>& light);
    /// The same of one ray, items side by side.
    static bool occlude_single(const World<T>& world, int first, int count, SingleRay<S>& single);
    /// The points at which rays first meet items: all the same one, or one in each lane.
    static void surface_at(const World<T>& world, const int* items, bool uniform, const Ray<S>& ray, const S& t,
                           SurfaceHit<S>& hit);
    /// Where rays that start on an item leave it.
    static Span<S> span(const World<T>& world, int item, const Ray<S>& ray);
};

/// The same, of a form that is only known by its number.
template <class S>
struct FormCalls {
    using W = World<Element<S>>;
    void (*intersect)(const W&, int, int, const Ray<S>&, Mask<S>, Nearest<S>&);
    void (*intersect_single)(const W&, int, int, const Ray<S>&, Nearest<S>&);
    bool (*occlude)(const W&, int, int, const Ray<S>&, const S&, Mask<S>, Transmission<S>&);
    bool (*occlude_single)(const W&, int, int, SingleRay<S>&);
    void (*surface_at)(const W&, const int*, bool, const Ray<S>&, const S&, SurfaceHit<S>&);
    Span<S> (*span)(const W&, int, const Ray<S>&);
};
/// Those of a kind, in a file of its own.
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

}  // namespace strahl::inline STRAHL_LEVEL
