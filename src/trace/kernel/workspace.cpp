#include "trace/kernel/workspace.h"

#include <algorithm>
#include <utility>

namespace strahl {
namespace {
constexpr std::size_t queue_capacity = batch_rays + 4 * widest_pack;  // whole packs are stored past the end
constexpr std::size_t most_hit_bins = 128;
}  // namespace

int push(MediumStacks& all, int list, int body) {
    const auto [entry, is_new] =
        all.known.try_emplace(std::uint64_t(list) << 32 | std::uint32_t(body), static_cast<int>(all.lists.size()));
    if (is_new) all.lists.push_back({list, body});
    return entry->second;
}

int remove(MediumStacks& all, int list, int body) {
    if (list == 0) return 0;
    const auto [shorter, last] = all.lists[list];
    return last == body ? shorter : push(all, remove(all, shorter, body), last);
}

bool contains(const MediumStacks& all, int list, int body) {
    for (; list; list = all.lists[list].shorter)
        if (all.lists[list].body == body) return true;
    return false;
}

int top(const MediumStacks& all, int list) { return all.lists[list].body; }

bool all_hollow(const MediumStacks& all, int list, const std::uint8_t* hollow) {
    while (list && hollow[all.lists[list].body]) list = all.lists[list].shorter;
    return list == 0;
}

namespace {
/// Returns zeros on large pages of their own: the arrays of a queue span more small pages than the processor's cache of
/// page addresses holds.
template <class T>
Buffer<T> zeros(std::size_t count) {
    constexpr std::size_t page = std::size_t(1) << 21;
    Buffer<T> values = uninitialized_buffer<T>(std::max(count, page / sizeof(T)));
    std::fill_n(values.get(), count, T(0));
    return values;
}
/// Returns a queue with its arrays in memory for ray_arrays * queue_capacity values.
template <class T>
RayQueue<T> queue_in(T* next) {
    RayQueue<T> queue;
    each_array(
        [&](RayPart part, T*& array) {
            if (part <= RayPart::inside) array = std::exchange(next, next + queue_capacity);
        },
        queue);
    return queue;
}
}  // namespace

template <class T>
Workspace<T>::Workspace() {
    values = zeros<T>((2 + ray_arrays) * queue_capacity);
    order_by_bin = uninitialized_buffer<T>(most_hit_bins * HitList<T>::capacity);
    counts.resize(most_hit_bins);
    T* const first = values.get() + ray_arrays * queue_capacity;
    hits = {first, first + queue_capacity, order_by_bin.get(), counts.data()};
    refracted_queue = queue_in(values.get());
    pixels_x.resize(scattered_pixels + widest_pack), pixels_y.resize(scattered_pixels + widest_pack);
    sums.resize(scattered_pixels), past.resize(scattered_pixels);
    sights.resize(scattered_pixels);
    sides.resize(scattered_pixels), seen.resize(scattered_pixels);
}

/// Gives an array its memory. Arrays share large pages: clearing one takes longer than tracing a batch.
template <class T>
void Workspace<T>::hold(T*& array) {
    if (array) return;
    constexpr std::size_t together = (std::size_t(1) << 21) / sizeof(T) / queue_capacity;
    if (more.empty() || used == together) more.push_back(zeros<T>(together * queue_capacity)), used = 0;
    array = more.back().get() + used++ * queue_capacity;
}

template <class T>
void Workspace<T>::hold_more(RayQueue<T>& queue) {
    each_array(
        [&](RayPart part, T*& array) {
            if ((part == RayPart::extra && with_extra) || (part == RayPart::beside && with_differentials) ||
                (part == RayPart::cone && with_cones) || (part == RayPart::carried && with_carried))
                hold(array);
        },
        queue);
}

template <class T>
void Workspace<T>::hold_more() {
    hold_more(refracted_queue);
    for (const auto& made : held) hold_more(made->generation.open), hold_more(made->generation.inside);
}

template <class T>
void Workspace<T>::hold_extra() {
    with_extra = true;
    hold_more();
}

template <class T>
void Workspace<T>::hold_differentials() {
    with_differentials = true;
    hold_more();
}

template <class T>
void Workspace<T>::hold_cones() {
    with_cones = true;
    hold_more();
}

template <class T>
void Workspace<T>::hold_carried() {
    with_carried = true;
    hold_more();
}

template <class T>
Generation<T>& Workspace<T>::generation(int slot) {
    while (static_cast<int>(held.size()) <= slot) {
        held.push_back(std::make_unique<Held>());
        Held& made = *held.back();
        made.values = zeros<T>(2 * ray_arrays * queue_capacity);
        made.stretches.resize(2 * most_hit_bins);
        made.generation = {queue_in(made.values.get()), queue_in(made.values.get() + ray_arrays * queue_capacity),
                           made.stretches.data(), made.stretches.data() + most_hit_bins};
        hold_more(made.generation.open), hold_more(made.generation.inside);
    }
    return held[slot]->generation;
}

template <class T>
Generation<T>& generation(Workspace<T>& workspace, int slot) {
    return workspace.generation(slot);
}
template <class T>
RayQueue<T>& refracted_queue(Workspace<T>& workspace) {
    return workspace.refracted_queue;
}
template <class T>
HitList<T>& hits(Workspace<T>& workspace) {
    return workspace.hits;
}
template <class T>
MediumStacks& mediums(Workspace<T>& workspace) {
    return workspace.mediums;
}

template class Workspace<float>;
template class Workspace<double>;
template class Workspace<long double>;
template Generation<float>& generation(Workspace<float>&, int);
template RayQueue<float>& refracted_queue(Workspace<float>&);
template Generation<double>& generation(Workspace<double>&, int);
template RayQueue<double>& refracted_queue(Workspace<double>&);
template Generation<long double>& generation(Workspace<long double>&, int);
template RayQueue<long double>& refracted_queue(Workspace<long double>&);
template HitList<float>& hits(Workspace<float>&);
template HitList<double>& hits(Workspace<double>&);
template HitList<long double>& hits(Workspace<long double>&);
template MediumStacks& mediums(Workspace<float>&);
template MediumStacks& mediums(Workspace<double>&);
template MediumStacks& mediums(Workspace<long double>&);

}  // namespace strahl
