// The memory that one thread keeps from tile to tile: queues of rays, hits, and medium stacks.
#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "num/buffer.h"
#include "trace/kernel/kernel.h"

namespace strahl {

class MediumStacks {
  public:
    struct List {
        int shorter, body;
    };
    std::vector<List> lists{{0, -1}};  // list 0 is empty
    std::unordered_map<std::uint64_t, int> known;
};

/// Most pixels in a batch of scattered ones: more than batch_pixels, since each body is seen by few.
inline constexpr int scattered_pixels = 1024;

template <class T>
class Workspace {
  public:
    Workspace();
    Generation<T>& generation(int slot);
    RayQueue<T> refracted_queue;
    HitList<T> hits;
    MediumStacks mediums;
    std::vector<T> pixels_x, pixels_y;
    std::vector<PixelSum<T>> sums;
    std::vector<T> past;
    std::vector<Sight<T>> sights;
    std::vector<T> sides;               // see Footprints
    std::vector<SeenPatterns<T>> seen;  // see Footprints
    std::vector<T> lens_x, lens_y;      // see PixelBatch; empty if no ray needs them
    int batch = scattered_pixels;       // number of pixels that fitted last time
    /// Allocates the arrays of a policy's data of rays.
    void hold_extra();
    /// Allocates the arrays of differentials, for filtering patterns.
    void hold_differentials();
    /// Allocates the arrays of cones, for filtering them roughly.
    void hold_cones();
    /// Allocates the arrays of rays that carry colours and counts.
    void hold_carried();

  private:
    Buffer<T> values, order_by_bin;
    std::vector<Buffer<T>> more;  // memory of arrays that queues have besides those in `values`
    std::size_t used = 0;         // arrays taken from the last of these
    bool with_extra = false, with_differentials = false, with_cones = false, with_carried = false;
    void hold(T*& array);
    void hold_more(RayQueue<T>& queue);
    void hold_more();
    std::vector<std::int32_t> counts;
    struct Held {
        Buffer<T> values;
        std::vector<std::int32_t> stretches;
        Generation<T> generation;
    };
    std::vector<std::unique_ptr<Held>> held;
};

}  // namespace strahl
