#include "show/welcome/gallery_reader.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <new>
#include <set>

#include "files/read_file.h"
#include "files/regular_file.h"
#include "image/pixels.h"
#include "image/transfer_table.h"
#include "num/thread_pool.h"
#include "scene/moving_scene.h"
#include "show/motion/quality.h"
#include "show/session/framing.h"
#include "show/welcome/recent_files.h"
#include "show/work/reload.h"

namespace strahl {

/// The data that the window and the thread share.
struct GalleryReader::Desk {
    std::mutex mutex;
    std::condition_variable wake, ended_now;
    bool quit = false, ended = false, to_list = false;
    std::vector<std::string> wanted;
    int width = 1, height = 1;
    std::string under_way;
    std::atomic<bool> stop = false;  // what is under way
    std::set<std::string> made;
    std::optional<std::vector<GallerySection>> listed;
    std::vector<std::pair<std::string, SmallPicture>> pictures;

    /// Does one thing that is asked for, or waits. Returns false at the end.
    bool work(ThreadPool& pool, const std::function<void()>& notify);
};

bool GalleryReader::Desk::work(ThreadPool& pool, const std::function<void()>& notify) {
    std::unique_lock lock(mutex);
    const auto next = [this] {
        return std::ranges::find_if(wanted, [this](const std::string& path) { return !made.contains(path); });
    };
    wake.wait(lock, [&] { return quit || to_list || next() != wanted.end(); });
    if (quit) return false;
    if (std::exchange(to_list, false)) {
        lock.unlock();
        auto sections = gallery_of(installed_scenes(), read_recent_files());
        lock.lock();
        listed = std::move(sections);
    } else {
        under_way = *next(), stop = false;
        const std::string path = under_way;
        const int columns = width, rows = height;
        lock.unlock();
        SmallPicture picture = small_picture(path, columns, rows, pool, stop);
        lock.lock();
        under_way.clear();
        if (stop) return !quit;
        made.insert(path), pictures.emplace_back(path, std::move(picture));
    }
    if (quit) return false;
    lock.unlock();
    notify();
    return true;
}

GalleryReader::GalleryReader(int threads, std::function<void()> notify)
    : desk(std::make_shared<Desk>()), thread([desk = desk, threads, notify = std::move(notify)] {
          static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), 10));
          {
              ThreadPool pool(threads);
              while (desk->work(pool, notify)) {
              }
          }
          std::lock_guard lock(desk->mutex);
          desk->ended = true;
          desk->ended_now.notify_all();
      }) {}

GalleryReader::~GalleryReader() {
    std::unique_lock lock(desk->mutex);
    desk->quit = desk->stop = true;
    desk->wake.notify_one();
    const bool ended = desk->ended_now.wait_for(lock, std::chrono::seconds(5), [this] { return desk->ended; });
    lock.unlock();
    if (ended) {
        thread.join();
        return;
    }
    // It may still make a scene, with data that are destroyed after main() has returned.
    thread.detach();
    ::on_exit([](int status, void*) { std::_Exit(status); }, nullptr);
}

void GalleryReader::list() {
    std::lock_guard lock(desk->mutex);
    desk->to_list = true;
    desk->wake.notify_one();
}

void GalleryReader::want(std::vector<std::string> paths, int width, int height) {
    std::lock_guard lock(desk->mutex);
    desk->wanted = std::move(paths), desk->width = width, desk->height = height;
    if (std::ranges::find(desk->wanted, desk->under_way) == desk->wanted.end()) desk->stop = true;
    desk->wake.notify_one();
}

std::optional<std::vector<GallerySection>> GalleryReader::take_list() {
    std::lock_guard lock(desk->mutex);
    return std::exchange(desk->listed, std::nullopt);
}

std::vector<std::pair<std::string, SmallPicture>> GalleryReader::take_pictures() {
    std::lock_guard lock(desk->mutex);
    return std::exchange(desk->pictures, {});
}

SmallPicture small_picture(const std::string& path, int width, int height, ThreadPool& pool,
                           const std::atomic<bool>& stop) try {
    static_cast<void>(RegularFile(path));  // throws for a pipe, which might never end
    if (ScreenImage kept = kept_picture(path, width, height); kept.width > 0) return {std::move(kept)};
    SmallPicture picture;
    FilesRead named;
    OpeningOptions options;
    options.stop = &stop, options.files = &picture.files;
    OpenedScene opened = open_scene(read_scene_text(path), path, options, read_pixels, &named);
    const Scene scene = std::move(opened.scene);
    check_capacity(scene, Precision::float32);
    const Framing frame = framing(own_camera_at(scene, 0, nullptr), width, height, true);
    const View view{.camera = frame.camera, .width = width, .height = height, .depth = scene.settings.max_trace_level};
    Tracer tracer(scene, Precision::float32);
    picture.image = traced_picture(tracer, view, pool, TransferTable(scene.settings.assumed_gamma), {.grid = 2}, &stop);
    for (const auto& names : {named.meshes, named.pictures})
        for (const std::string& name : names) picture.files.push_back(path_beside(path, name));
    picture.files.insert(picture.files.end(), opened.files.begin(), opened.files.end());
    picture.files.push_back(path);
    if (!stop && picture.image.width > 0) keep_picture(path, picture);
    return picture;
} catch (const FileError& error) {
    return {.fault = error.what()};
} catch (const std::bad_alloc&) {
    return {.fault = path + ": too large for the memory"};
}

}  // namespace strahl
