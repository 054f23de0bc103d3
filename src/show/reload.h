// The scene file: read again whenever it changes on disk.
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

/// What became of reading a scene file.
struct Loaded {
    std::string path;
    std::shared_ptr<const Scene> scene;  // null if there is a fault in it
    std::string fault;                   // as FileError tells it
    bool opened = false;                 // another file than before
};

/// Looks at the file a few times a second, in a thread of its own; a file that is still being written is waited for.
class Reload {
  public:
    /// Watches `path`, whose content now is `text`; "-" is not watched. `news` is called from another thread.
    Reload(std::string path, std::string text, std::function<void()> news);
    ~Reload();

    /// Reads this file instead, and watches it if it is a good scene.
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
    const std::function<void()> news;
    std::jthread thread;
};

}  // namespace strahl
