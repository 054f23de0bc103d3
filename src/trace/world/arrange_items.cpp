// Puts items into their places: removes duplicates, makes leaves of items that lie side by side, and numbers the bins.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "trace/hierarchy/cut_triangles.h"
#include "trace/world/duplicate_bodies.h"
#include "trace/world/world_arrays.h"

namespace strahl {
namespace {

bool finite(const ItemBox& box) {
    bool all = true;
    for (int c = 0; c < 3; ++c) all &= std::isfinite(box.high[c] - box.low[c]);
    return all;
}

/// Removes the items whose numbers are given, ascending. The others move together, and what was removed comes after
/// them if it is to be kept. Returns how many others there are.
template <class T>
int remove_items(FormItems<T>& own, int fields, const std::vector<std::int32_t>& removed, bool keep = false) {
    int left = removed.empty() ? own.count : removed[0];
    std::vector<T> behind;
    for (const std::int32_t i : removed)
        if (keep) behind.insert(behind.end(), &own.numbers[i * fields], &own.numbers[(i + 1) * fields]);
    for (std::size_t i = 0; i < removed.size(); ++i)
        for (int from = removed[i] + 1; from < (i + 1 < removed.size() ? removed[i + 1] : own.count); ++from, ++left) {
            std::copy_n(&own.numbers[from * fields], fields, &own.numbers[left * fields]);
            own.boxes[left] = own.boxes[from];
        }
    std::copy(behind.begin(), behind.end(), &own.numbers[left * fields]);
    return left;
}

}  // namespace

/// Adds the items of the leaves once more, field by field, see Group::columns.
template <class T>
void WorldArrays<T>::add_columns(const Hierarchy& of, ThreadPool& pool) {
    share_out(pool, of.size, 256, [&](std::int32_t first, std::int32_t last) {
        for (const Node* node = &of.nodes[first]; node < &of.nodes[last]; ++node)
            for (int c = 0; c < node->children; ++c) {
                if (node->leaves[c] == 0) continue;
                const FormItems<T>& own = forms[LeafCode::form(node->leaves[c])];
                const int fields = traits[LeafCode::form(node->leaves[c])].fields;
                const int items = LeafCode::items(node->leaves[c]);
                const std::size_t start = std::size_t(node->first[c]) * fields;
                for (int i = 0; i < items; ++i)
                    for (int f = 0; f < fields; ++f)
                        own.columns[start + f * items + i] = own.numbers[start + i * fields + f];
            }
    });
}

/// Replaces the boxes of long triangles by those of their pieces, if that pays: if a ray that meets the box around all
/// items is expected to meet more than 12 boxes in vain, pieces are much smaller, and not too many. The box of the
/// first piece takes the place of the triangle's, and the other pieces' follow all boxes; returns the items of the
/// latter.
template <class T>
std::vector<std::int32_t> WorldArrays<T>::cut_boxes(const std::array<std::int32_t, Forms::size + 1>& starts,
                                                    ThreadPool& pool) {
    constexpr double many = 12, small = 1e-3, smaller = 4;
    constexpr int triangle_forms[]{place_of<Form<Triangle, 0>>(Forms{}), place_of<Form<SmoothTriangle, 0>>(Forms{})};
    if (std::ranges::none_of(triangle_forms, [&](int form) { return forms[form].in_hierarchy > 0; })) return {};
    const SumOfAreas areas(boxes.get(), starts.back(), pool);
    if (!(areas.sum > many * areas.whole)) return {};
    std::vector<LongTriangles<T>> found;
    double sums[3]{};
    for (const int form : triangle_forms) {
        found.push_back({forms[form].numbers.get(), std::size_t(traits[form].fields), boxes.get(), starts[form],
                         forms[form].in_hierarchy, small * areas.whole});
        found.back().measure(pool, sums);
    }
    const auto [long_ones, too_large, estimate] = sums;
    if (too_large < many * areas.whole || too_large < smaller * small * areas.whole * long_ones ||
        estimate > share_items + starts.back() / 2.)
        return {};
    TrianglePieces pieces;
    for (const LongTriangles<T>& some : found) some.cut(pool, pieces);
    std::vector<std::int32_t> copies;
    Buffer<ItemBox> longer = uninitialized_buffer<ItemBox>(starts.back() + pieces.of.size());
    std::copy_n(boxes.get(), starts.back(), longer.get());
    for (std::size_t i = 0; i < pieces.of.size(); ++i) {
        const bool first = i == 0 || pieces.of[i] != pieces.of[i - 1];
        longer[first ? pieces.of[i] : starts.back() + copies.size()] = pieces.boxes[i];
        if (!first) copies.push_back(pieces.of[i]);
    }
    boxes = std::move(longer);
    return copies;
}

/// Makes one hierarchy of all bounded items, and puts these into the order of its leaves. Long triangles, unless they
/// are to be left `whole`, are put there several times: these copies have the same number of their surface, by which
/// rays tell bodies apart, and so are one.
template <class T>
void WorldArrays<T>::make_hierarchy(ThreadPool& pool, bool whole) {
    std::array<std::int32_t, Forms::size + 1> starts{};
    for (int form = 0; form < Forms::size; ++form) {
        FormItems<T>& own = forms[form];
        if (traits[form].bounded) {
            std::vector<std::int32_t> unbounded;
            for (int i = 0; i < own.count; ++i)
                if (!finite(own.boxes[i])) unbounded.push_back(i);
            own.in_hierarchy = remove_items(own, traits[form].fields, unbounded, true);
        }
        starts[form + 1] = starts[form] + own.in_hierarchy;
    }
    std::int32_t size = starts.back();
    if (size == 0) return;
    for (int form = 0; form < Forms::size; ++form)
        if (forms[form].boxes != &boxes[starts[form]])
            std::copy_n(forms[form].boxes, forms[form].in_hierarchy, &boxes[starts[form]]);
    const std::vector<std::int32_t> copies = whole ? std::vector<std::int32_t>() : cut_boxes(starts, pool);
    size += static_cast<std::int32_t>(copies.size());
    // The order of transparent bodies in the leaves is that in which their colours are multiplied: it must not change,
    // neither from moment to moment nor with the number of lanes.
    hierarchy = moving && !world.transparent
                    ? moving->fit(std::move(boxes), starts, rounding(reach), pool)
                    : build_hierarchy(std::move(boxes), size, rounding(reach), pool, world.transparent ? 1 : lanes);
    if (!moving && size > share_items) os::trim_memory();  // a moving scene would need this memory again at once

    if (!copies.empty())
        for (std::int32_t* item = hierarchy.order.get(); item < hierarchy.order.get() + size; ++item)
            if (*item >= starts.back()) *item = copies[*item - starts.back()];

    // Item i in the order of the leaves becomes item places[i] of its form.
    const auto form_at = [&](std::int32_t i) {
        return static_cast<int>(std::upper_bound(starts.begin(), starts.end(), hierarchy.order[i]) - starts.begin()) -
               1;
    };
    Buffer<std::int32_t> places = uninitialized_buffer<std::int32_t>(size);
    Buffer<std::uint8_t> form_of = uninitialized_buffer<std::uint8_t>(size);
    share_out(pool, size, share_items, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t i = first; i < last; ++i) form_of[i] = static_cast<std::uint8_t>(form_at(i));
    });
    std::array<std::int32_t, Forms::size> next{};
    for (std::int32_t i = 0; i < size; ++i) places[i] = next[form_of[i]]++;
    share_out(pool, hierarchy.size, 256, [&](std::int32_t first, std::int32_t last) {
        for (Node* node = &hierarchy.nodes[first]; node < &hierarchy.nodes[last]; ++node)
            for (int c = 0; c < node->children; ++c)
                if (node->leaves[c] != 0) node->first[c] = places[node->first[c]];
    });
    std::array<Buffer<T>, Forms::size> sorted;
    for (int form = 0; form < Forms::size; ++form)
        sorted[form] = uninitialized_buffer<T>(
            std::size_t(next[form] + forms[form].count - forms[form].in_hierarchy + widest_pack) * traits[form].fields);
    share_out(pool, size, share_items, [&](std::int32_t first, std::int32_t last) {
        for (std::int32_t i = first; i < last; ++i) {
            const int form = form_of[i];
            const std::size_t fields = traits[form].fields;
            std::copy_n(&forms[form].numbers[(hierarchy.order[i] - starts[form]) * fields], fields,
                        &sorted[form][places[i] * fields]);
        }
    });
    for (int form = 0; form < Forms::size; ++form) {
        FormItems<T>& own = forms[form];
        const std::size_t fields = traits[form].fields;
        std::copy(&own.numbers[own.in_hierarchy * fields], &own.numbers[own.count * fields],
                  &sorted[form][next[form] * fields]);
        // The columns take over the memory: the system would have to clear new memory first.
        own.columns = std::exchange(own.numbers, std::move(sorted[form]));
        if (const int more = next[form] - own.in_hierarchy; more > 0) {
            own.in_hierarchy += more, own.count += more, own.copied = true;
            own.columns = uninitialized_buffer<T>(std::size_t(own.count + widest_pack) * fields);
        }
        std::fill_n(&own.columns[own.in_hierarchy * fields], widest_pack, T(0));
    }
    hierarchy.order.reset();
    places.reset(), form_of.reset();
    add_columns(hierarchy, pool);
    world.nodes = hierarchy.nodes.get();
}

