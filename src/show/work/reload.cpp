// Reads and watches the scene file, and writes into it, in a thread of its own.
#include "show/work/reload.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <set>
#include <utility>

#include "files/os/file.h"
#include "files/os/thread.h"
#include "files/output_file.h"
#include "files/read_file.h"
#include "files/regular_file.h"
#include "files/utf8.h"
#include "image/pixels.h"
#include "pov/flight_file.h"
#include "pov/ini_file.h"
#include "show/work/text_file.h"
#include "text/edit_path.h"
#include "text/music_text.h"
#include "text/parse_body.h"
#include "text/reading/tracks_file.h"
#include "text/scene_warnings.h"
#include "trace/tracer.h"

namespace strahl {
namespace {

constexpr auto check_interval = std::chrono::milliseconds(33);

constexpr std::size_t most_text = 16 << 20;  // bytes of a text whose numbers can be changed in the window

/// All zero, unless it is a regular file: reading another one again would take something else from it.
os::FileStamp stamp_of(const std::string& path) {
    const os::FileStatus status = path == "-" ? os::FileStatus{} : os::status_of(path);
    return status.regular() ? status.stamp : os::FileStamp{};
}

Loaded loaded_scene(const std::string& path, const std::string& text, bool opened, const OpeningOptions& options) try {
    const std::string name = path == "-" ? "standard input" : path;
    OpenedScene read = scene_for_window(text, name, options);
    if (opened)
        for (const Message& note : read.notes) std::cerr << "strahl: warning: " << printable(note.told()) << '\n';
    auto scene = std::make_shared<const Scene>(std::move(read.scene));
    const EyeWords words = is_pov(path) || is_model(path) ? EyeWords{} : eye_words(text);
    return {.path = path,
            .scene = std::move(scene),
            .notes = std::move(read.notes),
            .opened = opened,
            .words = words,
            .mirrored = read.mirrored,
            .changes = read.changes,
            .sized = read.sized,
            .read_for = {options.time.value_or(0), options.size.width, options.size.height},
            .lines = std::move(read.lines),
            .text = text.size() > most_text ? std::string() : text};
} catch (const FileError& error) {
    return {.path = path, .fault = error.what(), .opened = opened};
}

/// Reads a file; nothing if it cannot be read now: editors remove files for a moment.
std::optional<std::string> text_of(const std::string& path) try {
    return read_text_file(path).text;
} catch (const FileError&) {
    return std::nullopt;
}

/// Do the scenes give the same pictures at all moments, if they have the same tracks?
bool same_pictures(const Scene& a, const Scene& b) {
    const auto round = [](const Scene& s) {
        return s.flythrough && s.flythrough->loop ? std::optional(s.flythrough->duration) : std::nullopt;
    };
    if (round(a) != round(b)) return false;
    Scene same = b;
    same.flythrough = a.flythrough, same.tracks = a.tracks;
    return a == same;
}

std::vector<os::FileStamp> stamps_of(const std::vector<std::string>& files) {
    std::vector<os::FileStamp> stamps;
    for (const std::string& file : files) stamps.push_back(stamp_of(file));
    return stamps;
}

/// Thrown to end a thread whose answers are no longer wanted.
struct LeftBehind {};

}  // namespace

OpenedScene scene_for_window(const std::string& text, const std::string& path, const OpeningOptions& options) {
    OpenedScene opened = open_scene(text, path, options, read_pixels);
    check_capacity(opened.scene, Precision::float32);
    return opened;
}

/// The data that the window and the thread share.
struct Reload::Desk {
    std::mutex mutex;
    std::condition_variable wake, changed;  // wake: there is something to do; changed: something is done
    bool quit = false, ended = false, left = false;
    bool away = false, writing = false;  // away: in a file that may give no answer
    std::optional<std::string> to_open;
    std::optional<TextToShow> to_show;
    std::optional<ReadFor> to_move;
    std::vector<Request> to_write;
    std::optional<Loaded> result, shown;
    std::vector<Written> written;
    std::function<void()> notify;
};

/// The thread's own part. The file may have changed since it was read: the first check compares the text.
class Reload::FileThread {
  public:
    FileThread(std::shared_ptr<Desk> shared, std::string first, OpeningOptions options)
        : desk(std::move(shared)), path(std::move(first)), options(std::move(options)) {}
    void run();

