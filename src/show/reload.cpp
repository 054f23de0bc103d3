// Watches the scene file.
#include "show/reload.h"

#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <utility>

#include "image/pixels.h"
#include "text/parse.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

/// Identifies a version of a file; all zero if there is none.
struct Stamp {
    dev_t device = 0;
    ino_t number = 0;
    off_t size = 0;
    time_t seconds = 0;
    long nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
};
Stamp stamp_of(const std::string& path) {
    struct stat s {};
    if (path == "-" || ::stat(path.c_str(), &s) != 0) return {};
    return {s.st_dev, s.st_ino, s.st_size, s.st_mtim.tv_sec, s.st_mtim.tv_nsec};
}

Loaded load(const std::string& path, const std::string& text) try {
    return {path, std::make_shared<const Scene>(scene_for_window(text, path)), "", false};
} catch (const FileError& error) {
    return {path, nullptr, error.what(), false};
}

/// Empty if the file can't be read now: editors remove files for a moment.
std::optional<std::string> text_of(const std::string& path) try { return read_text(path); } catch (const FileError&) {
    return std::nullopt;
}

}  // namespace

Scene scene_for_window(const std::string& text, const std::string& path) {
    Scene scene = parse_scene(text, path, {}, read_pixels);
    check_capacity(scene, Precision::float32);
    return scene;
}

Reload::Reload(std::string path_now, std::string text_now, std::function<void()> notify_function)
    : path(std::move(path_now)),
      text(std::move(text_now)),
      notify(std::move(notify_function)),
      thread([this](std::stop_token quit) { loop(quit); }) {}

Reload::~Reload() = default;

void Reload::open(std::string other) {
    {
        std::lock_guard lock(mutex);
        to_open = std::move(other);
    }
    wake.notify_one();
}

std::optional<Loaded> Reload::take() {
    std::lock_guard lock(mutex);
    return std::exchange(result, std::nullopt);
}

void Reload::tell(Loaded loaded) {
    {
        std::lock_guard lock(mutex);
        result = std::move(loaded);
    }
    notify();
}

void Reload::loop(std::stop_token quit) {
    // The file may have changed since it was read: the first check compares the text.
    Stamp known, before;
    while (!quit.stop_requested()) {
        std::optional<std::string> other;
        {
            std::unique_lock lock(mutex);
            wake.wait_for(lock, quit, std::chrono::milliseconds(200), [this] { return to_open.has_value(); });
            other = std::exchange(to_open, std::nullopt);
        }
        if (quit.stop_requested()) return;
        if (other) {
            std::string content;
            Loaded loaded{*other, nullptr, "", true};
            try {
                // A device or a pipe might never end.
                std::error_code error;
                if (std::filesystem::exists(*other, error) && !std::filesystem::is_regular_file(*other, error))
                    throw FileError(*other + ": this is no file");
                content = read_text(*other);
                loaded = load(*other, content);
                loaded.opened = true;
            } catch (const FileError& error) {
                loaded.fault = error.what();
            }
            if (loaded.scene) path = *other, text = std::move(content), known = before = {};
            tell(std::move(loaded));
            continue;
        }
        const Stamp now = stamp_of(path);
        const bool settled = now == std::exchange(before, now);
        if (now == Stamp{} || now == known || !settled) continue;
        known = now;
        std::optional<std::string> content = text_of(path);
        if (!content || *content == text) continue;
        text = std::move(*content);
        tell(load(path, text));
    }
}

}  // namespace strahl
