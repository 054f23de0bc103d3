// Asks for a scene file by the dialog of the user's desktop.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "show/work/worker.h"

namespace strahl {

/// Closes a dialog that is open in the end.
class FileDialog {
  public:
    /// `notify` is called from another thread when there is an answer to take.
    explicit FileDialog(std::function<void()> notify) : worker(std::move(notify)) {}

    /// Opens the dialog in the folder of this scene, unless it is open. Does not wait for it. With a template it asks
    /// for the name of a new file, with `for_saving` for that of a copy of the scene, with `for_sound` for a sound.
    void open(const std::string& scene, const std::string& from = "");
    static constexpr const char *for_sound = "sound", *for_saving = "saving";
    struct ChosenFile {
        std::string path;   // "" if the user has chosen none
        std::string fault;  // why there is no dialog, or ""
        std::string from;   // the template of which it is to be made, or `for_sound`, `for_saving` or ""
    };
    /// Returns the answer, once.
    std::optional<ChosenFile> take() { return worker.take(); }

  private:
    Worker<ChosenFile> worker;
};

}  // namespace strahl
