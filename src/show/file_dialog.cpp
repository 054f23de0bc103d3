#include "show/file_dialog.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include "files/os/process.h"

namespace strahl {
namespace {

/// $1 is the folder, with a slash at its end; $2 is the name of a new file, if one is asked for; $3 is the title, $4
/// and $5 say which files are shown.
constexpr const char* script = R"sh(
if command -v zenity >/dev/null && [ -n "$2" ]; then
    exec zenity --file-selection --save --confirm-overwrite --title="$3" --filename="$1$2" 2>/dev/null
elif command -v zenity >/dev/null; then
    exec zenity --file-selection --title="$3" --filename="$1" \
        --file-filter="$4 | $5" --file-filter='All files | *' 2>/dev/null
elif command -v kdialog >/dev/null && [ -n "$2" ]; then
    exec kdialog --title "$3" --getsavefilename "$1$2" "$4 ($5)" 2>/dev/null
elif command -v kdialog >/dev/null; then
    exec kdialog --title "$3" --getopenfilename "$1" "$4 ($5)" 2>/dev/null
fi
exit 127)sh";

}  // namespace

std::string FileDialog::open(const std::string& scene, const std::string& made_of) {
    if (worker.busy()) return "";
    std::string folder = std::filesystem::path(scene).parent_path().string();
    folder = folder.empty() ? "./" : folder + "/";
    const bool sound = made_of == for_sound, copies = made_of == for_saving, saves = !sound && !made_of.empty();
    const std::string own_name = std::filesystem::path(scene).filename().string();
    std::vector<std::string> words{"/bin/sh",
                                   "-c",
                                   script,
                                   "sh",
                                   folder,
                                   copies && scene != "-" ? own_name
                                   : saves                ? "untitled.rt"
                                                          : "",
                                   sound    ? "Choose the music"
                                   : copies ? "Save the scene as"
                                   : saves  ? "Save the new scene as"
                                            : "Open a scene",
                                   sound ? "Ogg Vorbis" : "Scenes",
                                   sound              ? "*.ogg"
                                   : saves && !copies ? "*.rt"
                                                      : "*.rt *.pov"};
    std::shared_ptr<os::Process> process;
    try {
        process = std::make_shared<os::Process>(os::ProgramStart{.words = std::move(words)});
    } catch (const std::system_error&) {
        return "the file dialog cannot be started";
    }
    worker.add([process, made_of](const std::atomic<bool>& stop) -> ChosenFile {
        const int status = process->wait(&stop);
        if (status == 127)
            return {"", "there is no file dialog: install zenity or kdialog, or drop a file onto the window", made_of};
        if (status != 0) return {};
        const std::string said = process->output();
        return {said.substr(0, said.find_last_not_of('\n') + 1), "", made_of};
    });
    return "";
}

}  // namespace strahl
