#include "show/welcome/gallery_reader.h"

#include <algorithm>
#include <new>
#include <utility>

#include "files/os/thread.h"
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

void GalleryReader::list() {
    listing = true;
    worker.add([](const std::atomic<bool>&) {
        os::lower_priority();
        return GalleryNews{.listed = gallery_of(installed_scenes(), read_recent_files())};
    });
}

void GalleryReader::want(std::vector<std::string> paths, int own_width, int own_height) {
    wanted = std::move(paths), width = own_width, height = own_height;
    if (!under_way.empty() && std::ranges::find(wanted, under_way) == wanted.end()) {
        worker.drop(), under_way.clear();
        if (listing) list();
    }
    make_next();
}

void GalleryReader::make_next() {
    const auto next = std::ranges::find_if(wanted, [this](const std::string& path) { return !made.contains(path); });
    if (!under_way.empty() || next == wanted.end()) return;
    under_way = *next;
    worker.add([path = under_way, columns = width, rows = height, threads = threads](const std::atomic<bool>& stop) {
        os::lower_priority();
        ThreadPool pool(threads);
        return GalleryNews{.path = path, .picture = small_picture(path, columns, rows, pool, stop)};
    });
}

std::optional<GalleryReader::GalleryNews> GalleryReader::take() {
    std::optional<GalleryNews> found = worker.take();
    if (!found) return found;
    if (found->listed) return listing = false, found;
    made.insert(found->path);
    if (under_way == found->path) under_way.clear();
    make_next();
    return found;
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
