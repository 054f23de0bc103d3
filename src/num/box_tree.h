// Boxes in a binary tree, in which pairs that meet are found without looking at all pairs.
#pragma once
#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "num/bounding_box.h"

namespace strahl {

/// Orders items so that neither the first `half` nor the others have items on the other's side, along the axis on which
/// their positions are spread the furthest. Positions that are not finite do not count for the choice of the axis.
template <class Item, class Position>
void halve(std::span<Item> items, std::size_t half, const Position& position) {
    Box all;
    bool finite = true;
    for (const Item& item : items) {
        const DVec3 p = position(item);
        if (std::isfinite(p.x + p.y + p.z))
            all.add(p);
        else
            finite = false;
    }
    const DVec3 size = all.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto divide = [&](const auto& is_before) {
        std::nth_element(items.begin(), items.begin() + std::ptrdiff_t(half), items.end(),
                         [&](const Item& a, const Item& b) { return is_before(position(a)[axis], position(b)[axis]); });
    };
    if (finite)
        divide([](double a, double b) { return a < b; });
    else
        divide([](double a, double b) { return std::strong_order(a, b) < 0; });
}

/// Boxes halved down to single ones, with a box around each half. Two halves are compared only where a visitor finds
/// that they may matter: where few boxes meet, n of them take time n log n however they lie.
class BoxTree {
  public:
    explicit BoxTree(std::vector<Box> all) : boxes(std::move(all)), around(4 * boxes.size() + 1) {
        std::vector<Corner> corners;
        for (const Box& box : boxes) corners.push_back({box.low, corners.size()});
        if (!boxes.empty()) build(root(), corners);
        for (const Corner& own : corners) order.push_back(own.box);
    }

    /// Some of the boxes, which follow each other in the tree's order.
    struct Subtree {
        std::size_t index, first, count;
        Subtree lower() const { return {2 * index + 1, first, count / 2}; }
        Subtree upper() const { return {2 * index + 2, first + count / 2, count - count / 2}; }
    };
    const Box& box(const Subtree& some) const { return around[some.index]; }
    /// The number of the first box.
    std::size_t first(const Subtree& some) const { return order[some.first]; }
    /// Subtrees have indices below this.
    std::size_t size() const { return around.size(); }

    /// Looks at pairs of disjoint subtrees. It calls visitor.skips(a, b): if that is false it goes on with their
    /// halves, or calls visitor.meet(i, k) with the numbers of two single boxes. Once it has been through all pairs
    /// within a subtree of more than one box it calls visitor.leave(subtree).
    template <class Visitor>
    void visit_pairs(Visitor& visitor) const {
        if (!boxes.empty()) within(root(), visitor);
    }

    /// Calls found(i) with the number of each box that `accepts`, which accepts the boxes around it as well.
    template <class Accepts, class Found>
    void visit(const Accepts& accepts, const Found& found) const {
        if (!boxes.empty()) visit(root(), accepts, found);
    }

  private:
    template <class Accepts, class Found>
    void visit(const Subtree& some, const Accepts& accepts, const Found& found) const {
        if (!accepts(box(some))) return;
        if (some.count == 1) return found(first(some));
        visit(some.lower(), accepts, found), visit(some.upper(), accepts, found);
    }
    Subtree root() const { return {0, 0, boxes.size()}; }

    /// The lower corner of a box, and its number.
    struct Corner {
        DVec3 low;
        std::size_t box;
    };
    void build(const Subtree& some, std::span<Corner> corners) {
        Box& own = around[some.index];
        if (some.count == 1) return void(own = boxes[corners[0].box]);
        halve(corners, corners.size() / 2, [](const Corner& corner) { return corner.low; });
        build(some.lower(), corners.first(some.count / 2)), build(some.upper(), corners.subspan(some.count / 2));
        own.add(box(some.lower())), own.add(box(some.upper()));
    }
    template <class Visitor>
    void within(const Subtree& some, Visitor& visitor) const {
        if (some.count < 2) return;
        within(some.lower(), visitor), within(some.upper(), visitor);
        between(some.lower(), some.upper(), visitor);
        visitor.leave(some);
    }
    template <class Visitor>
    void between(const Subtree& a, const Subtree& b, Visitor& visitor) const {
        if (visitor.skips(a, b)) return;
        if (a.count == 1 && b.count == 1) return visitor.meet(first(a), first(b));
        const bool halve_a = a.count >= b.count;
        between(halve_a ? a.lower() : a, halve_a ? b : b.lower(), visitor);
        between(halve_a ? a.upper() : a, halve_a ? b : b.upper(), visitor);
    }

    std::vector<Box> boxes;
    std::vector<std::size_t> order;
    std::vector<Box> around;
};

}  // namespace strahl
