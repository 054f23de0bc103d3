// Renders stills one after the other, and writes their files.
#include "show/work/stills.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <system_error>
#include <utility>

#include "files/os/file.h"
#include "files/os/memory.h"
#include "files/os/system.h"
#include "files/os/thread.h"
#include "image/picture.h"
#include "num/decimal.h"
#include "num/thread_pool.h"

namespace strahl {

void Stills::add(Still still) {
    names.push_back(still.name);
    worker.add([this, still = std::move(still)](const std::atomic<bool>& stop) {
        os::lower_priority();
        std::optional<Outcome> outcome = make(still, stop);
        os::trim_memory();  // a still needs some hundred bytes a pixel
        share = 0;
        return outcome;
    });
}

std::vector<std::string> Stills::drop() {
    const auto dropped = static_cast<std::ptrdiff_t>(worker.cancel());
    return {names.end() - dropped, names.end()};
}

std::vector<Stills::Outcome> Stills::outcomes() {
    std::vector<Outcome> all;
    while (auto outcome = worker.take()) all.push_back(*std::move(outcome));
    return all;
}

std::optional<Stills::Outcome> Stills::make(const Still& still, const std::atomic<bool>& stop) try {
    const View& view = still.view;
    Picture picture{view.width, view.height, 3, std::vector<double>(std::size_t(3) * view.width * view.height)};
    const Lattice whole{.columns = view.width, .rows = view.height};
    const double all = double(view.width) * view.height;
    std::atomic<int> pixels = 0;
    const auto keep = [&](const Tile& tile) {
        place(tile, whole, picture.values);
        const int size = tile.lattice.columns * tile.lattice.rows, before = pixels.fetch_add(size);
        share = (before + size) / all;
        if (int(100 * before / all) != int(100 * (before + size) / all)) worker.notify();
    };
    ThreadPool pool(threads);
    Tracer tracer(*still.scene, Precision::float64);
    const Sampling sampling{.error = Sampling{}.error / gain_of(still.exposure)};
    tracer.trace({view, pool, keep, &stop}, SampledRegion{whole, sampling});
    if (stop) return std::nullopt;
    const std::string path = reserve_file(still.name, still.ending);
    try {
        write_picture(picture, path, {.gamma = still.scene->settings.assumed_gamma, .exposure = still.exposure});
    } catch (...) {
        std::remove(path.c_str());
        throw;
    }
    return Outcome{path, ""};
} catch (const FileError& error) {
    return Outcome{"", error.what()};
} catch (const std::bad_alloc&) {
    return Outcome{"", "not enough memory for a still of this size"};
}

std::string reserve_file(const std::string& name, const std::string& ending) {
    for (int number = 1;; ++number) {
        std::string path = name;
        if (number > 1) path.append("-").append(std::to_string(number));
        path += ending;
        if (os::OpenFile(path, os::OpenFile::OpenMode::create)) return path;
        if (errno != EEXIST) throw FileError("cannot write '" + path + "': " + std::generic_category().message(errno));
    }
}

std::string still_name(const std::string& scene_path, std::optional<double> moment) {
    const std::tm local = os::local_time(std::time(nullptr));
    char text[32];
    std::strftime(text, sizeof text, "-%Y%m%d-%H%M%S", &local);
    const std::string stem = scene_path == "-" ? "scene" : std::filesystem::path(scene_path).stem().string();
    return stem + text + (moment ? "-at-" + text_of(*moment) + "s" : "");
}

std::string folder_fault(const std::string& folder) {
    const int error = os::writable(folder.empty() ? "./" : folder + "/");
    if (!error) return "";
    return "stills cannot be written into " + (folder.empty() ? "the current folder" : "'" + folder + "'") + ": " +
           std::generic_category().message(error);
}

}  // namespace strahl