  private:
    /// Calls a function that a file may keep waiting for ever. Throws LeftBehind if the window was closed meanwhile.
    template <class Access>
    auto answer(Access access) {
        const auto set_away = [this](bool away) {
            std::lock_guard lock(desk->mutex);
            if (desk->left) throw LeftBehind();
            desk->away = away;
            desk->changed.notify_all();
        };
        set_away(true);
        try {
            auto result = access();
            set_away(false);
            return result;
        } catch (const FileError&) {
            set_away(false);
            throw;
        }
    }
    TextOnDisk read(const std::string& file) {
        return answer([&] { return read_text_file(file); });
    }
    void write(const std::string& file, const TextOnDisk& content) {
        answer([&] { return write_text_file(file, content), true; });
    }
    bool gone(const std::string& file) {
        return answer([&] { return is_gone(file); });
    }
    /// Makes FILE~, unless Strahl wrote the file as it is, which has this text. Returns its path, or "".
    std::string keep_copy(const std::string& file, const std::string& content, const std::string& own) {
        return content == own ? "" : answer([&] { return back_up(file); });
    }
    /// Makes a scene of a text, which may name other files.
    Loaded load(const std::string& file, const std::string& content, bool opened) {
        return answer([&] {
            std::vector<std::string> read;
            OpeningOptions how = options;
            how.files = &read;
            Loaded loaded = loaded_scene(file, content, opened, how);
            if (loaded.scene && !loaded.text.empty() && file != "-" && !is_pov(file) && !is_model(file))
                loaded.tracks = text_of(tracks_path(file)).value_or("");
            if (file == path || loaded.scene) watch(file, std::move(read));
            if (!loaded.scene) return loaded;
            if (opened) loaded.warnings = scene_warnings(*loaded.scene);
            if (!shown_scene || !same_pictures(*shown_scene, *loaded.scene)) shown_scene = loaded.scene;
            loaded.picture = shown_scene;
            return loaded;
        });
    }
    /// Watches the files that a scene consists of, and those that may be put beside it.
    void watch(const std::string& file, std::vector<std::string> read) {
        std::erase(read, file);
        if (is_pov(file)) read.push_back(pov::flight_path(file)), read.push_back(pov::beside(file, ".ini"));
        if (!is_pov(file) && !is_model(file)) read.push_back(tracks_path(file));
        others = std::move(read), known_others = stamps_of(others);
    }
    void tell(Loaded loaded);
    void show_text(const TextToShow& changed);
    void notify();
    void open_file(const std::string& file, bool first);
    void check_file();
    void read_moment(const ReadFor& moment);
    Written write(const Request& request);
    Written write_path(const ToWrite& wanted);
    Written write_flight(const std::optional<Flythrough>& flight);
    Written write_tracks(const std::vector<Track>& tracks);
    Written write_elsewhere(const Request& request);

    const std::shared_ptr<Desk> desk;
    std::string path, text, own_text, own_tracks, own_flight;  // own_: what Strahl wrote last
    std::optional<Loaded> saved;               // elsewhere; shown once that is told, since the window may end then
    std::optional<std::string> shown_text;     // what was shown since the file was read or written
    std::shared_ptr<const Scene> shown_scene;  // the first one that gave the picture of the last one
    OpeningOptions options;
    bool any_scene = false;  // has been read
    os::FileStamp known, before;
    std::vector<std::string> others;  // files that the scene includes
    std::vector<os::FileStamp> known_others, others_before;
};

Reload::Reload(const std::string& path, OpeningOptions options)
    : desk(std::make_shared<Desk>()), thread([desk = desk, path, options = std::move(options)] {
          try {
              FileThread(desk, path, options).run();
          } catch (const LeftBehind&) {
              return;
          }
          std::lock_guard lock(desk->mutex);
          desk->ended = true;
          desk->changed.notify_all();
      }) {}

Reload::~Reload() {
    using namespace std::chrono_literals;
    std::unique_lock lock(desk->mutex);
    desk->quit = true;
    desk->wake.notify_one();
    const auto waits = [this] { return desk->away && !desk->writing && desk->to_write.empty(); };
    desk->changed.wait_for(lock, 5s, [&] { return desk->ended || waits(); });
    desk->changed.wait_for(lock, 30s, [this] { return desk->ended || desk->away; });
    desk->left = !desk->ended;
    lock.unlock();
    desk->left ? thread.detach() : thread.join();
    if (desk->left) os::leave_thread_behind();
}

void Reload::listen(std::function<void()> notify) {
    std::lock_guard lock(desk->mutex);
    desk->notify = std::move(notify);
}

void Reload::open(std::string other) {
    std::lock_guard lock(desk->mutex);
    desk->to_open = std::move(other);
    desk->wake.notify_one();
}

std::optional<Loaded> Reload::take(double seconds) {
    std::unique_lock lock(desk->mutex);
    desk->changed.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return desk->result.has_value(); });
    return std::exchange(desk->result, std::nullopt);
}

