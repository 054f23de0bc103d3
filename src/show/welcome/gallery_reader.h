// Lists what the gallery shows and traces small pictures of its scenes, in the background.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "show/welcome/gallery.h"
#include "show/welcome/kept_pictures.h"

namespace strahl {

/// Works at low priority, in a thread of its own, which may be left behind in a file that gives no answer.
class GalleryReader {
  public:
    /// `notify` is called from another thread when there is something to take.
    GalleryReader(int threads, std::function<void()> notify);
    ~GalleryReader();
    GalleryReader(const GalleryReader&) = delete;

    /// Lists the installed scenes and the recent files.
    void list();
    /// From now on makes the pictures of these scenes that were not made yet, the first ones first, of this size in
    /// pixels. What is under way is given up if it is not among these.
    void want(std::vector<std::string> paths, int width, int height);

    /// Returns what was listed since the last call.
    std::optional<std::vector<GallerySection>> take_list();
    /// Returns the pictures that were made since the last call, with the paths of their scenes.
    std::vector<std::pair<std::string, SmallPicture>> take_pictures();

  private:
    struct Desk;
    std::shared_ptr<Desk> desk;
    std::thread thread;
};

/// Traces a small picture of a scene, or takes the one that is kept. Empty if the scene cannot be read, or `stop`
/// became true.
SmallPicture small_picture(const std::string& path, int width, int height, class ThreadPool& pool,
                           const std::atomic<bool>& stop);

}  // namespace strahl
