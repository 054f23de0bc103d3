// Lists what the gallery shows and traces small pictures of its scenes, in the background.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "show/welcome/gallery.h"
#include "show/welcome/kept_pictures.h"
#include "show/work/worker.h"

namespace strahl {

/// Works at low priority, in a thread of its own, which may be left behind in a file that gives no answer.
class GalleryReader {
  public:
    /// `notify` is called from another thread when there is something to take.
    GalleryReader(int threads, std::function<void()> notify) : threads(threads), worker(std::move(notify), 5) {}

    /// Lists the installed scenes and the recent files.
    void list();
    /// From now on makes the pictures of these scenes that were not made yet, the first ones first, of this size in
    /// pixels. What is under way is given up if it is not among these.
    void want(std::vector<std::string> paths, int width, int height);

    /// Holds a new list, or a picture that was made.
    struct GalleryNews {
        std::optional<std::vector<GallerySection>> listed{};
        std::string path{};  // of the picture's scene
        SmallPicture picture{};
    };
    /// Returns what was found and not taken yet.
    std::optional<GalleryNews> take();

  private:
    void make_next();

    const int threads;
    std::vector<std::string> wanted;
    int width = 1, height = 1;
    bool listing = false;        // a list was asked for
    std::string under_way;       // the scene whose picture is being made
    std::set<std::string> made;  // scenes whose pictures are
    Worker<GalleryNews> worker;
};

/// Traces a small picture of a scene, or takes the one that is kept. Empty if the scene cannot be read, or `stop`
/// became true.
SmallPicture small_picture(const std::string& path, int width, int height, class ThreadPool& pool,
                           const std::atomic<bool>& stop);

}  // namespace strahl