void Reload::move_to(const ReadFor& moment) {
    std::lock_guard lock(desk->mutex);
    desk->to_move = moment;
    desk->wake.notify_one();
}

void Reload::show(std::string text, std::optional<ChangedBody> change) {
    std::lock_guard lock(desk->mutex);
    desk->to_show = TextToShow{std::move(text), std::move(change)};
    desk->wake.notify_one();
}

std::optional<Loaded> Reload::take_shown() {
    std::lock_guard lock(desk->mutex);
    return std::exchange(desk->shown, std::nullopt);
}

void Reload::write(ToWrite wanted) {
    std::lock_guard lock(desk->mutex);
    desk->to_write.push_back({std::move(wanted)});
    desk->wake.notify_one();
}

void Reload::write(std::vector<Track> tracks) {
    std::lock_guard lock(desk->mutex);
    desk->to_write.push_back({{}, std::move(tracks)});
    desk->wake.notify_one();
}

void Reload::write_as(std::string path, std::string text, std::optional<Flythrough> flythrough,
                      std::vector<Track> tracks) {
    std::lock_guard lock(desk->mutex);
    desk->to_write.push_back({{std::move(flythrough)}, std::move(tracks), std::move(path), std::move(text)});
    desk->wake.notify_one();
}

std::optional<Written> Reload::take_written() {
    std::lock_guard lock(desk->mutex);
    if (desk->written.empty()) return std::nullopt;
    Written first = std::move(desk->written.front());
    desk->written.erase(desk->written.begin());
    return first;
}

void Reload::FileThread::run() {
    if (!path.empty()) open_file(path, true);
    while (true) {
        std::optional<std::string> other;
        std::optional<TextToShow> changed;
        std::optional<ReadFor> moment;
        std::vector<Request> requests;
        bool quit;
        {
            std::unique_lock lock(desk->mutex);
            desk->writing = false;
            desk->wake.wait_for(lock, check_interval, [this] {
                return desk->quit || desk->to_open || desk->to_show || desk->to_move || !desk->to_write.empty();
            });
            other = std::exchange(desk->to_open, std::nullopt), requests = std::exchange(desk->to_write, {});
            changed = std::exchange(desk->to_show, std::nullopt), moment = std::exchange(desk->to_move, std::nullopt);
            desk->writing = !requests.empty(), quit = desk->quit;
        }
        for (const Request& request : requests) {  // before the window closes, too
            Written done = write(request);
            {
                std::lock_guard lock(desk->mutex);
                desk->written.push_back(std::move(done));
            }
            if (saved) tell(*std::exchange(saved, std::nullopt));
        }
        if (quit) return;
        if (!requests.empty()) notify();
        if (other) open_file(*other, false);
        if (changed) show_text(*changed);
        if (moment && !other) read_moment(*moment);
        if (requests.empty() && !other && !changed) check_file();
    }
}

void Reload::FileThread::tell(Loaded loaded) {
    {
        std::lock_guard lock(desk->mutex);
        desk->result = std::move(loaded);
        desk->changed.notify_all();
    }
    notify();
}

void Reload::FileThread::show_text(const TextToShow& changed) {
    Loaded loaded{.path = path, .text = changed.text};
    if (const auto& change = changed.change) {
        auto scene = answer(
            [&] { return with_body(*change->scene, change->body, change->context, change->block, path, read_pixels); });
        if (scene) loaded.scene = std::make_shared<const Scene>(*std::move(scene));
    }
    if (!loaded.scene) loaded = load(path, changed.text, false);
    if (loaded.scene) loaded.picture = shown_scene = loaded.scene;
    shown_text = loaded.text = changed.text;  // also if the text has an error
    {
        std::lock_guard lock(desk->mutex);
        desk->shown = std::move(loaded);
    }
    notify();
}

