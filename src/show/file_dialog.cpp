#include "show/file_dialog.h"

#include <atomic>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "files/os/file_dialog.h"

namespace strahl {

void FileDialog::open(const std::string& scene, const std::string& made_of) {
    if (worker.busy()) return;
    std::string folder = std::filesystem::path(scene).parent_path().string();
    folder = folder.empty() ? "./" : folder + "/";
    const bool sound = made_of == for_sound, copies = made_of == for_saving, saves = !sound && !made_of.empty();
    const std::string own_name = std::filesystem::path(scene).filename().string();
    os::FileQuestion question{.title = sound    ? "Choose the music"
                                       : copies ? "Save the scene as"
                                       : saves  ? "Save the new scene as"
                                                : "Open a scene",
                              .folder = std::move(folder),
                              .new_name = copies && scene != "-" ? own_name
                                          : saves                ? "untitled.rt"
                                                                 : "",
                              .kind = sound ? "Ogg Vorbis" : "Scenes",
                              .pattern = sound              ? "*.ogg"
                                         : saves && !copies ? "*.rt"
                                                            : "*.rt *.pov"};
    worker.add([question = std::move(question), made_of](const std::atomic<bool>& stop) -> ChosenFile {
        try {
            return {os::ask_for_file(question, stop), "", made_of};
        } catch (const std::runtime_error& error) {
            return {"", error.what(), made_of};
        }
    });
}

}  // namespace strahl