/// Numbers the bins, and notes for each surface where its item is.
template <class T>
void WorldArrays<T>::number_bins(ThreadPool& pool) {
    references = uninitialized_buffer<ItemReference>(surfaces + 1);
    world.references = &references[1];
    share_out(pool, surfaces + 1, 16 * share_items, [&](std::int32_t first, std::int32_t last) {
        std::fill(&references[first], &references[last], ItemReference{-1, -1});
    });
    if (!std::ranges::all_of(finishes.list, &FinishKernel<T>::plain)) {
        finishes.finished.resize(surfaces);
        world.finishes.finished = finishes.finished.data();
    }
    constexpr int shared_form = place_of<SharedMeshForm>(Forms{});
    int hierarchy_forms = 0;
    for (int form = 0; form < Forms::size; ++form) {
        const FormItems<T>& own = forms[form];
        const std::size_t fields = traits[form].fields;
        const int first_bin = static_cast<int>(sort_bins.size());
        if (!world.bin_per_item) {
            if (own.in_hierarchy > 0) hierarchy_forms += 1, world.hierarchy_bin = first_bin;
            sort_bins.push_back({form});
            if (!traits[form].hot && own.in_hierarchy < own.count)
                loops.push_back({form, own.in_hierarchy, own.count - own.in_hierarchy});
        } else {
            for (int i = 0; i < own.count; ++i) {
                const int material = static_cast<int>(own.numbers[i * fields + fields - 1]);
                const BodySet body = BodySet(1) << sort_bins.size();
                if (materials[material].refraction > 0 && !traits[form].listed) few.glass |= body;
                if (!traits[form].hot) world.few.cold |= body;
                if (traits[form].convex) world.few.convex |= body;
                sort_bins.push_back({form, i, traits[form].listed || form == shared_form ? -1 : material});
            }
        }
        // The last of several copies of a triangle is the one that surfaces refer to.
        share_out(pool, own.count, own.copied ? own.count : share_items, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) {
                const int mesh = form == shared_form ? static_cast<int>(own.numbers[i * fields]) : -1;
                const int faces = mesh < 0 ? traits[form].faces : placed_meshes[mesh].surfaces;
                for (int face = 0; face < faces; ++face) {
                    const int surface = static_cast<int>(own.numbers[i * fields + fields - 2]) + face;
                    references[1 + surface] = {i, world.bin_per_item ? first_bin + i : first_bin};
                    if (world.finishes.finished)
                        finishes.finished[surface] = !is_plain(static_cast<int>(own.numbers[i * fields + fields - 1]));
                }
            }
        });
    }
    if (hierarchy_forms > 1 || forms[place_of<CompositeForm>(Forms{})].count > 0) world.hierarchy_bin = -1;
    world.loops = loops.data();
    world.loop_count = static_cast<int>(loops.size());
    world.beyond_loops = world.nodes || world.few.cold || !loops.empty();
}

template <class T>
void WorldArrays<T>::arrange_items(ThreadPool& pool, bool proves) {
    int items = 0;
    for (int form = 0; form < Forms::size; ++form) {
        FormItems<T>& own = forms[form];
        const int fields = traits[form].fields;
        own.count = remove_items(own, fields, duplicates(own.numbers.get(), own.count, fields, fields - 2, pool));
        items += own.count;
    }
    const bool composites = forms[place_of<CompositeForm>(Forms{})].count > 0;
    world.bin_per_item = items <= (composites ? most_item_bins - Forms::size : most_item_bins);
    if (!world.bin_per_item) make_hierarchy(pool, proves || moving || world.transparent);
    number_bins(pool);
}

template void WorldArrays<float>::arrange_items(ThreadPool&, bool);
template void WorldArrays<float>::add_columns(const Hierarchy&, ThreadPool&);
template void WorldArrays<double>::arrange_items(ThreadPool&, bool);
template void WorldArrays<double>::add_columns(const Hierarchy&, ThreadPool&);
template void WorldArrays<long double>::arrange_items(ThreadPool&, bool);
template void WorldArrays<long double>::add_columns(const Hierarchy&, ThreadPool&);

}  // namespace strahl
