#include "show/second/second_pictures.h"

#include <algorithm>
#include <exception>

#include "files/os/memory.h"
#include "files/os/thread.h"
#include "povref/compare/run_povray.h"

namespace strahl {
namespace {

constexpr std::size_t most_kept = 32'000'000;  // pixels of all kept pictures together, but for the last one

}  // namespace

void SecondPictures::want(SecondOrder order) {
    const bool same_order = order == wanted;
    wanted = std::move(order);  // the next comparison need not look into an equal scene again
    if (same_order) return;
    current.reset(), why_none.clear();
    const auto same = std::ranges::find(kept, wanted, &decltype(kept)::value_type::first);
    if (same != kept.end()) current = same->second;
    ++number;
    if (!under_way()) return void(worker.drop());
    worker.replace(
        [this, order = wanted, own_number = number](const std::atomic<bool>& stop) {
            os::lower_priority();
            std::optional<Result> result = make(order, own_number, stop);
            os::trim_memory();
            return result;
        },
        true);
}

bool SecondPictures::take() {
    std::optional<Result> taken;
    while (auto newer = worker.take()) taken = std::move(newer);
    if (!taken || taken->number != number) return false;
    why_none = taken->fault;
    if (taken->picture) current = taken->picture;
    if (!current || !current->finished || wanted.brief) return true;
    kept.emplace_front(wanted, current);
    std::size_t pixels = 0, some = 0;
    for (; some < kept.size() && (some == 0 || pixels < most_kept); ++some)
        pixels += 2 * kept[some].second->image.pixels.size();
    kept.resize(some);
    return true;
}

std::optional<SecondPictures::Result> SecondPictures::make(const SecondOrder& order, std::uint64_t own_number,
                                                           const std::atomic<bool>& stop) try {
    ThreadPool pool(threads);
    make_second(order, pool, stop, [&](SecondPicture picture) {
        worker.give({own_number, std::make_shared<const SecondPicture>(std::move(picture))});
    });
    return std::nullopt;
} catch (const Stopped&) {
    return std::nullopt;
} catch (const std::exception& error) {
    return Result{own_number, nullptr, error.what()};
}

}  // namespace strahl
