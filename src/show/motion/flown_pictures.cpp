// Chooses pictures of a flight, and traces the finished ones of the same moments.
#include "show/motion/flown_pictures.h"

#include <algorithm>
#include <utility>

#include "num/thread_pool.h"

namespace strahl {

void FlownPictures::shown(double share, const ScreenImage& image, const std::shared_ptr<const Scene>& scene,
                          const View& view) {
    const auto last = static_cast<double>(parts.size() - 1);
    const auto part = static_cast<std::size_t>(std::clamp(share * static_cast<double>(parts.size()), 0., last));
    if (std::exchange(current, part) != part) parts[part].clear();
    if (parts[part].size() < 2) parts[part].push_back({image, scene, view});
}

int FlownPictures::count() const {
    std::size_t kept = 0;
    for (const auto& part : parts) kept += part.size();
    return static_cast<int>(kept);
}

std::optional<Quality> FlownPictures::compare(int threads, const Exposure& exposure,
                                              const std::atomic<bool>& stop) const {
    ThreadPool pool(threads);
    std::shared_ptr<const Scene> prepared;
    std::optional<Tracer> tracer;
    QualityLog log;
    for (const auto& part : parts)
        for (const Kept& kept : part) {
            if (std::exchange(prepared, kept.scene) != kept.scene) tracer.emplace(*kept.scene, Precision::float32);
            const TransferTable table(kept.scene->settings.assumed_gamma, exposure);
            ScreenImage finished = traced_picture(*tracer, kept.view, pool, table, {.grid = grid}, &stop);
            if (stop) return std::nullopt;
            log.add(kept.image, std::move(finished), &kept != &part.front());
        }
    return log.quality();
}

}  // namespace strahl
