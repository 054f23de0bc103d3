// Watches the scene file, and writes into it, in a thread of its own.
#include "show/work/reload.h"

#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <utility>

#include "files/output_file.h"
#include "files/read_file.h"
#include "image/pixels.h"
#include "text/edit_path.h"
#include "text/parse.h"
#include "text/reading/tracks_file.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

FileStamp stamp_of(const std::string& path) {
    struct stat s {};
    if (path == "-" || ::stat(path.c_str(), &s) != 0) return {};
    return {s.st_dev, s.st_ino, s.st_size, s.st_mtim.tv_sec, s.st_mtim.tv_nsec};
}

Loaded load(const std::string& path, const std::string& text) try {
    return {path, std::make_shared<const Scene>(scene_for_window(text, path)), "", false};
} catch (const FileError& error) {
    return {path, nullptr, error.what(), false};
}

/// Reads a file; nothing if it cannot be read now: editors remove files for a moment.
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

void Reload::write(std::optional<Flythrough> flythrough, bool anyway) {
    {
        std::lock_guard lock(mutex);
        to_write.push_back({std::move(flythrough), anyway});
    }
    wake.notify_one();
}

void Reload::write(std::vector<Track> tracks) {
    {
        std::lock_guard lock(mutex);
        to_write.push_back({{}, true, std::move(tracks)});
    }
    wake.notify_one();
}

std::optional<Written> Reload::take_written() {
    std::lock_guard lock(mutex);
    if (written.empty()) return std::nullopt;
    Written first = std::move(written.front());
    written.erase(written.begin());
    return first;
}

void Reload::loop(std::stop_token quit) {
    while (true) {
        std::optional<std::string> other;
        std::vector<Request> requests;
        {
            std::unique_lock lock(mutex);
            wake.wait_for(lock, quit, std::chrono::milliseconds(200), [this] { return to_open || !to_write.empty(); });
            other = std::exchange(to_open, std::nullopt), requests = std::exchange(to_write, {});
        }
        for (const Request& request : requests) {  // before the window closes, too
            Written done = request.tracks ? write_tracks(*request.tracks) : write_path(request);
            std::lock_guard lock(mutex);
            written.push_back(std::move(done));
        }
        if (quit.stop_requested()) return;
        if (!requests.empty()) notify();
        if (other) open_file(*other);
        if (requests.empty() && !other) check_file();
    }
}

void Reload::open_file(const std::string& other) {
    std::string content;
    Loaded loaded{other, nullptr, "", true};
    try {
        // A device or a pipe might never end.
        std::error_code error;
        if (std::filesystem::exists(other, error) && !std::filesystem::is_regular_file(other, error))
            throw FileError(other + ": not a regular file");
        content = read_text(other);
        loaded = load(other, content);
        loaded.opened = true;
    } catch (const FileError& error) {
        loaded.fault = error.what();
    }
    if (loaded.scene) path = other, text = std::move(content), known = before = {};
    tell(std::move(loaded));
}

void Reload::check_file() {
    const FileStamp now = stamp_of(path);
    const bool settled = now == std::exchange(before, now);
    if (now == FileStamp{} || now == known || !settled) return;
    known = now;
    std::optional<std::string> content = text_of(path);
    if (!content || *content == text) return;
    text = std::move(*content);
    tell(load(path, text));
}

Written Reload::write_path(const Request& request) try {
    if (path == "-") return {.fault = "the scene came from standard input; Shift+C copies the path"};
    const std::string content = read_text(path);
    if (content != text && !request.anyway) return {.file = path, .asks = true};
    static_cast<void>(scene_for_window(content, path));  // throws: in a text with errors the block cannot be found
    const std::string changed = with_path(content, request.flythrough);
    Loaded loaded = load(path, changed);
    if (!loaded.scene || loaded.scene->flythrough != request.flythrough)
        return {.fault = "the path cannot be written: " + loaded.fault};
    Written done{.file = path};
    if (content != own_text) write_file(done.copy = path + "~", content);
    write_file(path, changed);
    text = own_text = changed;
    tell(std::move(loaded));
    return done;
} catch (const FileError& error) {
    return {.fault = error.what()};
}

Written Reload::write_tracks(const std::vector<Track>& tracks) try {
    if (path == "-")
        return {.fault = "the scene came from standard input, so there is no file to save its tracks beside"};
    Written done{.file = tracks_path(path)};
    const std::string text_now = strahl::write_tracks(tracks);
    std::error_code error;
    const std::string before = std::filesystem::exists(done.file, error) ? read_text(done.file) : "";
    if (!before.empty() && before != own_tracks && before != text_now) write_file(done.copy = done.file + "~", before);
    write_file(done.file, text_now);
    own_tracks = text_now;
    return done;
} catch (const FileError& error) {
    return {.fault = error.what()};
}

}  // namespace strahl
