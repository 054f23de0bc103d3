// Light buffers tell which bodies of a large world can be in the way of a light (E. A. Haines, D. P. Greenberg, "The
// Light Buffer: A Shadow-Testing Accelerator", IEEE CG&A 6(9), 1986). A grid of the directions from a light has in each
// cell the bodies that reach into it, so that a shadow ray looks into one cell instead of the hierarchy.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "trace/world/world.h"

namespace strahl {

class ThreadPool;

/// An item of the hierarchy that shadow rays of a cell may meet; no point of it is nearer to the light than `near`. In
/// an empty cell, and where a cell has no more, that is infinite. Floats, for worlds in double as well: half the
/// memory.
template <class S>
struct Candidate {
    S near, item, form;
    S next;  // the number of the cell's next candidate, which is no nearer
};

/// A face of the grid: the points p, relative to the light, whose slopes (u, v) = (right . p, up . p) / (axis . p) are
/// within a limit. Parallel light has one face, without limit and division. Cells are numbered row by row: column
/// (u - low_u) * per_u and so on.
template <class T>
struct BufferFace {
    Vec3<T> right, up, axis;
    T limit;
    T low_u, low_v, per_u, per_v;
    T columns, rows, first;  // first: the number of its first cell
};

/// The buffer of a light. The candidate that a cell begins with has the cell's number; 0 is the number of no cell.
/// Points outside all cells have no body in their way.
template <class T>
struct LightBuffer {
    const BufferFace<T>* faces = nullptr;  // null: this light has no buffer
    int face_count = 0;
    T furthest = 0;  // only for points no further from the world's origin than this
    const Candidate<float>* candidates = nullptr;
};

/// The buffers of a world's lights.
template <class T>
class LightBuffers {
  public:
    /// With at least this many pixels for each item of the hierarchy, buffers save more time than it takes to make
    /// them.
    static constexpr std::int64_t pixels_per_item = 12;
    /// Limits above which a light has no buffer: candidates for each item, candidates in a usual cell, and items of
    /// this light and those before it together. So buffers take no more than 512 MiB, and mostly 150 bytes for each
    /// item and light.
    static constexpr std::int64_t most_per_item = 32, most_per_cell = 12, most_items = 1 << 20;

    /// In buffers for proofs, a cell also has the bodies that come this near to it, as a share of the world: half of
    /// that is for the errors of bodies and rays, the rest for their own margin.
    static constexpr double proving_margin = 1e-7;

    /// Returns true if buffers save time where so many pixels are traced. They do not for forms that are slow to test
    /// one item at a time, and cannot be used where bodies let light through, for these are crossed in a fixed order.
    /// For proofs all forms have to be fast.
    static bool pay(const World<T>& world, std::int64_t pixels, bool proves);
    /// Makes the buffers with all threads; they are the same for any number of threads.
    LightBuffers(const World<T>& world, ThreadPool& pool, bool proves = false);
    ~LightBuffers();

    const LightBuffer<T>* buffers() const { return list.data(); }
    std::int64_t candidates() const;

  private:
    struct Arrays;
    std::vector<LightBuffer<T>> list;  // by light
    std::vector<std::unique_ptr<Arrays>> arrays;
};

}  // namespace strahl
