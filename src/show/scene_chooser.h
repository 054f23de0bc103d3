// Opens the scenes that the user chooses: in the gallery, in the file dialog, or by dropping a file on the window.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "show/file_dialog.h"
#include "show/panels/panels.h"
#include "show/welcome/welcome.h"
#include "show/work/watched_scene.h"

namespace strahl {

class SceneChooser {
  public:
    /// `notify` is called from another thread when there is something to take. `leave` calls a function once the scene
    /// may be left, or never.
    SceneChooser(int threads, WatchedScene& file, Panels& panels, Notes& notes, Pace& pace,
                 const std::function<void()>& notify, std::function<void(std::function<void()>)> leave)
        : file(file),
          panels(panels),
          notes(notes),
          pace(pace),
          leave(std::move(leave)),
          dialog(notify),
          welcome(threads, notes, pace, notify) {
        if (panels.gallery) welcome.appear();
    }

    /// Shows the gallery, or leaves it for the scene, if there is one.
    void toggle_gallery();
    /// Opens a scene, and leaves the gallery for it, once the present one may be left.
    void open(const std::string& path);
    /// Asks for a scene in the file dialog; or for music, or for the name of a copy, whose path take() then returns.
    void ask();
    void ask_for_sound();
    void ask_where_to_save();

    /// Takes a key of GLFW, if the gallery is shown. Returns false if it does nothing there.
    bool key(int key) { return welcome.key(key); }
    /// Draws the gallery, and returns what the user takes. To be called while ImGui makes a frame.
    std::optional<GalleryItem> draw_gallery(const KeyMap& keys) { return welcome.draw(keys, !file.waiting()); }
    void take(const GalleryItem& item);
    /// The paths that were chosen in the file dialog for what is not opened, or "".
    struct ChosenPaths {
        std::string music, copy;
    };
    /// Takes over the gallery's new pictures, and opens what was chosen in the file dialog.
    ChosenPaths take(const Screen& screen);

    /// To be called for every scene that is shown; remember() keeps their list for the next start.
    void opened(const std::string& path) { paths.push_back(path); }
    void remember() const;

  private:
    void open_now(const std::string& path);
    void begin(const std::string& from, const std::string& path);
    std::string copy_path(std::string path) const;

    WatchedScene& file;
    Panels& panels;
    Notes& notes;
    Pace& pace;
    const std::function<void(std::function<void()>)> leave;
    FileDialog dialog;
    Welcome welcome;
    std::vector<std::string> paths;  // of scenes, in the order in which they were opened
};

}  // namespace strahl
