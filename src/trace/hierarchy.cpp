#include "trace/hierarchy.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "trace/hierarchy_cut.h"
#include "trace/thread_pool.h"

namespace strahl {
namespace {

using namespace hierarchy_cut;

constexpr int leaf_items = 16;  // most items of a leaf
static_assert(leaf_items <= LeafCode::most_items);
constexpr float item_cost = .25f;    // of that of a binary node
constexpr int deepest_cut = 30;      // from this depth on, in the middle: 2^30 items have no more than 60 levels
constexpr int shared_items = 16384;  // on more than these all threads work together
constexpr int chunk_items = 8192;    // a thread's piece of such work

class Builder {
  public:
    Builder(std::span<ItemBox> boxes, ItemBox* room_for_them, double margin, ThreadPool& workers)
        : entries(boxes.data()), spare(room_for_them), pool(workers) {
        const auto size = static_cast<std::int32_t>(boxes.size());
        result.order = uninitialized_buffer<std::int32_t>(boxes.size());
        // Half a unit in the last place was lost when the corner was rounded, and half a one is lost here.
        const Quad grow = Quad{} + static_cast<float>(margin), units = Quad{} + 0x1p-22f;
        share_out(pool, size, chunk_items, [&](std::int32_t first, std::int32_t last) {
            for (ItemBox* e = entries + first; e < entries + last; ++e) {
                const Bounds box = bounds_of(*e);
                const Quad low = box.low - (grow + maximum(box.low, -box.low) * units);
                const Quad high = box.high + (grow + maximum(box.high, -box.high) * units);
                for (int c = 0; c < 3; ++c) e->low[c] = low[c], e->high[c] = high[c];
                e->item = static_cast<std::int32_t>(e - entries);
            }
        });
        std::vector<Node> top;
        node(part(entries, 0, size, 0), top, true);
        std::vector<std::vector<Node>> below(tasks.size());
        share_out(pool, static_cast<std::int32_t>(tasks.size()), 1, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) node(tasks[i].part, below[i], false);
        });
        std::size_t count = top.size();
        std::vector<std::size_t> starts;
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            top[tasks[i].node].first[tasks[i].child] = static_cast<std::int32_t>(count);
            starts.push_back(count);
            count += below[i].size();
        }
        result.nodes = uninitialized_buffer<Node>(count);
        result.size = static_cast<std::int32_t>(count);
        std::copy(top.begin(), top.end(), result.nodes.get());
        share_out(pool, static_cast<std::int32_t>(tasks.size()), 1, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) {
                for (Node& node : below[i])
                    for (int c = 0; c < node.children; ++c)
                        if (node.leaves[c] == 0) node.first[c] += static_cast<std::int32_t>(starts[i]);
                std::copy(below[i].begin(), below[i].end(), result.nodes.get() + starts[i]);
            }
        });
    }
    Hierarchy result;

  private:
    /// A node of the binary hierarchy: items [begin, end).
    struct Part {
        Extents extents;
        Cut cut;
        ItemBox* items;  // the array that they are in now
        std::int32_t begin, end;
        int depth;
        bool leaf;
        std::int32_t count() const { return end - begin; }
    };
    struct Task {
        Part part;
        std::size_t node;
        int child;
    };
    ItemBox* entries;
    ItemBox* spare;
    ThreadPool& pool;
    std::vector<Task> tasks;

    /// look(first, last) of a range; of a large one in pieces, by all threads.
    template <class Sum, class Look>
    Sum summed(std::int32_t begin, std::int32_t end, const Look& look) {
        if (end - begin <= shared_items) return look(begin, end);
        std::vector<Sum> sums((end - begin + chunk_items - 1) / chunk_items);
        share_out(pool, end - begin, chunk_items, [&](std::int32_t first, std::int32_t last) {
            sums[first / chunk_items] = look(begin + first, begin + last);
        });
        for (std::size_t i = 1; i < sums.size(); ++i) sums[0].add(sums[i]);
        return sums[0];
    }

    Part part(ItemBox* items, std::int32_t begin, std::int32_t end, int depth) {
        Part part{{}, {}, items, begin, end, depth, false};
        part.extents = summed<Extents>(begin, end, [items](std::int32_t first, std::int32_t last) {
            Extents sum;
            for (std::int32_t i = first; i < last; ++i) {
                const Bounds box = bounds_of(items[i]);
                sum.all.add(box), sum.middles.add(box.middle());
            }
            return sum;
        });
        const std::int32_t count = end - begin;
        if (depth < deepest_cut && count > 2) {
            const Scale scale(part.extents.middles, bins_for(count));
            const auto sort = [items, scale](std::int32_t first, std::int32_t last) {
                Bins sum(scale.bins);
                for (std::int32_t i = first; i < last; ++i) {
                    const Bounds box = bounds_of(items[i]);
                    const auto bin = __builtin_convertvector(scale(box), WholeQuad);
                    for (int axis = 0; axis < 3; ++axis)
                        sum.box[axis][bin[axis]].add(box), ++sum.count[axis][bin[axis]];
                }
                return sum;
            };
            part.cut = best_cut(summed<Bins>(begin, end, sort), count);
        }
        const float area = part.extents.all.half_area();
        part.leaf =
            count <= leaf_items && !(area + item_cost * part.cut.cost < item_cost * static_cast<float>(count) * area);
        if (part.leaf) {
            const auto [least, most] = std::minmax_element(
                items + begin, items + end, [](const ItemBox& a, const ItemBox& b) { return a.form < b.form; });
            if (least->form < most->form) part.leaf = false, part.cut = {0, by_form, least->form};
        }
        return part;
    }

    /// Items before the cut go to the front. What remains of `part` is the part before; the other is returned.
    Part open(Part& from) {
        ItemBox* items = from.items;
        std::int32_t at = from.begin + from.count() / 2;
        if (from.cut.axis == by_form) {
            const auto first = [form = from.cut.bin](const ItemBox& e) { return e.form == form; };
            at = static_cast<std::int32_t>(std::partition(items + from.begin, items + from.end, first) - items);
        } else if (from.cut.axis != in_the_middle) {
            const Scale scale(from.extents.middles, bins_for(from.count()));
            const auto before = [axis = from.cut.axis, low = scale.from[from.cut.axis],
                                 per_bin = scale.per_bin[from.cut.axis], bin = static_cast<float>(from.cut.bin)](
                                    const ItemBox& e) { return (e.low[axis] + e.high[axis] - low) * per_bin < bin; };
            if (from.count() <= shared_items) {
                at = static_cast<std::int32_t>(std::partition(items + from.begin, items + from.end, before) - items);
            } else {
                std::vector<std::int32_t> ends((from.count() + chunk_items - 1) / chunk_items + 1);
                share_out(pool, from.count(), chunk_items, [&](std::int32_t first, std::int32_t last) {
                    ends[first / chunk_items + 1] = static_cast<std::int32_t>(
                        std::count_if(items + from.begin + first, items + from.begin + last, before));
                });
                std::partial_sum(ends.begin(), ends.end(), ends.begin());
                at = from.begin + ends.back();
                ItemBox* const to = items == entries ? spare : entries;
                share_out(pool, from.count(), chunk_items, [&](std::int32_t first, std::int32_t last) {
                    ItemBox* left = to + from.begin + ends[first / chunk_items];
                    ItemBox* right = to + at + first - ends[first / chunk_items];
                    std::partition_copy(items + from.begin + first, items + from.begin + last, left, right, before);
                });
                items = to;
            }
        }
        const Part right = part(items, at, from.end, from.depth + 1);
        from = part(items, from.begin, at, from.depth + 1);
        return right;
    }

    /// Makes a wide node and what is below it; or if others can do that, leaves them tasks.
    std::int32_t node(const Part& root, std::vector<Node>& nodes, bool shared) {
        const std::size_t index = nodes.size();
        nodes.emplace_back();
        std::vector<Part> children;
        children.reserve(Node::width);
        children.push_back(root);
        while (children.size() < Node::width) {
            int largest = -1;
            float most = -1;
            for (std::size_t i = 0; i < children.size(); ++i) {
                const float area = children[i].extents.all.half_area();
                if (!children[i].leaf && area > most) largest = static_cast<int>(i), most = area;
            }
            if (largest < 0) break;
            // Beside each other, so that the order of the children is that of their items.
            const Part right = open(children[largest]);
            children.insert(children.begin() + largest + 1, right);
        }
        Node node{};
        node.children = static_cast<std::int32_t>(children.size());
        for (int i = 0; i < node.children; ++i) {
            const Part& child = children[i];
            for (int c = 0; c < 3; ++c)
                node.low[c][i] = child.extents.all.low[c], node.high[c][i] = child.extents.all.high[c];
            if (child.leaf) {
                node.first[i] = child.begin;
                node.leaves[i] =
                    static_cast<std::int16_t>(LeafCode::make(child.items[child.begin].form, child.count()));
                for (std::int32_t k = child.begin; k < child.end; ++k) result.order[k] = child.items[k].item;
            } else if (shared && child.count() <= shared_items) {
                tasks.push_back({child, index, i});
            } else {
                node.first[i] = this->node(child, nodes, shared);
            }
        }
        nodes[index] = node;
        return static_cast<std::int32_t>(index);
    }
};

}  // namespace

Hierarchy build_hierarchy(std::span<ItemBox> boxes, ItemBox* spare, double margin, ThreadPool& pool) {
    return std::move(Builder(boxes, spare, margin, pool).result);
}

}  // namespace strahl
