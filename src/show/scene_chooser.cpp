#include "show/scene_chooser.h"

#include <utility>

#include "scene/error.h"
#include "show/welcome/recent_files.h"

namespace strahl {

void SceneChooser::toggle_gallery() {
    if (panels.gallery && file.path().empty()) return;  // there is nothing to go back to
    panels.toggle(Action::gallery);
    panels.gallery ? welcome.appear() : welcome.disappear();
}

void SceneChooser::open(std::string path) {
    panels.gallery = false;
    welcome.disappear();
    pace.redraw();
    file.open(std::move(path));
}

void SceneChooser::ask() {
    if (const std::string why = dialog.open(file.path()); !why.empty()) notes.fail(why);
}

void SceneChooser::ask_for_sound() {
    if (const std::string why = dialog.open_sound(file.path()); !why.empty()) notes.fail(why);
}

/// Opens a new scene, made of a template.
void SceneChooser::begin(const std::string& from, const std::string& path) try {
    const std::string scene = begin_scene(from, path);
    notes.announce("a new scene: " + scene);
    open(scene);
} catch (const FileError& error) {
    notes.fail(error.what());
}

void SceneChooser::take(const GalleryItem& item) {
    if (!item.begins) return open(item.path);
    if (const std::string why = dialog.open(file.path(), item.path); !why.empty()) begin(item.path, "");
}

std::string SceneChooser::take(const Screen& screen) {
    welcome.take(screen);
    const auto chosen = dialog.take();
    if (!chosen || (chosen->path.empty() && chosen->fault.empty())) return "";
    if (chosen->from == FileDialog::for_sound) {
        if (chosen->path.empty()) notes.fail("there is no file dialog: install zenity or kdialog, or type the name");
        return chosen->path;
    }
    // Begins a new scene; without a dialog there is no path, and it gets a name of its own.
    if (!chosen->from.empty())
        begin(chosen->from, chosen->path);
    else if (chosen->path.empty())
        notes.fail(chosen->fault);
    else
        open(chosen->path);
    return "";
}

void SceneChooser::remember() const { remember_recent_files(paths); }

}  // namespace strahl
