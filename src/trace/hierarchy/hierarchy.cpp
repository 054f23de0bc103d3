#include "trace/hierarchy/hierarchy.h"

#include <algorithm>
#include <array>
#include <deque>
#include <utility>
#include <vector>

#include "num/thread_pool.h"
#include "scene/kinds/kinds.h"
#include "trace/hierarchy/hierarchy_grid.h"
#include "trace/hierarchy/hierarchy_opening.h"

namespace strahl {
namespace {

using namespace hierarchy_cut;

constexpr int leaf_items = 16;  // most items of a leaf
static_assert(leaf_items <= LeafCode::most_items);
constexpr int deepest_cut = 30;      // from this depth on, in the middle: 2^30 items have no more than 60 levels
constexpr int shared_items = 16384;  // more than these are cut by a grid, by all threads together,
constexpr int few_cells = 128;       // until a part has no more cells than these
constexpr int enough_boxes = 256;    // so many of a part are looked at for a cut
constexpr int chunk_items = 8192;    // a thread's piece of other work on all items
// A ray asks all parts of a composite, and all pieces of a body that lists crossings: each of these bodies has a leaf,
// and so a box, of its own.
constexpr auto alone = []<class... F>(FormList<F...>) {
    return std::array{(is_composite<typename F::Kind> || lists_crossings<typename F::Kind>)...};
}(Forms{});
constexpr bool triangles(int form) {
    return form == place_of<Form<Triangle, 0>>(Forms{}) || form == place_of<Form<SmoothTriangle, 0>>(Forms{});
}

/// A node of the binary hierarchy: items [begin, end).
struct BinaryNode {
    Extents extents;
    Cut cut;  // of at most leaf_items
    std::int32_t begin, end;
    int depth;
    int side = 0;  // which of the two arrays they are in
    bool leaf = false;
    const std::array<BinaryNode, 2>* halves = nullptr;  // the halves, if they are known already
    std::int32_t count() const { return end - begin; }
};

class HierarchyBuilder {
  public:
    HierarchyBuilder(Buffer<ItemBox> boxes, std::int32_t size, double margin, ThreadPool& workers, int lanes)
        : entries{boxes.get()}, pool(workers), triangle_cost(lanes < leaf_items ? item_cost : .15f) {
        result.order = uninitialized_buffer<std::int32_t>(size);
        Buffer<ItemBox> others = uninitialized_buffer<ItemBox>(size);
        entries[1] = others.get();
        std::vector<Extents> extents(size / chunk_items + 1);
        share_out(pool, size, chunk_items, [&](std::int32_t first, std::int32_t last) {
            for (ItemBox* e = entries[0] + first; e < entries[0] + last; ++e) {
                const QuadBox box = grown(bounds_of(*e), margin);
                for (int c = 0; c < 3; ++c) e->low[c] = box.low[c], e->high[c] = box.high[c];
                e->item = static_cast<std::int32_t>(e - entries[0]);
                extents[first / chunk_items].add(box);
            }
        });
        for (std::size_t i = 1; i < extents.size(); ++i) extents[0].add(extents[i]);
        std::vector<Node> top;
        node(finished({extents[0], {}, 0, size, 0}), top);
        std::vector<std::vector<Node>> below(tasks.size());
        share_out(pool, static_cast<std::int32_t>(tasks.size()), 1, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) {
                std::vector<OpenedPart> opened;
                grow(tasks[i].part, opened);
                node(opened, opened.back(), below[i]);
            }
        });
        boxes.reset(), others.reset();
        join(top, below);
    }
    Hierarchy result;

  private:
    struct Task {
        BinaryNode part;
        std::size_t node;
        int child;
    };
    ItemBox* entries[2];
    ThreadPool& pool;
    const float triangle_cost;  // cost of testing a triangle, relative to a binary node's
    std::vector<Task> tasks;
    std::deque<std::array<BinaryNode, 2>> halves;  // of the parts that a grid cuts

