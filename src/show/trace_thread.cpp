// Traces for the window.
#include "show/trace_thread.h"

#include <malloc.h>

#include <algorithm>
#include <utility>

namespace strahl {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TraceThread::TraceThread(int threads, std::function<void()> notify_function)
    : notify(std::move(notify_function)), pool(threads), thread([this](std::stop_token quit) { loop(quit); }) {}

TraceThread::~TraceThread() {
    {
        std::lock_guard lock(mutex);
        thread.request_stop();
        stop = true;
    }
    thread.join();
}

/// Should the picture in work be abandoned for `newer`? A coarse picture is finished first, or nothing would be shown
/// in fast motion; unless it is useless now, or takes far longer than planned and a coarser one would not.
bool TraceThread::outdated(const Order& newer) const {
    if (work == Work::none) return false;
    if (work == Work::refining) return newer.number != state.number;
    const bool useless = newer.scene != scene_in_work || newer.view.width != view_in_work.width ||
                         newer.view.height != view_in_work.height || newer.view.depth != view_in_work.depth;
    const double planned = allowed_seconds(level_in_work, budget_in_work);
    return useless || (level_in_work > 0 && seconds_since(work_began) > 4 * planned);
}

void TraceThread::want(Order newer) {
    {
        std::lock_guard lock(mutex);
        if (outdated(newer)) stop = true;
        if (newer.number != state.number) complete = false;
        next = std::move(newer);
    }
    wake.notify_one();
}

std::optional<Refinement> TraceThread::take(const Upload& upload) {
    std::lock_guard lock(mutex);
    if (!fresh.exchange(false)) return std::nullopt;
    if (new_from < new_to) upload({shown, shown_steps, state.width, state.height, new_from, new_to - new_from});
    new_from = shown.height, new_to = 0;
    return state;
}

void TraceThread::loop(std::stop_token quit) {
    while (accept(quit)) done < 0 ? first_picture() : refine();
}

/// Waits for work. Returns false when the thread should end.
bool TraceThread::accept(std::stop_token quit) {
    std::unique_lock lock(mutex);
    work = Work::none;
    const auto unfinished = [&] { return done < 0 || (done < averaged_level && !order.moving); };
    do {
        wake.wait(lock, quit, [&] { return next || (order.number > 0 && unfinished()); });
        if (quit.stop_requested()) return false;
        if (!next) break;
        if (next->scene != order.scene) tracer.reset(), table.emplace(next->scene->settings.linear);
        if (next->number != order.number) done = -1;
        order = *std::exchange(next, std::nullopt);
    } while (!unfinished());
    work = done < 0 ? Work::first : Work::refining;
    scene_in_work = order.scene, view_in_work = order.view, budget_in_work = order.budget;
    const int finest = order.moving ? order.finest : finest_level;
    if (done < 0) level_in_work = resolution.choose(order.view.width, order.view.height, order.budget, finest);
    work_began = Clock::now();
    stop = quit.stop_requested();
    return true;
}

void TraceThread::announce(std::unique_lock<std::mutex>& lock) {
    const bool told = fresh.exchange(true);
    lock.unlock();
    if (!told) notify();
}

void TraceThread::first_picture() {
    // Built here and not when the scene arrives, because the window must not wait for it.
    const bool built = tracer.has_value();
    if (!built) tracer.emplace(*order.scene, Precision::float32);
    const View& view = order.view;
    const int level = level_in_work;
    const Steps steps = steps_of(level);
    const Lattice pixels = pixels_of(level, view.width, view.height);
    spare.resize(pixels.columns, pixels.rows);
    tracer->prepare(view, pool);  // a coarser picture would not save this time
    const auto start = Clock::now();
    const auto keep = [&](const Tile& tile) { store(tile.lattice, encoded(tile, *table).data(), steps, spare); };
    const Counts rays = tracer->trace(view, pixels, pool, keep, &stop);
    const double seconds = seconds_since(start);
    if (built) resolution.observe(count(pixels), seconds);  // a stopped one would have taken even longer
    if (stop) return;
    done = level;
    std::unique_lock lock(mutex);
    std::swap(shown, spare);
    shown_steps = steps;
    new_from = 0, new_to = shown.height;
    const double share = count(pixels) / (double(view.width) * view.height) / 2;
    state = {order.number, view.width, view.height, level, share, seconds, rays};
    complete = state.finished() && !next;
    announce(lock);
}

/// Makes the image on the screen that of the level whose pixels come next.
void TraceThread::begin_pass(int level) {
    const Steps steps = steps_of(level);
    if (steps == shown_steps) return;
    const Lattice pixels = pixels_of(level, order.view.width, order.view.height);
    spare.resize(pixels.columns, pixels.rows);
    expand(shown, {shown_steps.x / steps.x, shown_steps.y / steps.y}, spare);  // only this thread writes to `shown`
    std::lock_guard lock(mutex);
    std::swap(shown, spare);
    shown_steps = steps;
    new_from = 0, new_to = shown.height;
}

/// The pixels of a level that the one before lacks, or in the end the averages over all.
Counts TraceThread::trace_level(int level, const Sink& keep) {
    const View& view = order.view;
    if (level == averaged_level)
        return tracer->trace(view, Sampling{}, {.columns = view.width, .rows = view.height}, pool, keep, &stop);
    const Lattice pixels = new_pixels_of(level, view.width, view.height);
    const auto start = Clock::now();
    const Counts rays = tracer->trace(view, pixels, pool, keep, &stop);
    if (!stop) resolution.observe(count(pixels), seconds_since(start));
    return rays;
}

void TraceThread::refine() {
    const View& view = order.view;
    const int level = done + 1;
    begin_pass(std::min(level, finest_level));
    const Steps steps = shown_steps;
    const double all = double(view.width) * view.height;
    const auto keep = [&](const Tile& tile) {
        const std::vector<std::uint32_t> rgba = encoded(tile, *table);
        std::unique_lock lock(mutex);
        const Lattice& part = tile.lattice;
        store(part, rgba.data(), steps, shown);
        new_from = std::min(new_from, part.y / steps.y);
        new_to = std::max(new_to, (part.y + (part.rows - 1) * part.step_y) / steps.y + 1);
        state.share += count(part) / all / 2;
        announce(lock);
    };
    const auto start = Clock::now();
    const Counts rays = trace_level(level, keep);
    if (stop) return;
    done = level;
    std::unique_lock lock(mutex);
    state.level = level;
    state.rays += rays;
    state.seconds += seconds_since(start);
    complete = state.finished() && !next;
    announce(lock);
    if (level == averaged_level) ::malloc_trim(0);  // at rest the system may have what the passes needed
}

}  // namespace strahl
