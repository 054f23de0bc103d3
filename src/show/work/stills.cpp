// Renders stills one after the other, and writes their files.
#include "show/work/stills.h"

#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include "image/picture.h"
#include "num/decimal.h"
#include "num/thread_pool.h"

namespace strahl {

Stills::Stills(int threads, std::function<void()> notify_function)
    : notify(std::move(notify_function)), thread([this, threads](std::stop_token quit) { loop(quit, threads); }) {}

Stills::~Stills() { drop(); }

void Stills::add(Still still) {
    {
        std::lock_guard lock(mutex);
        queue.push_back(std::move(still));
    }
    wake.notify_one();
}

int Stills::pending() const {
    std::lock_guard lock(mutex);
    return static_cast<int>(queue.size());
}

std::vector<std::string> Stills::drop() {
    {
        std::lock_guard lock(mutex);
        stop = true;
        thread.request_stop();
    }
    if (thread.joinable()) thread.join();
    std::vector<std::string> names;
    for (const Still& still : queue) names.push_back(still.name);
    queue.clear();
    return names;
}

std::vector<Stills::Outcome> Stills::outcomes() {
    std::lock_guard lock(mutex);
    return std::exchange(finished, {});
}

void Stills::loop(std::stop_token quit, int threads) {
    // On Linux priority belongs to a thread and is inherited by the threads that it starts.
    static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10));
    std::unique_ptr<ThreadPool> pool;
    while (true) {
        std::unique_lock lock(mutex);
        if (!wake.wait(lock, quit, [&] { return !queue.empty(); }) || stop) return;
        const Still still = queue.front();
        lock.unlock();
        if (!pool) pool = std::make_unique<ThreadPool>(threads);
        Outcome outcome = make(still, *pool);
        if (outcome.path.empty() && outcome.fault.empty()) return;
        lock.lock();
        finished.push_back(std::move(outcome));
        queue.pop_front();
        share = 0;
        if (queue.empty()) {
            // Gives memory back to the system: a still needs some hundred bytes a pixel.
            pool.reset();
            ::malloc_trim(0);
        }
        lock.unlock();
        notify();
    }
}

Stills::Outcome Stills::make(const Still& still, ThreadPool& pool) try {
    const View& view = still.view;
    Picture picture{view.width, view.height, 3, std::vector<double>(std::size_t(3) * view.width * view.height)};
    const Lattice whole{.columns = view.width, .rows = view.height};
    const double all = double(view.width) * view.height;
    std::atomic<int> pixels = 0;
    const auto keep = [&](const Tile& tile) {
        place(tile, whole, picture.values);
        const int size = tile.lattice.columns * tile.lattice.rows, before = pixels.fetch_add(size);
        share = (before + size) / all;
        if (int(100 * before / all) != int(100 * (before + size) / all)) notify();
    };
    Tracer tracer(*still.scene, Precision::float64);
    const Sampling sampling{.error = Sampling{}.error / gain_of(still.exposure)};
    tracer.trace({view, pool, keep, &stop}, SampledRegion{whole, sampling});
    if (stop) return {};
    const std::string path = reserve_file(still.name, still.ending);
    try {
        write_picture(picture, path, {.gamma = still.scene->settings.assumed_gamma, .exposure = still.exposure});
    } catch (...) {
        ::unlink(path.c_str());
        throw;
    }
    return {path, ""};
} catch (const FileError& error) {
    return {"", error.what()};
} catch (const std::bad_alloc&) {
    return {"", "not enough memory for a still of this size"};
}

std::string reserve_file(const std::string& name, const std::string& ending) {
    for (int number = 1;; ++number) {
        std::string path = name;
        if (number > 1) path.append("-").append(std::to_string(number));
        path += ending;
        const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) return ::close(file), path;
        if (errno != EEXIST) throw FileError("cannot write '" + path + "': " + std::generic_category().message(errno));
    }
}

std::string still_name(const std::string& scene_path, std::optional<double> moment) {
    const std::time_t now = std::time(nullptr);
    std::tm local{};
    ::localtime_r(&now, &local);
    char text[32];
    std::strftime(text, sizeof text, "-%Y%m%d-%H%M%S", &local);
    const std::string stem = scene_path == "-" ? "scene" : std::filesystem::path(scene_path).stem().string();
    return stem + text + (moment ? "-at-" + text_of(*moment) + "s" : "");
}

std::string folder_fault(const std::string& folder) {
    if (::access((folder.empty() ? "./" : folder + "/").c_str(), W_OK | X_OK) == 0) return "";
    return "stills cannot be written into " + (folder.empty() ? "the current folder" : "'" + folder + "'") + ": " +
           std::generic_category().message(errno);
}

}  // namespace strahl
