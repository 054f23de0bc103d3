#include "show/work/watched_scene.h"

#include <filesystem>
#include <utility>

#include "files/error.h"

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
        if (!loaded->renamed && (!first || !loaded->opened))
            log_line((loaded->opened ? "opened " : "read again: ") + file);
        return loaded;
    }
    error_until = loaded->opened && !awaited ? pace.now() + 10 : Pace::forever;
    log_line((awaited ? "the scene has an error\n" : "the scene has an error; the picture stays\n") + error);
    return std::nullopt;
}

void WatchedScene::write(const Flythrough& flythrough, ChangedText changes) {
    const bool confirmed = pace.now() < std::exchange(write_until, -1);
    const std::size_t keys = flythrough.keys.size();
    if (keys == 1) notes.note("a path needs two keys, and is not written yet");
    reload->write({.flythrough = keys == 0 ? std::nullopt : std::optional(flythrough),
                   .keeps_path = keys == 1,
                   .changes = std::move(changes),
                   .anyway = confirmed});
}

void WatchedScene::write(const std::vector<Track>& tracks) {
    if (!awaited) reload->write(tracks);
}

void WatchedScene::write_as(const std::string& path, const std::string& text, const Flythrough& flythrough,
                            const std::vector<Track>& tracks) {
    const bool flies = flythrough.keys.size() >= 2;
    reload->write_as(path, text, flies ? std::optional(flythrough) : std::nullopt, tracks);
}

std::optional<Written> WatchedScene::tell_written() {
    auto written = reload->take_written();
    if (!written) return written;
    const std::string copy = written->copy.empty() ? "" : "; the file as it was is " + written->copy;
    if (written->asks) {
        write_until = pace.now() + 10;
        notes.announce(file + " has changed since it was read; " + notes.key(Action::write_path) +
                       " again writes into it");
    } else if (!written->fault.empty()) {
        notes.fail(written->fault +
                   (written->refused ? "; " + notes.key(Action::save_as) + " saves it elsewhere" : ""));
    } else if (written->unchanged) {
        notes.note("nothing to write: " + written->file + " has all of it");
    } else {
        notes.announce((written->what.empty() ? "tracks saved: " : written->what + " written into ") + written->file +
                       (written->was_gone ? ", which was gone" : "") + copy);
    }
    return written;
}

std::string WatchedScene::name() const {
    return file == "-" ? "standard input" : std::filesystem::path(file).filename().string();
}

void WatchedScene::expire() {
    if (error_until <= pace.now()) error.clear();
}

std::string WatchedScene::fault_title() const {
    return awaited ? "The scene appears as soon as this error is corrected"
                   : "The scene file has an error; this is the previous picture";
}

}  // namespace strahl
