#include "show/second/second_pictures.h"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <exception>

#include "povref/compare/run_povray.h"

namespace strahl {
namespace {

constexpr std::size_t most_kept = 32'000'000;  // pixels of all kept pictures together, but for the last one

}  // namespace

SecondPictures::SecondPictures(int threads, std::function<void()> notify_function)
    : threads(threads), notify(std::move(notify_function)) {}

SecondPictures::~SecondPictures() {
    const std::lock_guard lock(mutex);
    thread.request_stop();
    stop = true;
}

void SecondPictures::want(SecondOrder order) {
    const bool same_order = order == wanted;
    wanted = std::move(order);  // the next comparison need not look into an equal scene again
    if (same_order) return;
    current.reset(), why_none.clear();
    const auto same = std::ranges::find(kept, wanted, &decltype(kept)::value_type::first);
    if (same != kept.end()) current = same->second;
    {
        const std::lock_guard lock(mutex);
        ++number;
        stop = true, next.reset();
        if (under_way()) next.emplace(wanted, number);
    }
    if (!under_way()) return;
    if (!thread.joinable()) thread = std::jthread([this](const std::stop_token& quit) { loop(quit); });
    wake.notify_one();
}

bool SecondPictures::take() {
    std::optional<Result> taken;
    {
        const std::lock_guard lock(mutex);
        taken = std::exchange(made, std::nullopt);
    }
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

void SecondPictures::loop(const std::stop_token& quit) {
    // On Linux priority belongs to a thread and is inherited by the threads and programs that it starts.
    static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10));
    while (true) {
        std::unique_lock lock(mutex);
        if (!wake.wait(lock, quit, [this] { return next.has_value(); })) return;
        const auto [order, order_number] = *std::exchange(next, std::nullopt);
        stop = quit.stop_requested();
        lock.unlock();
        make(order, order_number);
        ::malloc_trim(0);  // gives memory back to the system
    }
}

void SecondPictures::make(const SecondOrder& order, std::uint64_t order_number) try {
    ThreadPool pool(threads);
    make_second(order, pool, stop, [&](SecondPicture picture) {
        publish(order_number, std::make_shared<const SecondPicture>(std::move(picture)), "");
    });
} catch (const Stopped&) {
} catch (const std::exception& error) {
    publish(order_number, nullptr, error.what());
}

void SecondPictures::publish(std::uint64_t order_number, std::shared_ptr<const SecondPicture> picture,
                             const std::string& fault) {
    {
        const std::lock_guard lock(mutex);
        made = Result{order_number, std::move(picture), fault};
    }
    notify();
}

}  // namespace strahl
