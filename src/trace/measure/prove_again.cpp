#include "trace/measure/prove_again.h"

#include <algorithm>
#include <atomic>
#include <vector>

namespace strahl {

Counts prove_again(Tracer& tracer, Job job, std::span<const Pixel> pixels,
                   const std::function<bool(const Tile&)>& decides) {
    constexpr std::size_t few = 256, hardly_ever = 64;
    const std::size_t step = std::max<std::size_t>(1, pixels.size() / few);
    std::vector<Pixel> some, others;
    for (std::size_t i = 0; i < pixels.size(); ++i) (i % step == 0 ? some : others).push_back(pixels[i]);
    std::atomic<std::size_t> decided = 0;
    job.sink = [&](const Tile& tile) { decided += decides(tile); };
    Counts counts = tracer.trace(job, some);
    if (decided * hardly_ever >= some.size()) counts += tracer.trace(job, others);
    return counts;
}

}  // namespace strahl