void Reload::FileThread::read_moment(const ReadFor& moment) {
    // At the start of a flight the clock stands as it does where no moment was asked for.
    if (moment.seconds != 0 || options.time) options.time = moment.seconds;
    options.size = {moment.width, moment.height};
    Loaded loaded = load(path, shown_text.value_or(text), false);
    loaded.moved = true;
    std::unique_lock lock(desk->mutex);
    if (!loaded.scene || desk->result) return;  // the error is told when the file changes
    lock.unlock();
    tell(std::move(loaded));
}

void Reload::FileThread::notify() {
    std::unique_lock lock(desk->mutex);
    const std::function<void()> function = desk->notify;
    lock.unlock();
    if (function) function();
}

/// Reads the `first` file, or another one. It is watched from now on, unless it has an error and another scene is
/// shown.
void Reload::FileThread::open_file(const std::string& file, bool first) {
    std::string content;
    Loaded loaded{.path = file, .opened = true};
    if (!first) options.ini.reset(), options.time.reset();
    try {
        content = answer([&] {
            if (!first) static_cast<void>(RegularFile(file));  // throws for a pipe, which might never end
            return read_text_file(file).text;
        });
        shown_scene = nullptr;
        loaded = load(file, content, true);
    } catch (const FileError& error) {
        loaded.fault = error.what();
    }
    any_scene |= loaded.scene != nullptr;
    if (loaded.scene || !any_scene) path = file, text = std::move(content), known = before = {}, shown_text.reset();
    tell(std::move(loaded));
}

void Reload::FileThread::check_file() {
    const auto [now, now_others] = answer([this] { return std::pair(stamp_of(path), stamps_of(others)); });
    const bool settled = now == std::exchange(before, now);
    const bool others_settled = now_others == std::exchange(others_before, now_others);
    const bool included = now_others != known_others;
    if (now == os::FileStamp{} || (now == known && !included) || !settled || !others_settled) return;
    known = now;
    std::optional<std::string> content = answer([this] { return text_of(path); });
    if (!content || (*content == text && !included)) return;
    text = std::move(*content), shown_text.reset();
    tell(load(path, text, false));
}

Written Reload::FileThread::write(const Request& request) try {
    if (!request.path.empty()) return write_elsewhere(request);
    return request.tracks ? write_tracks(*request.tracks) : write_path(request.wanted);
} catch (const OutputError& error) {
    return {.fault = error.what(), .refused = true};
} catch (const FileError& error) {
    return {.fault = error.what()};
}

Written Reload::FileThread::write_path(const ToWrite& wanted) {
    const bool bodies = wanted.changes.changed != wanted.changes.in_file;
    if (path == "-")
        return {.fault = "the scene came from standard input, so there is no file to write", .refused = true};
    if (is_model(path))
        return {.fault = "a model has no text to change: strahl import " + path + " -o SCENE.rt makes a scene of it",
                .refused = true};
    const bool was_gone = gone(path);
    if (is_pov(path) && !bodies && !was_gone) return write_flight(wanted.flythrough);
    const TextOnDisk there = was_gone ? TextOnDisk{text} : read(path);
    const std::string& content = there.text;
    if (content != text && !wanted.anyway) return {.file = path, .asks = true};
    // Throws: in texts with errors no block can be found.
    const OpenedScene before = scene_for_window(content, path, options);
    const auto& path_before = before.scene.flythrough;
    // The flight of a clock has no keys.
    const bool same_path = wanted.keeps_path || path_before == wanted.flythrough ||
                           (path_before && path_before->keys.empty() && !wanted.flythrough);
    const RebasedText merged = bodies ? rebased(wanted.changes, content) : RebasedText{};
    if (merged.lost)
        return {.fault = path + " has changed in lines that were changed here; undo, or save it as another file",
                .refused = true};
    const std::string text_now = bodies ? text_of(merged.text.changed) : content;
    const bool beside = is_pov(path);  // the path has a file of its own
    const std::string changed = same_path || beside ? text_now : with_path(text_now, wanted.flythrough);
    if (changed == content && !was_gone)
        return beside && !same_path ? write_flight(wanted.flythrough) : Written{.file = path, .unchanged = true};
    Loaded loaded = load(path, changed, false);
    if (!loaded.scene || (!same_path && !beside && loaded.scene->flythrough != wanted.flythrough))
        return {.fault = "the changes cannot be written: " + loaded.fault};
    Written done{.file = path,
                 .what = !bodies     ? "path"
                         : same_path ? "changes"
                                     : "path and changes",
                 .was_gone = was_gone};
    if (!was_gone) done.copy = keep_copy(path, content, own_text);
    write(path, {changed, there.crlf});
    text = own_text = changed, shown_text.reset();
    if (beside && !same_path) return write_flight(wanted.flythrough);
    tell(std::move(loaded));
    return done;
}

