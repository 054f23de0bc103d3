// Opens the scenes that the user chooses: in the gallery, in the file dialog, or by dropping a file on the window.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "show/file_dialog.h"
#include "show/welcome/welcome.h"
#include "show/window/panels.h"
#include "show/work/watched_scene.h"

namespace strahl {

class SceneChooser {
  public:
    /// `notify` is called from another thread when there is something to take.
    SceneChooser(int threads, WatchedScene& file, Panels& panels, Notes& notes, Pace& pace,
                 const std::function<void()>& notify)
        : file(file), panels(panels), notes(notes), pace(pace), dialog(notify), welcome(threads, notes, pace, notify) {
        if (panels.gallery) welcome.appear();
    }

    /// Shows the gallery, or leaves it for the scene, if there is one.
    void toggle_gallery();
    /// Opens a scene, and leaves the gallery for it.
    void open(std::string path);
    /// Asks for a scene in the file dialog; or for music, whose path take() then returns.
    void ask();
    void ask_for_sound();

    /// Takes a key of GLFW, if the gallery is shown. Returns false if it does nothing there.
    bool key(int key) { return welcome.key(key); }
    /// Draws the gallery, and returns what the user takes. To be called while ImGui makes a frame.
    std::optional<GalleryItem> draw_gallery(const KeyMap& keys) { return welcome.draw(keys); }
    void take(const GalleryItem& item);
    /// Takes over the gallery's new pictures, and opens what was chosen in the file dialog. Returns the path of music
    /// that was chosen there, or "".
    std::string take(const Screen& screen);

    /// To be called for every scene that is shown; remember() keeps their list for the next start.
    void opened(const std::string& path) { paths.push_back(path); }
    void remember() const;

  private:
    void begin(const std::string& from, const std::string& path);

    WatchedScene& file;
    Panels& panels;
    Notes& notes;
    Pace& pace;
    FileDialog dialog;
    Welcome welcome;
    std::vector<std::string> paths;  // of scenes, in the order in which they were opened
};

}  // namespace strahl
