#include "trace/hierarchy.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

#include "trace/hierarchy_cut.h"
#include "trace/thread_pool.h"

namespace strahl {
namespace {

using namespace hierarchy_cut;

constexpr int leaf_items = 16;  // most items of a leaf
static_assert(leaf_items <= LeafCode::most_items);
constexpr int deepest_cut = 30;      // from this depth on, in the middle: 2^30 items have no more than 60 levels
constexpr int shared_items = 16384;  // on more than these all threads work together
constexpr int chunk_items = 8192;    // a thread's piece of such work

class Builder {
  public:
    Builder(Buffer<ItemBox> boxes, std::int32_t size, double margin, ThreadPool& workers)
        : entries(boxes.get()), pool(workers) {
        result.order = uninitialized_buffer<std::int32_t>(size);
        share_out(pool, size, chunk_items, [&](std::int32_t first, std::int32_t last) {
            for (ItemBox* e = entries + first; e < entries + last; ++e) {
                const Bounds box = grown(bounds_of(*e), margin);
                for (int c = 0; c < 3; ++c) e->low[c] = box.low[c], e->high[c] = box.high[c];
                e->item = static_cast<std::int32_t>(e - entries);
            }
        });
        std::vector<Node> top;
        node(part(0, size, 0), top, true);
        std::vector<std::vector<Node>> below(tasks.size());
        share_out(pool, static_cast<std::int32_t>(tasks.size()), 1, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) node(tasks[i].part, below[i], false), below[i].shrink_to_fit();
        });
        boxes.reset();
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

    Part part(std::int32_t begin, std::int32_t end, int depth) {
        Part part{{}, {}, begin, end, depth, false};
        part.extents = summed<Extents>(begin, end, [this](std::int32_t first, std::int32_t last) {
            Extents sum;
            for (std::int32_t i = first; i < last; ++i) {
                const Bounds box = bounds_of(entries[i]);
                sum.all.add(box), sum.middles.add(box.middle());
            }
            return sum;
        });
        const std::int32_t count = end - begin;
        if (depth < deepest_cut && count > 2) {
            const BinScale scale(part.extents.middles, bins_for(count));
            const auto sort = [this, scale](std::int32_t first, std::int32_t last) {
                Bins sum(scale.bins);
                for (std::int32_t i = first; i < last; ++i) {
                    const Bounds box = bounds_of(entries[i]);
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
                entries + begin, entries + end, [](const ItemBox& a, const ItemBox& b) { return a.form < b.form; });
            if (least->form < most->form) part.leaf = false, part.cut = {0, by_form, least->form};
        }
        return part;
    }

    /// Items of a range for which `before` holds go to the front. Where the others begin.
    template <class Before>
    std::int32_t divide(std::int32_t begin, std::int32_t end, const Before& before) {
        const auto partition = [&](std::int32_t first, std::int32_t last) {
            return static_cast<std::int32_t>(std::partition(entries + first, entries + last, before) - entries);
        };
        if (end - begin <= shared_items) return partition(begin, end);
        std::vector<std::int32_t> cuts((end - begin + chunk_items - 1) / chunk_items);
        share_out(pool, end - begin, chunk_items, [&](std::int32_t first, std::int32_t last) {
            cuts[first / chunk_items] = partition(begin + first, begin + last);
        });
        const auto chunk = [&](std::size_t i) { return begin + static_cast<std::int32_t>(i) * chunk_items; };
        std::int32_t at = begin;
        for (std::size_t i = 0; i < cuts.size(); ++i) at += cuts[i] - chunk(i);
        // What lies on the wrong side, in one chunk after the other, changes places.
        struct Range {
            std::int32_t first, last;
        };
        std::vector<Range> left, right;
        for (std::size_t i = 0; i < cuts.size(); ++i) {
            const std::int32_t last = std::min(chunk(i + 1), end);
            if (cuts[i] < std::min(last, at)) left.push_back({cuts[i], std::min(last, at)});
            if (cuts[i] > std::max(chunk(i), at)) right.push_back({std::max(chunk(i), at), cuts[i]});
        }
        struct Exchange {
            std::int32_t left, right, count;
        };
        std::vector<Exchange> exchanges;
        for (std::size_t i = 0, k = 0; i < left.size(); i += left[i].first == left[i].last) {
            const std::int32_t count = std::min(left[i].last - left[i].first, right[k].last - right[k].first);
            exchanges.push_back({left[i].first, right[k].first, count});
            left[i].first += count, right[k].first += count;
            k += right[k].first == right[k].last;
        }
        share_out(pool, static_cast<std::int32_t>(exchanges.size()), 1, [&](std::int32_t i, std::int32_t) {
            ItemBox* const first = entries + exchanges[i].left;
            std::swap_ranges(first, first + exchanges[i].count, entries + exchanges[i].right);
        });
        return at;
    }

    /// Items before the cut go to the front. What remains of `part` is the part before; the other is returned.
    Part open(Part& from) {
        std::int32_t at = from.begin + from.count() / 2;
        if (from.cut.axis == by_form) {
            at = divide(from.begin, from.end, [form = from.cut.bin](const ItemBox& e) { return e.form == form; });
        } else if (from.cut.axis != in_the_middle) {
            const BinScale scale(from.extents.middles, bins_for(from.count()));
            at = divide(from.begin, from.end,
                        [axis = from.cut.axis, low = scale.from[from.cut.axis],
                         per_bin = scale.per_bin[from.cut.axis], bin = static_cast<float>(from.cut.bin)](
                            const ItemBox& e) { return (e.low[axis] + e.high[axis] - low) * per_bin < bin; });
        }
        const Part right = part(at, from.end, from.depth + 1);
        from = part(from.begin, at, from.depth + 1);
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
                    static_cast<std::int16_t>(LeafCode::make(entries[child.begin].form, child.count()));
                for (std::int32_t k = child.begin; k < child.end; ++k) result.order[k] = entries[k].item;
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

Hierarchy build_hierarchy(Buffer<ItemBox> boxes, std::int32_t size, double margin, ThreadPool& pool) {
    return std::move(Builder(std::move(boxes), size, margin, pool).result);
}

}  // namespace strahl
