// Reads the scene file again whenever it changes on disk.
#pragma once
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "scene/scene.h"

namespace strahl {

/// A scene from its text, or a FileError: also if it is too large for float, in which the window traces.
Scene scene_for_window(const std::string& text, const std::string& path);

/// The result of reading a scene file.
struct Loaded {
    std::string path;
    std::shared_ptr<const Scene> scene;  // null if it has an error
    std::string fault;                   // the message of the error
    bool opened = false;                 // it is another file than before
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

  private:
    void loop(std::stop_token quit);
    void tell(Loaded loaded);

    std::mutex mutex;
    std::condition_variable_any wake;
    std::optional<std::string> to_open;
    std::optional<Loaded> result;
    std::string path, text;  // of the thread alone
    const std::function<void()> notify;
    std::jthread thread;
};

}  // namespace strahl
