#include "show/work/watched_scene.h"

#include <utility>

namespace strahl {

WatchedScene::WatchedScene(const Loaded& first, std::string text, Notes& notes, Pace& pace,
                           std::function<void()> notify)
    : notes(notes),
      pace(pace),
      file(first.path),
      reload(file, std::move(text), std::move(notify)),
      awaited(!first.scene),
      error(first.fault) {
    if (awaited) log_line("waiting until the scene has no error\n" + error);
}

std::optional<Loaded> WatchedScene::take() {
    auto loaded = reload.take();
    if (!loaded) return std::nullopt;
    pace.redraw();
    error = loaded->fault;
    if (loaded->scene) {
        awaited = false;
        file = loaded->path;
        log_line((loaded->opened ? "opened " : "read again: ") + file);
        return loaded;
    }
    error_until = loaded->opened && !awaited ? pace.now() + 10 : Pace::forever;
    log_line((awaited ? "the scene has an error\n" : "the scene has an error; the picture stays\n") + error);
    return std::nullopt;
}

void WatchedScene::write(const Flythrough& flythrough) {
    if (flythrough.keys.size() == 1) return notes.note("a path needs two keys");
    const bool confirmed = pace.now() < std::exchange(write_until, -1);
    reload.write(flythrough.keys.empty() ? std::nullopt : std::optional(flythrough), confirmed);
}

void WatchedScene::write(const std::vector<Track>& tracks) {
    if (!awaited) reload.write(tracks);
}

void WatchedScene::tell_written() {
    const auto written = reload.take_written();
    if (!written) return;
    const std::string copy = written->copy.empty() ? "" : "; the file as it was is " + written->copy;
    if (written->asks) {
        write_until = pace.now() + 10;
        notes.announce(file + " has changed since it was read; F2 again writes the path into it");
    } else if (!written->fault.empty()) {
        notes.announce(written->fault);
    } else {
        notes.announce((written->file == file ? "path written into " : "tracks saved: ") + written->file + copy);
    }
}

void WatchedScene::expire() {
    if (error_until <= pace.now()) error.clear();
}

std::string WatchedScene::fault_title() const {
    return awaited ? "The scene appears as soon as this error is corrected"
                   : "The scene file has an error; this is the previous picture";
}

}  // namespace strahl
