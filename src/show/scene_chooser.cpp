#include "show/scene_chooser.h"

#include <filesystem>

#include "files/error.h"
#include "pov/open_scene.h"
#include "show/welcome/recent_files.h"
#include "show/work/stills.h"

namespace strahl {

void SceneChooser::toggle_gallery() {
    if (panels.gallery && file.path().empty()) return;  // there is nothing to go back to
    panels.toggle(Action::gallery);
    panels.gallery ? welcome.appear() : welcome.disappear();
}

void SceneChooser::open(const std::string& path) {
    leave([this, path] { open_now(path); });
}

void SceneChooser::open_now(const std::string& path) {
    panels.gallery = false;
    welcome.disappear();
    pace.redraw();
    file.open(path);
}

void SceneChooser::ask() { dialog.open(file.path()); }

void SceneChooser::ask_for_sound() { dialog.open(file.path(), FileDialog::for_sound); }

void SceneChooser::ask_where_to_save() {
    // Scenes of the program are copied to where the user is.
    const std::string beside = installed(file.path()) ? file.name() : file.path();
    dialog.open(beside, FileDialog::for_saving);
}

/// Opens a new scene, made of a template, once the present one may be left.
void SceneChooser::begin(const std::string& from, const std::string& path) {
    leave([this, from, path] {
        try {
            const std::string scene = begin_scene(from, path);
            notes.announce("a new scene: " + scene);
            open_now(scene);
        } catch (const FileError& error) {
            notes.fail(error.what());
        }
    });
}

void SceneChooser::take(const GalleryItem& item) {
    if (!item.begins) return open(item.path);
    dialog.open(file.path(), item.path);
}

/// Returns the path of a copy of the scene: that which was chosen, with the scene's ending; or, if that is empty, a
/// name in the current folder that no file has. Throws FileError.
std::string SceneChooser::copy_path(std::string path) const {
    const std::string ending = is_pov(file.path()) ? ".pov" : ".rt";
    if (!path.empty()) return path.ends_with(ending) ? path : path + ending;
    const std::string name = file.path() == "-" ? "untitled" : std::filesystem::path(file.path()).stem().string();
    return reserve_file(name, ending);
}

SceneChooser::ChosenPaths SceneChooser::take(const Screen& screen) try {
    welcome.take(screen);
    const auto chosen = dialog.take();
    if (!chosen) return {};
    if (chosen->path.empty() && chosen->fault.empty()) return notes.log("no file was chosen"), ChosenPaths{};
    if (chosen->from == FileDialog::for_sound) {
        if (chosen->path.empty()) notes.fail("there is no file dialog: install zenity or kdialog, or type the name");
        return {chosen->path, ""};
    }
    if (chosen->from == FileDialog::for_saving) return {"", copy_path(chosen->path)};
    // Begins a new scene; without a dialog there is no path, and it gets a name of its own.
    if (!chosen->from.empty())
        begin(chosen->from, chosen->path);
    else if (chosen->path.empty())
        notes.fail(chosen->fault);
    else
        open(chosen->path);
    return {};
} catch (const FileError& error) {
    notes.fail(error.what());
    return {};
}

void SceneChooser::remember() const { remember_recent_files(paths); }

}  // namespace strahl
