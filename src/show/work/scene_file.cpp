#include "show/work/scene_file.h"

#include <utility>

namespace strahl {

SceneFile::SceneFile(const Loaded& first, std::string text, Notes& window_notes, Pace& window_pace,
                     std::function<void()> notify)
    : notes(window_notes),
      pace(window_pace),
      file(first.path),
      reload(file, std::move(text), std::move(notify)),
      awaited(!first.scene),
      error(first.fault) {
    if (awaited) log_line("waiting until the scene has no error\n" + error);
}

std::optional<Loaded> SceneFile::take() {
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

void SceneFile::write(const Flythrough& flythrough) {
    if (flythrough.keys.size() == 1) return notes.note("a path needs two keys");
    const bool confirmed = pace.now() < std::exchange(write_until, -1);
    reload.write(flythrough.keys.empty() ? std::nullopt : std::optional(flythrough), confirmed);
}

void SceneFile::write(const std::vector<Track>& tracks) {
    if (!awaited) reload.write(tracks);
}

void SceneFile::tell_written() {
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

void SceneFile::expire() {
    if (error_until <= pace.now()) error.clear();
}

std::string SceneFile::fault_title() const {
    return awaited ? "The scene appears as soon as this error is corrected"
                   : "The scene file has an error; this is the previous picture";
}

}  // namespace strahl
