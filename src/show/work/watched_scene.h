// The scene file as the window sees it: its errors, its changes on disk, and what the user writes into it.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "show/work/notes.h"
#include "show/work/reload.h"

namespace strahl {

class WatchedScene {
  public:
    /// `first` is the scene, as far as `reader` has read it. An error in it ends the program if it is `final`. `notify`
    /// is called from another thread when there is something to take.
    WatchedScene(const Loaded& first, bool final, std::unique_ptr<Reload> reader, Notes& notes, Pace& pace,
                 std::function<void()> notify);

    const std::string& path() const { return file; }
    /// The name for messages and titles.
    std::string name() const;
    /// Is there no scene yet, because the file is still being read, missing or has an error, or because none is open?
    bool waiting() const { return awaited; }
    /// Is the first file still being read?
    bool reading() const { return awaited && error.empty() && !file.empty(); }
    /// Returns the messages about the scene that reading it gave, see OpenedScene::notes.
    const std::vector<Message>& messages() const { return said; }
    /// Does the scene use POV-Ray's clock?
    bool uses_clock() const { return changes; }
    /// Opens another file, unless it has an error and there is a scene. One that is opened while there is none is
    /// waited for.
    void open(std::string path);
    /// Reads a scene that uses POV-Ray's clock for another moment of its flight, and one that asks for the size of its
    /// picture for another size.
    void move_to(const ReadFor& wanted);
    /// Reads this text in place of the file's; of `change`, if given, only the body.
    void show(const std::string& text, std::optional<ChangedBody> change = {}) {
        reload->show(text, std::move(change));
    }
    /// Returns what was read of it since the last call.
    std::optional<Loaded> take_shown() { return reload->take_shown(); }
    /// Returns a scene that was read since the last call. Shows the error if there is one instead, or throws it as
    /// FileError.
    std::optional<Loaded> take();

    /// Writes this path into the file, or removes the one in it if it has no keys; and the changed lines. A path of one
    /// key is none yet, and not written. A file that others have changed is only written if this is asked for again
    /// within 10 seconds.
    void write(const Flythrough& flythrough, ChangedText changes);
    /// Writes these tracks into the file beside the scene's. Nothing while there is no scene.
    void write(const std::vector<Track>& tracks);
    /// Writes the scene as another file, see Reload::write_as.
    void write_as(const std::string& path, const std::string& text, const Flythrough& flythrough,
                  const std::vector<Track>& tracks);
    /// Tells the user about what was written since the last call, and returns that.
    std::optional<Written> tell_written();

    /// The error to show, or "".
    const std::string& fault() const { return error; }
    std::string fault_title() const;
    /// The time at which the error expires; infinite if there is none, or if it stays.
    double next_change() const { return error.empty() ? Pace::forever : error_until; }
    /// Removes an error that has expired.
    void expire();

  private:
    Notes& notes;
    Pace& pace;
    std::string file;
    const bool final;  // the first file's error is
    std::unique_ptr<Reload> reload;
    bool awaited;
    std::string error;
    double error_until = Pace::forever;   // only the error of another file, which was not opened, expires
    bool changes = false, sized = false;  // see Loaded
    std::vector<Message> said;
    ReadFor read_for;         // why the scene was read, or is to be read
    double write_until = -1;  // until then the user may confirm that a changed file is written
};

}  // namespace strahl
