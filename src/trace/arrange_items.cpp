// Items get their places: duplicates go, leaves of the hierarchy hold items that lie side by side, bins are numbered.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "trace/duplicates.h"
#include "trace/world_arrays.h"

namespace strahl {
namespace {

bool finite(const ItemBox& box) {
    bool all = true;
    for (int c = 0; c < 3; ++c) all &= std::isfinite(box.high[c] - box.low[c]);
    return all;
}

/// Removes the items whose numbers are given, ascending, or moves them behind the others. How many others are there?
template <class Arrays>
int remove_items(Arrays& own, int count, const std::vector<std::int32_t>& removed, bool keep_behind = false) {
    int kept = removed.empty() ? count : removed[0];
    std::vector<typename std::remove_cvref_t<decltype(own.items[0])>> behind;
    for (const std::int32_t i : removed)
        if (keep_behind) behind.push_back(own.items[i]);
    for (std::size_t i = 0; i < removed.size(); ++i)
        for (int from = removed[i] + 1; from < (i + 1 < removed.size() ? removed[i + 1] : count); ++from, ++kept)
            own.items[kept] = own.items[from], own.boxes[kept] = own.boxes[from];
    std::copy(behind.begin(), behind.end(), &own.items[kept]);
    return kept;
}

/// The same items once more, field by field.
template <class T, class I>
Buffer<T> columns_of(const I* items, int count, std::size_t stride, ThreadPool& pool) {
    constexpr std::size_t fields = sizeof(I) / sizeof(T);
    Buffer<T> columns = uninitialized_buffer<T>(fields * stride);
    share_out(pool, count, share_items, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t i = first; i < last; ++i) {
            const auto values = std::bit_cast<std::array<T, fields>>(items[i]);
            for (std::size_t f = 0; f < fields; ++f) columns[f * stride + i] = values[f];
        }
    });
    for (std::size_t f = 0; f < fields; ++f) std::fill_n(&columns[f * stride + count], stride - count, T(0));
    return columns;
}

/// What is around a kernel, from its box if need be, whose corners may be off by `slack`.
template <class Kind, class K>
BoundingVolume bounding_volume_of(const K& kernel, const ItemBox& rounded, double slack) {
    Box box;
    for (int c = 0; c < 3; ++c) box.low[c] = rounded.low[c] - slack, box.high[c] = rounded.high[c] + slack;
    if constexpr (!Kind::bounded) {
        return {box, {}, true, to_double(kernel.normal), static_cast<double>(kernel.distance)};
    } else if constexpr (requires { kernel.ball(); }) {
        return {box, kernel.ball()};
    } else {
        const DVec3 size = box.size();
        return {box, {box.centre(), std::hypot(size.x, size.y, size.z) / 2}};
    }
}

}  // namespace

