#include "show/work/watched_scene.h"

#include <filesystem>
#include <utility>

#include "scene/error.h"

namespace strahl {

WatchedScene::WatchedScene(const Loaded& first, bool final, std::unique_ptr<Reload> reader, Notes& notes, Pace& pace,
                           std::function<void()> notify)
    : notes(notes),
      pace(pace),
      file(first.path),
      final(final),
      reload(std::move(reader)),
      awaited(!first.scene),
      error(first.fault),
      changes(first.changes),
      sized(first.sized),
      said(first.notes),
      read_for(first.read_for) {
    reload->listen(std::move(notify));
    if (reading()) log_line("reading " + name());
    if (!error.empty()) log_line("waiting until the scene has no error\n" + error);
}

void WatchedScene::open(std::string path) {
    if (awaited) file = path, error.clear();
    reload->open(std::move(path));
}

void WatchedScene::move_to(const ReadFor& wanted) {
    const bool moved = changes && wanted.seconds != read_for.seconds;
    const bool resized = sized && (wanted.width != read_for.width || wanted.height != read_for.height);
    if (moved || resized) reload->move_to(read_for = wanted);
}

std::optional<Loaded> WatchedScene::take() {
    auto loaded = reload->take();
    if (!loaded) return std::nullopt;
    pace.redraw();
    if (reading() && final && !loaded->scene) throw FileError(loaded->fault);
    error = loaded->fault;
    if (loaded->scene) {
        const bool first = std::exchange(awaited, false);
        file = loaded->path, changes = loaded->changes, sized = loaded->sized, said = loaded->notes;
        if (loaded->moved) return loaded;
        read_for = loaded->read_for;
        if (!first || !loaded->opened) log_line((loaded->opened ? "opened " : "read again: ") + file);
        return loaded;
    }
    error_until = loaded->opened && !awaited ? pace.now() + 10 : Pace::forever;
    log_line((awaited ? "the scene has an error\n" : "the scene has an error; the picture stays\n") + error);
    return std::nullopt;
}

void WatchedScene::write(const Flythrough& flythrough, ChangedText changes) {
    if (flythrough.keys.size() == 1) return notes.note("a path needs two keys");
    const bool confirmed = pace.now() < std::exchange(write_until, -1);
    reload->write(flythrough.keys.empty() ? std::nullopt : std::optional(flythrough), std::move(changes), confirmed);
}

void WatchedScene::write(const std::vector<Track>& tracks) {
    if (!awaited) reload->write(tracks);
}

void WatchedScene::tell_written() {
    const auto written = reload->take_written();
    if (!written) return;
    const std::string copy = written->copy.empty() ? "" : "; the file as it was is " + written->copy;
    if (written->asks) {
        write_until = pace.now() + 10;
        notes.announce(file + " has changed since it was read; F2 again writes into it");
    } else if (!written->fault.empty()) {
        notes.fail(written->fault);
    } else {
        notes.announce((!written->what.empty() ? written->what + " written into " : "tracks saved: ") + written->file +
                       copy);
    }
}

std::string WatchedScene::name() const {
    return file == "-" ? "standard input" : std::filesystem::path(file).filename().string();
}

std::string WatchedScene::way_to_keep() const {
    return file == "-" ? "Shift+C prints it" : "F2 writes it into " + file;
}

void WatchedScene::expire() {
    if (error_until <= pace.now()) error.clear();
}

std::string WatchedScene::fault_title() const {
    return awaited ? "The scene appears as soon as this error is corrected"
                   : "The scene file has an error; this is the previous picture";
}

}  // namespace strahl
