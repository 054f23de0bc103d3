#include "trace/hierarchy.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

#include "trace/thread_pool.h"

namespace strahl {
namespace {

constexpr int bins = 16;
constexpr int leaf_items = 8;     // most items of a leaf
constexpr float item_cost = .5f;  // of that of a binary node
constexpr int deepest_cut = 30;   // from this depth on, in the middle: 2^30 items have no more than 60 levels
constexpr int task_items = 8192;  // fewer are not worth sharing out

constexpr float infinity = std::numeric_limits<float>::infinity();

struct FloatBox {
    float low[3]{infinity, infinity, infinity}, high[3]{-infinity, -infinity, -infinity};

    void add(const FloatBox& b) {
        for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], b.low[i]), high[i] = std::max(high[i], b.high[i]);
    }
    float half_area() const {
        const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
        return x < 0 ? 0 : x * y + y * z + z * x;
    }
    /// Twice the centre.
    float middle(int axis) const { return low[axis] + high[axis]; }
};

struct Entry {
    FloatBox box;
    std::int32_t item;
};

/// Of a range of entries; a leaf's `right` is 0. The left child of node n is n + 1.
struct Binary {
    FloatBox box;
    std::int32_t begin, end;
    std::int64_t right;
};

class Builder {
  public:
    Builder(const std::vector<Box>& boxes, double margin, ThreadPool& pool)
        : entries(boxes.size()), binary(new Binary[2 * boxes.size()]) {
        const auto size = static_cast<std::int32_t>(boxes.size());
        for (std::int32_t i = 0; i < size; ++i) {
            entries[i].item = i;
            for (int c = 0; c < 3; ++c) {
                entries[i].box.low[c] = std::nextafter(static_cast<float>(boxes[i].low[c] - margin), -infinity);
                entries[i].box.high[c] = std::nextafter(static_cast<float>(boxes[i].high[c] + margin), infinity);
            }
        }
        largest_task = std::max(task_items, size / (8 * pool.size()));
        split({0, 0, size, 0}, true);
        std::atomic<std::size_t> next{0};
        pool.run([&](int) {
            for (std::size_t i; (i = next++) < tasks.size();) split(tasks[i], false);
        });
        result.nodes.emplace_back();
        widen(0, 0);
        result.order.reserve(entries.size());
        for (const Entry& entry : entries) result.order.push_back(entry.item);
    }
    Hierarchy result;

  private:
    struct Task {
        std::int64_t node;
        std::int32_t begin, end;
        int depth;
    };
    struct Cut {
        float cost = infinity;
        int axis = -1, bin = 0;
        float low = 0, per_bin = 0;
        int bin_of(const FloatBox& box) const {
            return std::min(bins - 1, static_cast<int>((box.middle(axis) - low) * per_bin));
        }
    };
    std::vector<Entry> entries;
    std::unique_ptr<Binary[]> binary;
    std::vector<Task> tasks;
    std::int32_t largest_task;

    /// The cheapest cut along the bins of one of the axes; its cost is in boxes' half areas.
    Cut best_cut(std::int32_t begin, std::int32_t end, const float (&low)[3], const float (&high)[3]) const {
        FloatBox box[3][bins];
        std::int32_t count[3][bins] = {};
        Cut axes[3];
        for (int axis = 0; axis < 3; ++axis) {
            axes[axis] = {infinity, axis, 0, low[axis], bins / (high[axis] - low[axis])};
            if (!std::isfinite(axes[axis].per_bin)) axes[axis].per_bin = 0;
        }
        for (std::int32_t i = begin; i < end; ++i)
            for (const Cut& cut : axes) {
                const int bin = cut.bin_of(entries[i].box);
                box[cut.axis][bin].add(entries[i].box);
                ++count[cut.axis][bin];
            }
        Cut best;
        for (Cut& cut : axes) {
            float cost_left[bins];
            FloatBox sum;
            std::int32_t n = 0;
            for (int b = 0; b + 1 < bins; ++b) {
                sum.add(box[cut.axis][b]), n += count[cut.axis][b];
                cost_left[b] = static_cast<float>(n) * sum.half_area();
            }
            sum = {}, n = 0;
            for (int b = bins - 1; b > 0; --b) {
                sum.add(box[cut.axis][b]), n += count[cut.axis][b];
                cut.cost = cost_left[b - 1] + static_cast<float>(n) * sum.half_area();
                cut.bin = b;
                if (n > 0 && n < end - begin && cut.cost < best.cost) best = cut;
            }
        }
        return best;
    }

    /// Makes the nodes of a range: all of them, or if they are to be `shared`, down to those that are tasks.
    void split(const Task& task, bool shared) {
        const auto [index, begin, end, depth] = task;
        const std::int32_t count = end - begin;
        if (shared && count <= largest_task) {
            tasks.push_back(task);
            return;
        }
        Binary& node = binary[index];
        node.box = {};
        FloatBox middles;
        for (std::int32_t i = begin; i < end; ++i) {
            node.box.add(entries[i].box);
            for (int c = 0; c < 3; ++c) {
                middles.low[c] = std::min(middles.low[c], entries[i].box.middle(c));
                middles.high[c] = std::max(middles.high[c], entries[i].box.middle(c));
            }
        }
        node.begin = begin, node.end = end, node.right = 0;
        if (count == 1) return;
        const Cut cut = depth < deepest_cut ? best_cut(begin, end, middles.low, middles.high) : Cut{};
        const float area = node.box.half_area();
        if (count <= leaf_items && !(area + item_cost * cut.cost < item_cost * static_cast<float>(count) * area))
            return;
        auto middle = entries.begin() + begin + count / 2;
        if (cut.axis >= 0)
            middle = std::partition(entries.begin() + begin, entries.begin() + end,
                                    [&](const Entry& entry) { return cut.bin_of(entry.box) < cut.bin; });
        const auto at = static_cast<std::int32_t>(middle - entries.begin());
        node.right = index + 2 * std::int64_t(at - begin);
        split({index + 1, begin, at, depth + 1}, shared);
        split({node.right, at, end, depth + 1}, shared);
    }

    /// Makes a wide node of a binary one and what is below it.
    void widen(std::int64_t root, std::size_t index) {
        std::int64_t children[Node::width]{root};
        int count = 1;
        while (count < Node::width) {
            int largest = -1;
            for (int i = 0; i < count; ++i)
                if (binary[children[i]].right &&
                    (largest < 0 || binary[children[i]].box.half_area() > binary[children[largest]].box.half_area()))
                    largest = i;
            if (largest < 0) break;
            // Beside each other, so that the order of the children is that of their items.
            std::copy_backward(children + largest + 1, children + count, children + count + 1);
            children[largest + 1] = binary[children[largest]].right;
            children[largest] += 1;
            ++count;
        }
        Node node{};
        node.children = count;
        for (int i = 0; i < count; ++i) {
            const Binary& child = binary[children[i]];
            for (int c = 0; c < 3; ++c) node.low[c][i] = child.box.low[c], node.high[c][i] = child.box.high[c];
            if (child.right == 0) {
                node.first[i] = child.begin;
                node.count[i] = static_cast<std::int16_t>(child.end - child.begin);
                continue;
            }
            node.first[i] = static_cast<std::int32_t>(result.nodes.size());
            result.nodes.emplace_back();
            widen(children[i], result.nodes.size() - 1);
        }
        result.nodes[index] = node;
    }
};

}  // namespace

Hierarchy build_hierarchy(const std::vector<Box>& boxes, double margin, ThreadPool& pool) {
    return std::move(Builder(boxes, margin, pool).result);
}

}  // namespace strahl