/// One hierarchy of all bounded items, which are put into the order of its leaves.
template <class T>
void WorldArrays<T>::make_hierarchy(ThreadPool& pool) {
    std::array<std::int32_t, Forms::size + 1> starts{};
    each_form([&](auto& own, auto& group, int number) {
        group.in_hierarchy = 0;
        if constexpr (std::remove_cvref_t<decltype(own)>::Form::Kind::bounded) {
            std::vector<std::int32_t> unbounded;
            for (int i = 0; i < group.count; ++i)
                if (!finite(own.boxes[i])) unbounded.push_back(i);
            group.in_hierarchy = remove_items(own, group.count, unbounded, true);
        }
        starts[number + 1] = starts[number] + group.in_hierarchy;
    });
    const std::int32_t size = starts.back();
    if (size == 0) return;
    const Buffer<ItemBox> boxes = uninitialized_buffer<ItemBox>(size), spare = uninitialized_buffer<ItemBox>(size);
    each_form([&](auto& own, auto& group, int number) {
        share_out(pool, group.in_hierarchy, share_items, [&](std::int32_t first, std::int32_t last) {
            std::copy(&own.boxes[first], &own.boxes[last], &boxes[starts[number] + first]);
        });
    });
    hierarchy = build_hierarchy({boxes.get(), std::size_t(size)}, spare.get(), rounding(reach), pool);

    // Place i in the order of the leaves is place places[i] among the items of a form.
    const auto form_at = [&](std::int32_t i) {
        return std::upper_bound(starts.begin(), starts.end(), hierarchy.order[i]) - starts.begin() - 1;
    };
    std::vector<std::int32_t> places(size);
    std::array<std::int32_t, Forms::size> next{};
    for (std::int32_t i = 0; i < size; ++i) places[i] = next[form_at(i)]++;
    share_out(pool, hierarchy.size, 256, [&](std::int32_t first, std::int32_t last) {
        for (Node* node = &hierarchy.nodes[first]; node < &hierarchy.nodes[last]; ++node)
            for (int c = 0; c < node->children; ++c)
                if (node->leaves[c] != 0) node->first[c] = places[node->first[c]];
    });
    each_form([&](auto& own, auto& group, int number) {
        if (group.in_hierarchy == 0) return;
        auto sorted = uninitialized_buffer<std::remove_cvref_t<decltype(own.items[0])>>(group.count + widest_pack);
        share_out(pool, size, share_items, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i)
                if (form_at(i) == number) sorted[places[i]] = own.items[hierarchy.order[i] - starts[number]];
        });
        std::copy(&own.items[group.in_hierarchy], &own.items[group.count], &sorted[group.in_hierarchy]);
        own.items = std::move(sorted);
        group.stride = group.count + widest_pack;
        own.columns = columns_of<T>(own.items.get(), group.count, group.stride, pool);
        group.columns = own.columns.get();
    });
    hierarchy.order.reset();
    world.nodes = hierarchy.nodes.get();
}

template <class T>
void WorldArrays<T>::arrange_items(ThreadPool& pool) {
    int items = 0;
    each_form([&](auto& own, auto& group, int) {
        group.count = remove_items(own, group.count, duplicates<T>(own.items.get(), group.count, pool));
        items += group.count;
    });
    world.bin_per_item = items <= most_item_bins;
    if (!world.bin_per_item) make_hierarchy(pool);

    references = uninitialized_buffer<ItemReference>(surfaces);
    share_out(pool, surfaces, 16 * share_items, [&](std::int32_t first, std::int32_t last) {
        std::fill(&references[first], &references[last], ItemReference{-1, -1});
    });
    each_form([&](auto& own, auto& group, int number) {
        using Form = typename std::remove_cvref_t<decltype(own)>::Form;
        group.items = own.items.get();
        group.first_bin = static_cast<int>(sort_bins.size());
        if (!world.bin_per_item) {
            sort_bins.push_back({number});
            if (!Form::hot && group.in_hierarchy < group.count)
                loops.push_back({number, group.in_hierarchy, group.count - group.in_hierarchy});
        } else {
            for (int i = 0; i < group.count; ++i) {
                const int material = static_cast<int>(group.items[i].material);
                const BodySet body = BodySet(1) << sort_bins.size();
                if (materials[material].refraction > 0) glass |= body;
                if (!Form::hot) world.cold |= body;
                if (Form::Kind::convex) world.convex |= body;
                sort_bins.push_back({number, i, material});
                volumes.push_back(
                    bounding_volume_of<typename Form::Kind>(own.items[i].shape, own.boxes[i], reach * 0x1p-23));
            }
        }
        group.last_bin = static_cast<int>(sort_bins.size());
        own.boxes.reset();
        share_out(pool, group.count, share_items, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i)
                for (int face = 0; face < Form::Kind::faces; ++face)
                    references[static_cast<int>(group.items[i].surface) + face] = {
                        i, world.bin_per_item ? group.first_bin + i : group.first_bin};
        });
    });
    world.references = references.get();
    world.sort_bins = sort_bins.data();
    world.bins = static_cast<int>(sort_bins.size());
    world.loops = loops.data();
    world.loop_count = static_cast<int>(loops.size());
    world.beyond_loops = world.nodes || world.cold || !loops.empty();
}

template void WorldArrays<float>::arrange_items(ThreadPool&);
template void WorldArrays<double>::arrange_items(ThreadPool&);
template void WorldArrays<long double>::arrange_items(ThreadPool&);

}  // namespace strahl
