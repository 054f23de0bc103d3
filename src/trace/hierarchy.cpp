#include "trace/hierarchy.h"

#include <cmath>
#include <numeric>

namespace strahl {
namespace {

constexpr int bins = 16;
constexpr int leaf_items = 4;

double half_area(const Box& box) {
    if (box.empty()) return 0;
    const DVec3 s = box.size();
    return s.x * s.y + s.y * s.z + s.z * s.x;
}

template <class T>
class Builder {
  public:
    Builder(const std::vector<Box>& boxes, double margin) : boxes(boxes), margin(margin) {
        centres.reserve(boxes.size());
        for (const Box& box : boxes) centres.push_back(box.centre());
        result.order.resize(boxes.size());
        std::iota(result.order.begin(), result.order.end(), 0);
        result.nodes.reserve(boxes.size());
        result.nodes.emplace_back();
        split(0, 0, static_cast<int>(boxes.size()), 0);
    }
    Hierarchy<T> result;

  private:
    struct Cut {
        double cost = std::numeric_limits<double>::infinity();
        int axis = -1, bin = 0;
        double low = 0, per_bin = 0;
    };
    const std::vector<Box>& boxes;
    double margin;
    std::vector<DVec3> centres;

    static int bin_of(double centre, double low, double per_bin) {
        return std::min(bins - 1, static_cast<int>((centre - low) * per_bin));
    }

    /// The cheapest cut of items [begin, end) along the bins of one of the axes.
    Cut best_cut(int begin, int end, const Box& centre_box) const {
        Cut best;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = centre_box.low[axis], per_bin = bins / (centre_box.high[axis] - low);
            if (!std::isfinite(per_bin)) continue;
            Box box[bins];
            int count[bins] = {};
            for (int i = begin; i < end; ++i) {
                const int item = result.order[i], bin = bin_of(centres[item][axis], low, per_bin);
                box[bin].add(boxes[item]);
                ++count[bin];
            }
            double cost_left[bins];
            Box sum;
            for (int b = 0, n = 0; b + 1 < bins; ++b) {
                sum.add(box[b]), n += count[b];
                cost_left[b] = n * half_area(sum);
            }
            sum = {};
            for (int b = bins - 1, n = 0; b > 0; --b) {
                sum.add(box[b]), n += count[b];
                const double cost = cost_left[b - 1] + n * half_area(sum);
                if (n > 0 && n < end - begin && cost < best.cost) best = {cost, axis, b, low, per_bin};
            }
        }
        return best;
    }

    void set_box(Node<T>& node, const Box& box) const {
        for (int i = 0; i < 3; ++i) {
            node.low[i] = std::nextafter(static_cast<T>(box.low[i] - margin), -std::numeric_limits<T>::infinity());
            node.high[i] = std::nextafter(static_cast<T>(box.high[i] + margin), std::numeric_limits<T>::infinity());
        }
    }

    void split(int index, int begin, int end, int depth) {
        Box box, centre_box;
        for (int i = begin; i < end; ++i) {
            box.add(boxes[result.order[i]]);
            centre_box.add(centres[result.order[i]]);
        }
        set_box(result.nodes[index], box);
        const int count = end - begin;
        // Depth is bounded because traversal's stack is: past half of it, cut in the middle.
        const Cut cut = depth < 32 ? best_cut(begin, end, centre_box) : Cut{};
        const bool worth = count > leaf_items || cut.cost + half_area(box) < count * half_area(box);
        if (count == 1 || (count <= leaf_items && !(cut.axis >= 0 && worth))) {
            result.nodes[index].first = begin;
            result.nodes[index].count = static_cast<std::int16_t>(count);
            result.nodes[index].axis = 0;
            return;
        }
        auto* const order = result.order.data();
        int middle = (begin + end) / 2;
        if (cut.axis >= 0)
            middle = static_cast<int>(std::partition(order + begin, order + end,
                                                     [&](int item) {
                                                         return bin_of(centres[item][cut.axis], cut.low, cut.per_bin) <
                                                                cut.bin;
                                                     }) -
                                      order);
        const int first = static_cast<int>(result.nodes.size());
        result.nodes.resize(first + 2);
        result.nodes[index].first = first;
        result.nodes[index].count = 0;
        result.nodes[index].axis = static_cast<std::int16_t>(std::max(cut.axis, 0));
        split(first, begin, middle, depth + 1);
        split(first + 1, middle, end, depth + 1);
    }
};

}  // namespace

template <class T>
Hierarchy<T> build_hierarchy(const std::vector<Box>& boxes, double margin) {
    return std::move(Builder<T>(boxes, margin).result);
}
template Hierarchy<float> build_hierarchy(const std::vector<Box>&, double);
template Hierarchy<double> build_hierarchy(const std::vector<Box>&, double);
template Hierarchy<long double> build_hierarchy(const std::vector<Box>&, double);

}  // namespace strahl