/// Writes the flight of a scene of POV-Ray into the file beside it.
Written Reload::FileThread::write_flight(const std::optional<Flythrough>& flight) {
    Written done{.file = pov::flight_path(path), .what = "path"};
    const TextOnDisk old = gone(done.file) ? TextOnDisk{} : read(done.file);
    const Loaded now = load(path, text, false);
    if (!now.scene) return {.fault = "the path cannot be written: " + now.fault};
    const std::string changed = pov::with_flight(old.text, flight, now.mirrored);
    if (changed == old.text) return done.unchanged = true, done;
    if (!old.text.empty()) done.copy = keep_copy(done.file, old.text, own_flight);
    write(done.file, {changed, old.crlf});
    own_flight = changed;
    tell(load(path, text, false));
    return done;
}

Written Reload::FileThread::write_tracks(const std::vector<Track>& tracks) {
    if (path == "-")
        return {.fault = "the scene came from standard input, so there is no file to save its tracks beside",
                .refused = true};
    Written done{.file = tracks_path(path)};
    const TextOnDisk old = gone(done.file) ? TextOnDisk{} : read(done.file);
    std::string text_now = old.text;
    for (const Track& track : tracks) text_now = with_keys(text_now, track);
    if (text_now == old.text) return done.unchanged = true, done;
    if (!old.text.empty()) done.copy = keep_copy(done.file, old.text, own_tracks);
    write(done.file, {text_now, old.crlf});
    done.tracks = own_tracks = text_now;
    // The scene is not read again for them.
    const auto known_as = std::ranges::find(others, done.file);
    if (known_as != others.end() && known_others.size() == others.size())
        known_others[std::size_t(known_as - others.begin())] = answer([&] { return stamp_of(done.file); });
    return done;
}

/// Writes the scene with all changes into another file, which is watched from now on.
Written Reload::FileThread::write_elsewhere(const Request& request) {
    const std::string& to = request.path;
    if (is_model(path))
        return {.fault = "a model has no text: strahl import " + path + " -o SCENE.rt makes a scene of it",
                .refused = true};
    if (answer([&] { return same_file(path, to); }))
        return {.fault = "this is the scene's own file: choose another name"};
    std::string content = request.text.empty() ? text : request.text;
    const std::set<std::string> files = answer([&] {
        FilesRead read;
        const OpenedScene scene = open_scene(content, path, options, read_pixels, &read);
        std::set<std::string> all(scene.files.begin(), scene.files.end());
        for (const auto* names : {&read.meshes, &read.pictures, &read.sounds})
            for (const std::string& name : *names) all.insert(path_beside(path, name));
        return all;
    });
    content = with_names_beside(content, path, to, files);
    const std::optional<Flythrough>& flight = request.wanted.flythrough;
    const bool pov = is_pov(to);
    if (!pov && flight) content = with_path(content, flight);
    // What belongs to the scene is there before the scene itself is.
    std::string keys = path == "-" || pov ? "" : text_of(tracks_path(path)).value_or("");
    for (const Track& track : *request.tracks) keys = with_keys(keys, track);
    const auto replace = [&](const std::string& file, const TextOnDisk& newer) {
        if (!gone(file)) keep_copy(file, read(file).text, "");
        write(file, newer);
    };
    if (!keys.empty()) replace(tracks_path(to), {keys});
    if (pov && !gone(pov::beside(path, ".ini"))) replace(pov::beside(to, ".ini"), read(pov::beside(path, ".ini")));
    Loaded loaded = load(to, content, false);
    if (pov && flight && loaded.scene) {
        replace(pov::flight_path(to), {pov::with_flight("", flight, loaded.mirrored)});
        loaded = load(to, content, false);
    }
    if (!loaded.scene) return {.fault = "the scene cannot be written: " + loaded.fault};
    replace(to, {content});
    path = to, text = own_text = content, own_tracks = keys, own_flight.clear(), shown_text.reset(),
    known = before = {};
    loaded.renamed = true;
    saved = std::move(loaded);
    return {.file = to, .what = "scene"};
}

}  // namespace strahl
