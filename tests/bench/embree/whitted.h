// T. Whitted's recursion, generation by generation, in packets: what a careful afternoon with Embree gives.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "world.h"

namespace strahl::bench {

struct RayCounts {
    std::uint64_t camera = 0, secondary = 0, shadow = 0;
};

/// One thread's memory and work.
class Whitted {
  public:
    static constexpr int tile = 32;
    Whitted(const World& world, const Camera& camera, int width, int height, int depth);
    /// Traces the tile at (x, y) into the picture's values, 3 a pixel, row by row.
    void trace_tile(int x, int y, std::vector<float>& rgb);
    RayCounts counts;

  private:
    static constexpr int most = tile * tile;  // rays traced together
    struct Queue {
        alignas(64) float origin[3][2 * most + lanes], direction[3][2 * most + lanes];
        float weight[2 * most + lanes], pixel[2 * most + lanes];
        int count = 0;
    };
    struct Packet;
    void trace(int generation);
    void shade(const Queue& rays, int begin, Queue& next, int generation);
    Vec3<S> illumination(const Packet& hit, int generation);
    Vec3<S> light_left(const Vec3<S>& from, const Vec3<S>& direction, S distance, Mask<S> wanted, bool coherent);

    const World& world;
    const Vec3<float> eye;
    const CameraFrame frame;
    const int width, height, depth;
    std::vector<std::unique_ptr<Queue>> queues;  // by generation
    std::vector<float> sums[3];                  // of the tile
};

}  // namespace strahl::bench
