// Traces for the window, in a thread of its own.
#include "show/work/trace_thread.h"

#include <algorithm>
#include <utility>

#include "files/os/memory.h"
#include "image/transfer.h"

namespace strahl {
namespace {

/// Largest contrast of a cell that is filled; its pixels may be off by half of it on the screen.
constexpr double most_off = 6. / 255;

/// Sharpened pictures from this level on are finer at edges than cells of 2 pixels: they leave out the first pass.
constexpr int sharp_level = sixteenth_level;
/// The share of the budget after which sharpening ends: drawing may share the processors with it.
constexpr double sharpening_until = .85;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void PictureOnScreen::replace(ScreenImage& made) {
    std::swap(image, made);
    new_from = 0, new_to = image.height;
}

void PictureOnScreen::store(const Lattice& part, const std::uint32_t* colors) {
    strahl::store(part, colors, image);
    new_from = std::min(new_from, part.y);
    new_to = std::max(new_to, part.y + part.rows);
}

void PictureOnScreen::take(const std::function<void(const Fresh&)>& upload, const Refinement& picture) {
    if (new_from < new_to) upload({image, picture, new_from, new_to - new_from});
    new_from = image.height, new_to = 0;
}

TraceThread::TraceThread(int threads, std::function<void()> notify_function)
    : notify(std::move(notify_function)), pool(threads), worker([] {}) {}

/// Should the picture in work be abandoned for `newer`? A coarse picture is finished first, or nothing would be shown
/// in fast motion; unless it has become useless, or takes far longer than planned and a coarser one would not.
bool TraceThread::outdated(const Order& newer) const {
    if (work == Work::none) return false;
    if (work == Work::refining) return newer.number != state.number;
    const View& view = order.view;
    const bool useless = newer.scene != order.scene || newer.view.width != view.width ||
                         newer.view.height != view.height || newer.view.depth != view.depth;
    return useless || (planned > 0 && seconds_since(work_began) > 4 * planned);
}

void TraceThread::want(Order newer) {
    std::lock_guard lock(mutex);
    const bool at_once = outdated(newer);
    if (newer.number != state.number) complete = false;
    const auto job = [this, newer = std::move(newer)](const std::atomic<bool>& stop) {
        trace(newer, stop);
        return std::nullopt;
    };
    worker.replace(job, at_once);
}

std::optional<Refinement> TraceThread::take(const Upload& upload) {
    std::lock_guard lock(mutex);
    if (!fresh.exchange(false)) return std::nullopt;
    shown.take(upload, state);
    return state;
}

double TraceThread::seconds_built() const {
    const Clock::time_point since = building;
    return since == Clock::time_point() ? 0 : seconds_since(since);
}

/// Traces the first picture of an order and its passes, until another one waits.
void TraceThread::trace(const Order& newer, const std::atomic<bool>& stop) {
    std::unique_lock lock(mutex);
    if (newer.scene != order.scene) tracer.reset();
    if (newer.scene != order.scene || newer.exposure != order.exposure)
        table.emplace(newer.scene->settings.assumed_gamma, newer.exposure);
    if (newer.number != order.number) done = -1, cells.reset();
    order = newer;
    while ((done < 0 || (done < averaged_level && !order.moving)) && !stop && !worker.waiting()) {
        work = done < 0 ? Work::first : Work::refining;
        work_began = Clock::now();
        lock.unlock();
        done < 0 ? first_picture(stop) : refine(stop);
        lock.lock();
    }
    work = Work::none;
}

void TraceThread::announce(std::unique_lock<std::mutex>& lock) {
    const bool told = fresh.exchange(true);
    lock.unlock();
    if (!told) notify();
}

/// Returns what the first picture is to be like.
QuickPictures::Wish TraceThread::wish() const {
    return {.budget = order.budget,
            .sharpened_until = sharpens() ? sharpening_until * order.budget : 0,
            .finest = order.moving ? std::min(order.finest, finest_level) : finest_level,
            .averages = order.finest == sharpened_level,
            .contrast = most_off / steepest(order.scene->settings.assumed_gamma) / gain_of(order.exposure)};
}

void TraceThread::first_picture(const std::atomic<bool>& stop) {
    // The world is built here and not when the scene arrives, because the window must not wait for it.
    const bool built = tracer.has_value();
    building = Clock::now();
    if (!built) tracer.emplace(*order.scene, Precision::float32);
    const View& view = order.view;
    tracer->prepare(view, pool);  // not counted: a coarser picture would need it too
    building = Clock::time_point();
    const auto start = Clock::now();
    const auto seconds = [&] { return seconds_since(start); };
    const QuickPictures::Wish wanted = wish();
    const int level = quick.choose(view.width, view.height, wanted);
    {
        std::lock_guard lock(mutex);
        planned = level == 0 ? 0 : allowed_seconds(level, order.budget);
    }
    const Job job{view, pool, {}, &stop};
    const Counts rays = quick.trace(*tracer, job, *table, wanted, level, seconds, built, spare);
    if (stop) return;
    done = sharpens() && level >= sharp_level ? std::max(level, passes[0].level) : level;
    std::unique_lock lock(mutex);
    shown.replace(spare);
    state = {order.number, order.scene, view, level, 0, seconds(), rays};
    complete = state.finished() && !worker.waiting();
    announce(lock);
}

/// Traces the next pass of the picture's cells.
void TraceThread::refine(const std::atomic<bool>& stop) {
    const View& view = order.view;
    if (!cells)
        cells.emplace(tracer->scene(), view, Lattice{.columns = view.width, .rows = view.height},
                      Sampling{}.error / gain_of(order.exposure));
    const std::span<const Pass> left = passes_after(done);
    const auto [finest, level] = left.front();
    const double before = state.share, part_of_all = (1 - before) / static_cast<double>(left.size());
    const auto keep = [&](const Tile& tile) {
        const std::vector<std::uint32_t> colors = encoded(tile, *table);
        std::unique_lock lock(mutex);
        shown.store(tile.lattice, colors.data());
        state.share += part_of_all / cells->tiles();
        announce(lock);
    };
    const auto start = Clock::now();
    const Counts rays = tracer->trace({view, pool, keep, &stop}, CellPass{*cells, finest});
    if (stop) return;
    done = level;
    std::unique_lock lock(mutex);
    state.level = level;
    state.share = before + part_of_all;
    state.rays += rays;
    state.seconds += seconds_since(start);
    complete = state.finished() && !worker.waiting();
    announce(lock);
    if (level != averaged_level) return;
    cells.reset();
    os::trim_memory();
}

}  // namespace strahl
