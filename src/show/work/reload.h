// Reads the scene file again whenever it changes on disk, and writes paths into it.
#pragma once
#include <sys/types.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scene/scene.h"

namespace strahl {

/// Parses a scene. Throws FileError, also if the scene is too large for float, in which the window traces.
Scene scene_for_window(const std::string& text, const std::string& path);

/// Identifies a version of a file; all zero if there is none.
struct FileStamp {
    dev_t device = 0;
    ino_t number = 0;
    off_t size = 0;
    time_t seconds = 0;
    long nanoseconds = 0;
    bool operator==(const FileStamp&) const = default;
};

/// The result of reading a scene file.
struct Loaded {
    std::string path;
    std::shared_ptr<const Scene> scene;  // null if it has an error
    std::string fault;                   // the message of the error
    bool opened = false;                 // it is a newly opened file
};

/// The result of writing a path into the scene file, or tracks into the file beside it.
struct Written {
    std::string file{};   // that was written
    std::string copy{};   // the name of a copy of the file as it was, if one was made
    bool asks = false;    // nothing was written, because others have changed the file since it was read
    std::string fault{};  // the reason if nothing was written
};

/// Checks the file a few times a second, in a thread of its own. Waits until a file is completely written.
class Reload {
  public:
    /// Watches `path`, whose content now is `text`; "-" is not watched. `notify` is called from another thread.
    Reload(std::string path, std::string text, std::function<void()> notify);
    ~Reload();

    /// Reads this file instead, and watches it if it is a valid scene.
    void open(std::string path);
    std::optional<Loaded> take();

    /// Replaces the flythrough in the watched file and leaves the rest as it is. A file that others have changed since
    /// it was read is only written if `anyway`, a file with an error never. FILE~ becomes a copy of the file as it was,
    /// unless Strahl wrote that.
    void write(std::optional<Flythrough> flythrough, bool anyway);
    /// Writes these tracks into the file beside the watched one, with a copy likewise.
    void write(std::vector<Track> tracks);
    std::optional<Written> take_written();

  private:
    struct Request {
        std::optional<Flythrough> flythrough;
        bool anyway;
        std::optional<std::vector<Track>> tracks{};  // instead of the flythrough
    };
    void loop(std::stop_token quit);
    void tell(Loaded loaded);
    void open_file(const std::string& other);
    void check_file();
    Written write_path(const Request& request);
    Written write_tracks(const std::vector<Track>& tracks);

    std::mutex mutex;
    std::condition_variable_any wake;
    std::optional<std::string> to_open;
    std::vector<Request> to_write;
    std::optional<Loaded> result;
    std::vector<Written> written;
    // Used by the thread alone. The file may have changed since it was read: the first check compares the text.
    std::string path, text, own_text, own_tracks;  // own_: what Strahl wrote last
    FileStamp known, before;
    const std::function<void()> notify;
    std::jthread thread;
};

}  // namespace strahl