    /// Puts the nodes of all tasks behind those at the top.
    void join(std::vector<Node>& top, const std::vector<std::vector<Node>>& below) {
        std::size_t count = top.size();
        std::vector<std::size_t> starts;
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            top[tasks[i].node].first[tasks[i].child] = static_cast<std::int32_t>(count);
            starts.push_back(count);
            count += below[i].size();
        }
        result.nodes = uninitialized_buffer<Node>(count);
        result.size = static_cast<std::int32_t>(count);
        top[0].only = count == 1;
        std::copy(top.begin(), top.end(), result.nodes.get());
        share_out(pool, static_cast<std::int32_t>(tasks.size()), 1, [&](std::int32_t first, std::int32_t last) {
            for (std::int32_t i = first; i < last; ++i) {
                Node* to = result.nodes.get() + starts[i];
                for (Node node : below[i]) {
                    for (int c = 0; c < node.children; ++c)
                        if (node.leaves[c] == 0) node.first[c] += static_cast<std::int32_t>(starts[i]);
                    *to++ = node;
                }
            }
        });
    }

    ItemBox* first_of(const BinaryNode& part) const { return entries[part.side] + part.begin; }
    ItemBox* last_of(const BinaryNode& part) const { return entries[part.side] + part.end; }

    Cut cut_of(const BinaryNode& part) const {
        if (part.depth >= deepest_cut || part.count() <= 2) return {};
        const int count = bins_for(part.count());
        const BinScale scale(part.extents.middles, Quad{} + static_cast<float>(count));
        Bins bins(count, count, count);
        // Some hundred boxes tell as well as all where to cut.
        const std::int32_t step = std::max(1, part.count() / enough_boxes);
        for (const ItemBox* e = first_of(part); e < last_of(part); e += step) {
            const QuadBox box = bounds_of(*e);
            const WholeQuad bin = scale.bins(box);
            for (int axis = 0; axis < 3; ++axis) bins.add(axis, bin[axis], box, 1);
        }
        return best_cut(bins, (part.count() - 1) / step + 1);
    }

    /// Completes a part whose items and extents are known: if it has few items it may become a leaf.
    BinaryNode finished(BinaryNode part) const {
        if (part.count() > leaf_items) return part;
        const float area = part.extents.all.half_area();
        const float each = triangles(first_of(part)->form) ? triangle_cost : item_cost;
        const float whole = each * static_cast<float>(part.count());
        if (whole > 1 || alone[first_of(part)->form]) part.cut = cut_of(part);  // else no cut pays
        part.leaf = !(area + each * part.cut.cost < whole * area);
        if (part.leaf) {
            const auto [least, most] = std::minmax_element(
                first_of(part), last_of(part), [](const ItemBox& a, const ItemBox& b) { return a.form < b.form; });
            if (least->form < most->form) part.cut = {0, by_form, least->form};
            part.leaf = least->form == most->form && (part.count() == 1 || !alone[least->form]);
        }
        return part;
    }
    BinaryNode part(std::int32_t begin, std::int32_t end, const BinaryNode& of) const {
        BinaryNode part{{}, {}, begin, end, of.depth + 1, of.side};
        for (const ItemBox* e = first_of(part); e < last_of(part); ++e) part.extents.add(bounds_of(*e));
        return finished(part);
    }

    /// Cuts a part in two. `from` becomes the part before the cut; returns the part behind it.
    BinaryNode open(BinaryNode& from) {
        if (!from.halves && from.count() > shared_items) cut_by_grid(from);
        if (from.halves) {
            const std::array<BinaryNode, 2>& both = *from.halves;
            from = both[0];
            return both[1];
        }
        const Cut cut = from.count() <= leaf_items ? from.cut : cut_of(from);
        std::int32_t at = from.begin + from.count() / 2;
        if (cut.axis == by_form) {
            at = divide(from, [form = cut.bin](const ItemBox& e) { return e.form == form; });
        } else if (cut.axis != in_the_middle) {
            const BinScale scale(from.extents.middles, Quad{} + static_cast<float>(bins_for(from.count())));
            at = divide(from, [axis = cut.axis, low = scale.from[cut.axis], per_bin = scale.per_bin[cut.axis],
                               bin = static_cast<float>(cut.bin)](const ItemBox& e) {
                return (e.low[axis] + e.high[axis] - low) * per_bin < bin;
            });
        }
        const BinaryNode left = part(from.begin, at, from), right = part(at, from.end, from);
        from = left;
        return right;
    }

    /// Moves items for which `before` holds to the front and all others behind them, in the other array: so there is
    /// no branch, which could not be predicted. Returns where the others begin.
    template <class Before>
    std::int32_t divide(BinaryNode& part, const Before& before) const {
        ItemBox* const to = entries[1 - part.side];
        std::int32_t front = part.begin, back = part.end - 1;
        for (const ItemBox* e = first_of(part); e < last_of(part); ++e) {
            to[front] = *e, to[back] = *e;
            const int goes = before(*e);
            front += goes, back -= 1 - goes;
        }
        part.side = 1 - part.side;
        return front;
    }

    /// Cuts a part by the borders of a grid's cells, again and again, before any item moves; then all move at once.
    /// If all centres are in one place there is no cut, and the part stays as it is.
    void cut_by_grid(BinaryNode& from) {
        const Grid grid(from.extents.middles);
        const std::int32_t pieces = 2 * pool.size(), step = (from.count() - 1) / pieces + 1;
        std::vector<std::vector<GridCell>> seen(pieces);
        share_out(pool, from.count(), step, [&](std::int32_t first, std::int32_t last) {
            std::vector<GridCell>& cells = seen[first / step];
            cells.resize(grid.cells());
            for (const ItemBox* e = first_of(from) + first; e < first_of(from) + last; ++e) {
                const QuadBox box = bounds_of(*e);
                GridCell& cell = cells[grid.cell(box)];
                cell.extents.add(box), ++cell.count;
            }
        });
        std::vector<GridCell> cells = seen[0];
        for (std::int32_t p = 1; p < pieces; ++p)
            for (std::size_t c = 0; c < seen[p].size(); ++c)
                cells[c].extents.add(seen[p][c].extents), cells[c].count += seen[p][c].count;
        std::vector<BinaryNode*> ends;
        cut_cells(from, grid, grid.all, cells, ends);
        if (!from.halves) return;
        // The items of a cell come one after the other, piece by piece.
        for (std::int32_t c = 0; c < grid.cells(); ++c)
            for (std::int32_t p = 0, at = cells[c].count; p < pieces; ++p)
                if (!seen[p].empty()) at += std::exchange(seen[p][c].count, at);
        share_out(pool, from.count(), step, [&](std::int32_t first, std::int32_t last) {
            std::vector<GridCell>& own = seen[first / step];
            for (const ItemBox* e = first_of(from) + first; e < first_of(from) + last; ++e)
                entries[1 - from.side][own[grid.cell(bounds_of(*e))].count++] = *e;
        });
        for (BinaryNode* const end : ends) {
            end->side = 1 - from.side;
            *end = finished(*end);
        }
    }

    /// Cuts a part that consists of a range of cells, again and again. In the cells of parts that are not cut further,
    /// which are added to `ends`, counts become the places of the first items.
    void cut_cells(BinaryNode& part, const Grid& grid, const CellRange& range, std::vector<GridCell>& cells,
                   std::vector<BinaryNode*>& ends) {
        Bins bins(range.size(0), range.size(1), range.size(2));
        part.extents = {};
        range.each(grid.shift, [&](int c, const int(&at)[3]) {
            if (cells[c].count == 0) return;
            part.extents.add(cells[c].extents);
            for (int axis = 0; axis < 3; ++axis)
                bins.add(axis, at[axis] - range.low[axis], cells[c].extents.all, cells[c].count);
        });
        const bool done = range.cells() <= few_cells || part.count() <= shared_items || part.depth >= deepest_cut;
        const Cut cut = done ? Cut{} : best_cut(bins, part.count());
        if (cut.axis == in_the_middle) {
            std::int32_t next = part.begin;
            range.each(grid.shift, [&](int c, const int(&)[3]) { next += std::exchange(cells[c].count, next); });
            ends.push_back(&part);
            return;
        }
        std::int32_t at = part.begin;
        for (int b = 0; b < cut.bin; ++b) at += bins.count[cut.axis][b];
        auto& both = halves.emplace_back(std::array{BinaryNode{{}, {}, part.begin, at, part.depth + 1},
                                                    BinaryNode{{}, {}, at, part.end, part.depth + 1}});
        part.halves = &both;
        CellRange left = range, right = range;
        left.high[cut.axis] = right.low[cut.axis] = range.low[cut.axis] + cut.bin;
        cut_cells(both[0], grid, left, cells, ends);
        cut_cells(both[1], grid, right, cells, ends);
    }

    /// Makes a wide node of the largest parts of one; of each that is still too large, the same again. The others are
    /// left to tasks.
    std::int32_t node(const BinaryNode& root, std::vector<Node>& nodes) {
        const std::size_t index = nodes.size();
        nodes.emplace_back();
        BinaryNode parts[Node::width];
        float areas[Node::width];  // areas of the children that can be opened
        int order[Node::width]{};  // the children in the order of their items
        const auto put = [&](int i, const BinaryNode& part) {
            parts[i] = part;
            areas[i] = part.leaf ? -1 : part.extents.all.half_area();
        };
        put(0, root);
        int count = 1;
        for (; count < Node::width; ++count) {
            int largest = 0;  // the first of them in order
            for (int i = 1; i < count; ++i)
                if (areas[order[i]] > areas[order[largest]]) largest = i;
            if (areas[order[largest]] < 0) break;
            BinaryNode& left = parts[order[largest]];
            const BinaryNode right = open(left);
            put(order[largest], left), put(count, right);
            std::copy_backward(order + largest + 1, order + count, order + count + 1);
            order[largest + 1] = count;
        }
        Node node{};
        for (int i = 0; i < count; ++i) {
            const BinaryNode& child = parts[order[i]];
            add_child(node, opened_part(child));
            if (child.leaf) continue;
            if (child.count() <= shared_items)
                tasks.push_back({child, index, i});
            else
                node.first[i] = this->node(child, nodes);
        }
        nodes[index] = node;
        return static_cast<std::int32_t>(index);
    }
    static void add_child(Node& node, const OpenedPart& child) {
        const int i = node.children++;
        for (int c = 0; c < 3; ++c) node.low[c][i] = child.box.low[c], node.high[c][i] = child.box.high[c];
        node.first[i] = child.first;
        node.leaves[i] = static_cast<std::int16_t>(child.code);
        node.together |= child.code != 0 && alone[LeafCode::form(child.code)];
    }
    /// If a part is a leaf, its items get their places.
    OpenedPart opened_part(const BinaryNode& part) {
        if (!part.leaf) return {part.extents.all};
        for (std::int32_t k = part.begin; k < part.end; ++k) result.order[k] = entries[part.side][k].item;
        return {part.extents.all, part.begin, LeafCode::make(first_of(part)->form, part.count())};
    }

    /// Cuts a part down to leaves, and appends its halves and then itself.
    void grow(BinaryNode part, std::vector<OpenedPart>& opened) {
        OpenedPart whole = opened_part(part);
        if (!part.leaf) {
            const BinaryNode behind = open(part);
            grow(part, opened);
            whole.halves[0] = static_cast<std::int32_t>(opened.size() - 1);
            grow(behind, opened);
            whole.halves[1] = static_cast<std::int32_t>(opened.size() - 1);
            whole.join(opened[whole.halves[0]], opened[whole.halves[1]]);
        }
        opened.push_back(whole);
    }
    /// Makes a wide node of a part, and what is below it.
    static std::int32_t node(const std::vector<OpenedPart>& opened, const OpenedPart& whole, std::vector<Node>& nodes) {
        const std::size_t index = nodes.size();
        nodes.emplace_back();
        std::vector<const OpenedPart*> children;
        open_part(opened, whole, Node::width, children);
        Node node{};
        for (const OpenedPart* child : children) {
            add_child(node, *child);
            if (child->code == 0) node.first[node.children - 1] = HierarchyBuilder::node(opened, *child, nodes);
        }
        nodes[index] = node;
        return static_cast<std::int32_t>(index);
    }
};

}  // namespace

Hierarchy build_hierarchy(Buffer<ItemBox> boxes, std::int32_t size, double margin, ThreadPool& pool, int lanes) {
    return std::move(HierarchyBuilder(std::move(boxes), size, margin, pool, lanes).result);
}

}  // namespace strahl
