// The gallery in the window: small pictures of scenes to open and of templates to begin from.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "show/keys/key_map.h"
#include "show/welcome/gallery.h"
#include "show/welcome/gallery_reader.h"
#include "show/window/screen.h"
#include "show/work/notes.h"
#include "show/work/pace.h"

namespace strahl {

class Welcome {
  public:
    /// `notify` is called from another thread when there is something to take.
    Welcome(int threads, Notes& notes, Pace& pace, std::function<void()> notify)
        : threads(threads), notes(notes), pace(pace), notify(std::move(notify)) {}

    /// To be called when the gallery appears: lists the scenes anew. And when it disappears: makes no more pictures.
    void appear();
    void disappear();
    /// Takes a key of GLFW: arrows, Home, End and the page keys choose, Enter and Space take what is chosen. Returns
    /// false if it does nothing here.
    bool key(int key);
    /// Takes over what was listed and the pictures that were made.
    void take(const Screen& screen);
    /// Draws the gallery, and returns what the user takes. To be called while ImGui makes a frame. `back`: there is a
    /// scene to go back to.
    std::optional<GalleryItem> draw(const KeyMap& keys, bool back);

  private:
    bool draw_item(const GalleryItem& item, bool marked);

    const int threads;
    Notes& notes;
    Pace& pace;
    const std::function<void()> notify;
    std::optional<GalleryReader> reader;  // made when the gallery is first shown
    std::optional<std::vector<GallerySection>> sections;
    std::string missing;  // where no installed scenes were found
    struct GalleryTile {
        unsigned texture = 0;  // 0 if the scene cannot be read
        std::string fault{};   // why
    };
    std::map<std::string, GalleryTile> pictures;  // by paths of scenes
    GalleryPlace chosen;
    int columns = 1, rows_seen = 1;
    float width = 1;                      // of an item, in pixels
    bool taken = false, scrolls = false;  // did a key open the chosen scene; move the choice?
    std::vector<std::string> visible;
    bool complete = false, told = false;  // was there a picture of every visible scene; is that in the log?
};

}  // namespace strahl
