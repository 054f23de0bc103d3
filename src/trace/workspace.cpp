#include "trace/workspace.h"

#include <utility>

namespace strahl {
namespace {
constexpr std::size_t widest_pack = 16;
constexpr std::size_t room = batch_rays + 4 * widest_pack;  // whole packs are stored past the end
constexpr std::size_t most_keys = 128;
}  // namespace

int entered(Interiors& all, int list, int body) {
    const auto [entry, is_new] =
        all.known.try_emplace(std::uint64_t(list) << 32 | std::uint32_t(body), static_cast<int>(all.lists.size()));
    if (is_new) all.lists.push_back({list, body});
    return entry->second;
}

int left(Interiors& all, int list, int body) {
    if (list == 0) return 0;
    const auto [shorter, last] = all.lists[list];
    return last == body ? shorter : entered(all, left(all, shorter, body), last);
}

bool contains(const Interiors& all, int list, int body) {
    for (; list; list = all.lists[list].shorter)
        if (all.lists[list].body == body) return true;
    return false;
}

int innermost(const Interiors& all, int list) { return all.lists[list].body; }

template <class T>
Workspace<T>::Workspace() {
    values.resize(4 * room + most_keys * widest_pack);
    stretches.resize(2 * most_keys);
    T* const first = values.data();
    hits = {first, first + room, first + 2 * room, first + 3 * room, stretches.data(), stretches.data() + most_keys};
    pixels_x.resize(batch_pixels + widest_pack), pixels_y.resize(batch_pixels + widest_pack);
    rgb.resize(4 * batch_pixels);
}

template <class T>
RayQueue<T>& Workspace<T>::queue(int slot) {
    while (static_cast<int>(queues.size()) <= slot) {
        arrays.push_back(std::make_unique<std::vector<T>>(ray_arrays * room));
        T* next = arrays.back()->data();
        const auto array = [&] { return std::exchange(next, next + room); };
        auto made = std::make_unique<RayQueue<T>>();
        for (int c = 0; c < 3; ++c) made->origin[c] = array(), made->direction[c] = array();
        made->source = array(), made->pixel = array(), made->weight = array();
        made->path = array(), made->interior = array();
        made->capacity = batch_rays;
        queues.push_back(std::move(made));
    }
    return *queues[slot];
}

template <class T>
RayQueue<T>& queue(Workspace<T>& workspace, int slot) {
    return workspace.queue(slot);
}
template <class T>
HitList<T>& hits(Workspace<T>& workspace) {
    return workspace.hits;
}
template <class T>
Interiors& interiors(Workspace<T>& workspace) {
    return workspace.interiors;
}

template class Workspace<float>;
template class Workspace<double>;
template class Workspace<long double>;
template RayQueue<float>& queue(Workspace<float>&, int);
template RayQueue<double>& queue(Workspace<double>&, int);
template RayQueue<long double>& queue(Workspace<long double>&, int);
template HitList<float>& hits(Workspace<float>&);
template HitList<double>& hits(Workspace<double>&);
template HitList<long double>& hits(Workspace<long double>&);
template Interiors& interiors(Workspace<float>&);
template Interiors& interiors(Workspace<double>&);
template Interiors& interiors(Workspace<long double>&);

}  // namespace strahl
