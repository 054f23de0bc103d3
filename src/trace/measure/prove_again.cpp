#include "trace/measure/prove_again.h"

#include <cstdint>
#include <vector>

namespace strahl {

Counts prove_again(Tracer& tracer, const View& view, std::span<const Pixel> pixels, ThreadPool& pool,
                   const std::function<bool(const Tile&)>& decides, const std::atomic<bool>* stop) {
    constexpr std::size_t few = 256, hardly_ever = 64;
    const std::size_t step = std::max<std::size_t>(1, pixels.size() / few);
    std::vector<Pixel> some, others;
    for (std::size_t i = 0; i < pixels.size(); ++i) (i % step == 0 ? some : others).push_back(pixels[i]);
    std::atomic<std::size_t> decided = 0;
    const auto sink = [&](const Tile& tile) { decided += decides(tile); };
    Counts counts = tracer.trace(view, some, pool, sink, stop);
    if (decided * hardly_ever >= some.size()) counts += tracer.trace(view, others, pool, sink, stop);
    return counts;
}

}  // namespace strahl
