// Gives long triangles several boxes, each around a piece of them, where their whole boxes overlap much.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "num/bounding_box.h"
#include "num/thread_pool.h"
#include "trace/hierarchy/hierarchy_cut.h"

namespace strahl {

inline constexpr std::int32_t boxes_at_once = 4096;  // a thread's piece of work

using TriangleCorners = std::array<DVec3, 3>;

inline double half_area(const Box& box) {
    const DVec3 size = box.size();
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// Returns the boxes around the parts of a triangle in both halves of a box.
inline std::pair<Box, Box> cut_box(const TriangleCorners& corners, const Box& box, int axis) {
    const double at = box.centre()[axis];
    std::pair<Box, Box> halves;
    for (int i = 0; i < 3; ++i) {
        const DVec3 &from = corners[i], &to = corners[(i + 1) % 3];
        if (from[axis] <= at) halves.first.add(from);
        if (from[axis] >= at) halves.second.add(from);
        if ((from[axis] < at) == (to[axis] < at)) continue;
        const DVec3 across = from + (at - from[axis]) / (to[axis] - from[axis]) * (to - from);
        halves.first.add(across), halves.second.add(across);
    }
    for (Box* const half : {&halves.first, &halves.second})
        for (int c = 0; c < 3; ++c)
            half->low[c] = std::max(half->low[c], box.low[c]), half->high[c] = std::min(half->high[c], box.high[c]);
    halves.first.high[axis] = halves.second.low[axis] = at;
    return halves;
}

/// Adds the boxes around pieces of a triangle: halves its box, and these again, while half the area of a box is more
/// than `limit` larger than it has to be. It has to be twice the area of the piece's shadows along the axes, `shadows`,
/// which no cut makes less. Cuts at most so many times one after the other.
inline void cut_triangle(const TriangleCorners& corners, const Box& box, double shadows, double limit, int cuts,
                         std::vector<Box>& pieces) {
    if (cuts > 0 && half_area(box) - 2 * shadows > limit) {
        const DVec3 size = box.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto [first, second] = cut_box(corners, box, axis);
        const auto holds = [](const Box& b) {
            return b.low.x <= b.high.x && b.low.y <= b.high.y && b.low.z <= b.high.z;
        };
        if (holds(first) && holds(second)) {
            const double share = half_area(first) / (half_area(first) + half_area(second));
            cut_triangle(corners, first, shadows * share, limit, cuts - 1, pieces);
            cut_triangle(corners, second, shadows * (1 - share), limit, cuts - 1, pieces);
            return;
        }
    }
    pieces.push_back(box);
}

/// Boxes around pieces of triangles, and which triangles these are of.
struct TrianglePieces {
    std::vector<ItemBox> boxes;
    std::vector<std::int32_t> of;
};

/// The triangles of a form. Long ones are those with a box half of whose area is more than `limit` larger than it has
/// to be (after T. Karras and T. Aila, "Fast Parallel Construction of High-Quality Bounding Volume Hierarchies", 2013).
template <class T>
struct LongTriangles {
    static constexpr int most_cuts = 8;  // one after the other
    const T* numbers;
    std::size_t fields;
    const ItemBox* boxes;
    std::int32_t first, count;
    double limit;

    /// Calls act(part, box's number, corners, box, area of the shadows, what is too large) for each long triangle, by
    /// all threads, each of which has parts of its own.
    template <class Act>
    void each(ThreadPool& pool, const Act& act) const {
        share_out(pool, count, boxes_at_once, [&](std::int32_t from, std::int32_t to) {
            for (std::int32_t i = from; i < to; ++i) {
                if (!(hierarchy_cut::bounds_of(boxes[first + i]).half_area() > limit)) continue;
                TriangleCorners corners;
                Box box;
                for (int k = 0; k < 3; ++k) {
                    const T* const at = numbers + i * fields + 3 * k;
                    box.add(corners[k] = DVec3(at[0], at[1], at[2]));
                }
                const DVec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
                const double shadows = (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) / 2;
                const double too_large = half_area(box) - 2 * shadows;
                if (too_large > limit) act(from / boxes_at_once, first + i, corners, box, shadows, too_large);
            }
        });
    }
    /// Adds up how many long triangles there are, by how much their boxes are too large, and about how many pieces they
    /// would be cut into.
    void measure(ThreadPool& pool, double (&sums)[3]) const {
        std::vector<std::array<double, 3>> found(count / boxes_at_once + 1);
        each(pool, [&](std::int32_t part, std::int32_t, const auto&, const Box&, double, double too_large) {
            found[part][0] += 1, found[part][1] += too_large, found[part][2] += std::sqrt(too_large / limit);
        });
        for (const auto& some : found)
            for (int i = 0; i < 3; ++i) sums[i] += some[i];
    }
    /// Adds the pieces of all long triangles, one triangle's after the other's.
    void cut(ThreadPool& pool, TrianglePieces& pieces) const {
        std::vector<TrianglePieces> found(count / boxes_at_once + 1);
        each(pool, [&](std::int32_t part, std::int32_t i, const auto& corners, const Box& box, double shadows, double) {
            std::vector<Box> own;
            cut_triangle(corners, box, shadows, limit, most_cuts, own);
            for (const Box& piece : own)
                found[part].boxes.push_back(item_box(piece, boxes[i].form)), found[part].of.push_back(i);
        });
        for (const TrianglePieces& some : found) {
            pieces.boxes.insert(pieces.boxes.end(), some.boxes.begin(), some.boxes.end());
            pieces.of.insert(pieces.of.end(), some.of.begin(), some.of.end());
        }
    }
};

/// The sum of the half areas of boxes, and the half area of the box around all.
struct SumOfAreas {
    double sum = 0, whole = 0;
    SumOfAreas(const ItemBox* boxes, std::int32_t count, ThreadPool& pool) {
        std::vector<std::pair<double, hierarchy_cut::QuadBox>> parts(count / boxes_at_once + 1,
                                                                     {0., hierarchy_cut::nothing});
        share_out(pool, count, boxes_at_once, [&](std::int32_t from, std::int32_t to) {
            auto& [own, around] = parts[from / boxes_at_once];
            for (std::int32_t i = from; i < to; ++i) {
                const hierarchy_cut::QuadBox box = hierarchy_cut::bounds_of(boxes[i]);
                own += box.half_area(), around.add(box);
            }
        });
        for (const auto& [own, around] : parts) sum += own, parts[0].second.add(around);
        whole = parts[0].second.half_area();
    }
};

}  // namespace strahl
